"""Masses of a robot's links, and the solid ellipsoids that have their inertias."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.model.loading import LoadedRobot
from thesis_pin.model.mechanism.description import Inertial
from thesis_pin.numeric.checks import shown

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Body:
    """A link with mass.

    Attributes:
        name: The link's.
        joint: Number of the joint that carries it.
        local: Its centre of mass and principal axes in that joint's frame [m], ``(4, 4)``.
        radii: Of the ellipsoid along these axes [m]; None where no mass can have the inertia,
            zero for a point.
    """

    name: str
    joint: int
    local: Array
    radii: tuple[float, float, float] | None


def ellipsoids(robot: LoadedRobot, notes: list[str]) -> Iterator[Body]:
    """Every link that has mass, in the file's order.

    Args:
        robot: The robot.
        notes: Is told of inertias that no mass can have.
    """
    impossible: list[str] = []
    for link in robot.description.links.values():
        if link.inertial is None or not link.inertial.mass > 0:
            continue
        place = _placed(robot.model, link.name)
        if place is None:
            continue
        joint, placement = place
        local, radii = ellipsoid(link.inertial)
        if radii is None:
            impossible.append(shown(link.name))
        yield Body(link.name, joint, placement @ local, radii)
    if impossible:
        rest = len(impossible) - MOST_TOLD
        notes.append(
            f"no mass can have the inertia of {', '.join(impossible[:MOST_TOLD])}"
            f"{f' and {rest} more' if rest > 0 else ''}: no ellipsoid is drawn of it"
        )


def ellipsoid(inertial: Inertial) -> tuple[Array, tuple[float, float, float] | None]:
    """The homogeneous ellipsoid of the same mass and inertia.

    With semi-axes a, b, c the moments are m (b² + c²) / 5 and so on.

    Args:
        inertial: Mass and tensor.

    Returns:
        Its placement in the link, shape ``(4, 4)``, and its semi-axes [m]; None if the moments
        break the triangle inequality.
    """
    moments, axes = np.linalg.eigh(inertial.tensor)
    if np.linalg.det(axes) < 0:
        axes[:, 0] *= -1
    local = np.eye(4)
    local[:3, :3] = axes
    squares = 2.5 / inertial.mass * (moments.sum() - 2 * moments)
    largest = float(squares.max())
    if squares.min() < -_ROUNDING * abs(largest) or not np.isfinite(squares).all():
        return inertial.placement @ local, None
    # A rod or a plate has no thickness: a sliver is drawn, or nothing would be seen.
    a, b, c = np.sqrt(np.maximum(squares, (_SLIVER**2) * largest)).tolist()
    return inertial.placement @ local, (a, b, c)


MOST_TOLD = 4
"""Impossible inertias that are named."""

_ROUNDING = 1e-3
"""Share of the largest squared semi-axis by which another may be negative: tensors of four
digits."""
_SLIVER = 0.01


def _placed(model: pin.Model, link: str) -> tuple[int, Array] | None:
    """The joint that carries a link, and the link's placement in its frame."""
    number = model.getFrameId(link, pin.FrameType.BODY)
    if number >= model.nframes:
        return None
    frame = model.frames[number]
    return int(frame.parentJoint), np.asarray(frame.placement.homogeneous)
