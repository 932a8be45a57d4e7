"""Feet in words: ``foot``, ``foot=point``, ``foot=0.03`` (a ball) or ``foot=0.2x0.1``."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.contacts.soles.finding import find_feet
from thesis_pin.contacts.soles.foot import FRICTION, Foot, by_name, check_free
from thesis_pin.errors import BadInput
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import frame_id
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import shown

Array = NDArray[np.float64]

_ALLOWED = (
    "NAME (its sole from the robot's shapes), NAME=point, NAME=RADIUS (a ball about the frame's "
    "origin) or NAME=LENGTHxWIDTH (a sole about it), in metres"
)


def stated_feet(
    robot: ClosedRobot,
    words: Sequence[str],
    *,
    pose: ArrayLike | None = None,
    friction: float = FRICTION,
) -> tuple[Foot, ...]:
    """Feet as somebody names them.

    A stated sole lies in the two axes of its frame that are level in the pose, its length along
    the first of them (x before y before z), and is centred on the frame's origin.

    Args:
        robot: The robot, with a free root.
        words: A word for each foot; see the head of this module.
        pose: Configuration in which it stands upright, shape ``(nq,)``; None for the neutral one.
        friction: Coefficient of friction of all.

    Raises:
        UnknownName: There is no such frame.
        BadInput: A word means nothing, or what :func:`find_feet` refuses.
    """
    check_free(robot)
    q = robot.q0 if pose is None else vector("pose", pose, robot.model.nq)
    feet: list[Foot] = []
    for word in words:
        name, equals, shape = word.strip().partition("=")
        if not name or (equals and not shape.strip()):
            raise BadInput(f"a foot is {shown(word)}", allowed=_ALLOWED)
        if not equals:
            feet += find_feet(robot, [name], pose=q, friction=friction)
            continue
        sizes = _sizes(shape.strip(), word)
        feet.append(_stated(robot, q, name.strip(), sizes, friction))
    return tuple(by_name(feet).values())


def _sizes(shape: str, word: str) -> tuple[float, ...]:
    """Sizes that a shape's word says [m]: none, a radius, or two lengths."""
    if shape == "point":
        return ()
    try:
        found = tuple(float(part) for part in shape.casefold().replace("×", "x").split("x"))
    except ValueError:
        found = ()
    if len(found) not in (1, 2) or not all(math.isfinite(size) and size > 0 for size in found):
        raise BadInput(f"a foot is {shown(word)}", allowed=_ALLOWED)
    if max(found) > 2.0:
        raise BadInput(
            f"a foot of {max(found):g} m in {shown(word)}", allowed="up to 2 m", remedy="In metres?"
        )
    return found


def _stated(
    robot: ClosedRobot, q: Array, name: str, sizes: tuple[float, ...], friction: float
) -> Foot:
    if len(sizes) < 2:
        frame_id(robot.model, name, where="feet")
        return Foot.of(name, friction=friction, radius=sizes[0] if sizes else 0.0)
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    turn = np.array(data.oMf[frame_id(robot.model, name, where="feet")].rotation)
    upright = int(np.abs(turn[2]).argmax())
    first = next(axis for axis in range(3) if axis != upright)
    axes = np.zeros((3, 3))
    axes[upright, 2] = np.sign(turn[2, upright])
    axes[first, 0] = 1.0
    axes[:, 1] = np.cross(axes[:, 2], axes[:, 0])
    placement = np.eye(4)
    placement[:3, :3] = axes
    half, wide = sizes[0] / 2, sizes[1] / 2
    corners = [(half, wide), (-half, wide), (-half, -wide), (half, -wide)]
    return Foot.of(name, corners, placement=placement, friction=friction)
