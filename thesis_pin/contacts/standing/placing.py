"""A robot put on the floor: its root moved so that its feet touch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.contacts.balance.stance import stance
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot, by_name, check_free
from thesis_pin.display.brief import Brief
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance

Array = NDArray[np.float64]

_ROUNDS = 5  # a ball's lowest point turns with the robot
_IN_LINE = 1e-6  # what counts as none, of the extent of points


@dataclass(frozen=True, eq=False)
class Placed(Brief):
    """A robot on the floor.

    Attributes:
        q: Configuration, shape ``(nq,)``.
        gap: How far the corner that fits worst is off the floor [m]; 0 where all touch.
        worst: The foot it is on.
    """

    q: Array
    gap: float
    worst: str


def stand(
    robot: ClosedRobot, feet: Sequence[Foot], q: ArrayLike, floor: Floor | None = None
) -> Placed:
    """Put a robot on its feet: turn it as little as may be, then lower it onto the floor.

    All joints but the root stay. Three corners or more stand as near to the floor as they fit,
    so that on a slope the robot leans with it; on one point or two the robot stays as upright as
    it is.

    Args:
        robot: The robot, with a free root.
        feet: Those that stand.
        q: Configuration, shape ``(nq,)``.
        floor: The floor; None for a level one at height 0.

    Raises:
        BadInput: There is no foot, or the root is tied to the world.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    check_free(robot)
    by_name(feet)
    floor = Floor() if floor is None else floor
    q = vector("q", q, robot.model.nq).copy()
    for _ in range(_ROUNDS):
        points = _touching(robot, feet, floor, q)
        turn = _least_turn(points, floor.normal)
        _turn_root(robot, q, turn)
        points = _touching(robot, feet, floor, q)
        _shift_root(robot, q, -float(floor.above(points).mean()) * floor.normal)
        if np.allclose(turn, np.eye(3), atol=1e-14):
            break
    heights = [
        np.abs(floor.above(corners[0])).max()
        for corners in stance(robot, feet, floor, q[None]).corners
    ]
    worst = int(np.argmax(heights))
    return Placed(q, float(heights[worst]), feet[worst].name)


def _touching(robot: ClosedRobot, feet: Sequence[Foot], floor: Floor, q: Array) -> Array:
    """All corners in the world [m], shape ``(k, 3)``."""
    return np.concatenate([corners[0] for corners in stance(robot, feet, floor, q[None]).corners])


def _least_turn(points: Array, normal: Array) -> Array:
    """The least rotation that lays points as flat as they fit, shape ``(3, 3)``."""
    around = points - points.mean(axis=0)
    _, sizes, axes = np.linalg.svd(around, full_matrices=False)
    size = sizes[0] if len(sizes) else 0.0
    if len(points) < 2 or size == 0:
        return np.eye(3)
    if len(sizes) < 2 or sizes[1] < _IN_LINE * size:
        along = axes[0]
        flat = along - normal * (along @ normal)
        return _between(along, flat / np.linalg.norm(flat))
    across = np.cross(axes[0], axes[1])
    across *= np.sign(across[2]) or 1.0
    return _between(across, normal)


def _between(one: Array, other: Array) -> Array:
    """The least rotation that takes a unit vector to another."""
    return np.asarray(pin.Quaternion.FromTwoVectors(one, other).toRotationMatrix())


def _turn_root(robot: ClosedRobot, q: Array, turn: Array) -> None:
    upright = np.array(robot.model.jointPlacements[1].rotation)
    own = pin.Quaternion(*q[[6, 3, 4, 5]]).toRotationMatrix()
    q[3:7] = pin.Quaternion(upright.T @ turn @ upright @ own).normalized().coeffs()


def _shift_root(robot: ClosedRobot, q: Array, way: Array) -> None:
    q[:3] += np.array(robot.model.jointPlacements[1].rotation).T @ way
