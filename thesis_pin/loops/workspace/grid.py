"""What leads a robot over a grid: coordinates of a frame, or joints."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.told import COORDINATES
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import real
from thesis_pin.tables.units import ANGLE, LENGTH, headings

Array = NDArray[np.float64]

MOST_CELLS = 1_000_000
"""Cells of a grid at most."""

MOST_AXES = 3
"""Axes of a grid at most."""


@dataclass(frozen=True, eq=False)
class Axis:
    """One axis of a grid.

    Attributes:
        name: A coordinate of the frame, or a joint.
        unit: Of its values, ``m`` or ``rad``.
        values: In ascending order, shape ``(n,)``.
    """

    name: str
    unit: str
    values: Array


@dataclass(frozen=True, eq=False)
class Grid:
    """What leads a robot: over a grid, and what stands still.

    Attributes:
        axes: One to three.
        held: The same for what stands still: name → value.
        frame: The frame whose coordinates may be among them; None without one.
    """

    axes: tuple[Axis, ...]
    held: Mapping[str, float]
    frame: str | None

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def names(self) -> tuple[str, ...]:
        """Everything that leads, the axes first."""
        return (*(axis.name for axis in self.axes), *self.held)

    @property
    def told(self) -> tuple[str, ...]:
        """The frame's coordinates among it."""
        if self.frame is None:
            return ()
        return tuple(name for name in COORDINATES if name in self.names)

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints among it."""
        return tuple(name for name in self.names if name not in self.told)

    @property
    def points(self) -> Array:
        """Values of the axes in every cell, shape ``(cells, axes)``, the last axis the fastest."""
        each = np.meshgrid(*(axis.values for axis in self.axes), indexing="ij")
        return np.stack([one.ravel() for one in each], axis=-1)


def grid_of(
    robot: ClosedRobot,
    along: Mapping[str, ArrayLike],
    at: Mapping[str, float] | None,
    frame: str | None,
) -> Grid:
    """A grid of a robot's coordinates.

    Args:
        robot: The robot.
        along: Name → values of each axis.
        at: Name → value of what stands still.
        frame: The frame of x, y, z, roll, pitch and yaw.

    Raises:
        UnknownName: A name is neither a coordinate of the frame nor a joint or motor.
        BadInput: There are too many axes or cells, or values don't ascend.
    """
    units = units_of(robot, frame)
    joints = {motor.name: motor.joint for motor in robot.motors}
    held = {
        joints.get(name, name): real(name, value)
        for name, value in (at or {}).items()
        if _known(name, units, frame)
    }
    axes = []
    for name, given in along.items():
        _known(name, units, frame)
        values = np.atleast_1d(finite_array(name, given, None))
        if values.ndim != 1 or not values.size or (np.diff(values) <= 0).any():
            raise BadInput(f"the values of {name} don't ascend", allowed="ascending values")
        axes.append(Axis(joints.get(name, name), units[name], values))
    found = Grid(tuple(axes), held, frame)
    for name, times in Counter(found.names).items():
        if times > 1:
            raise BadInput(
                f"{name} is given twice", allowed="along an axis or at a value, by one name"
            )
    if not 1 <= len(axes) <= MOST_AXES or not 2 <= np.prod(found.shape, dtype=float) <= MOST_CELLS:
        raise BadInput(
            f"a grid of {' × '.join(map(str, found.shape)) or 'no'} cells",
            allowed=f"one to {MOST_AXES} axes, 2 to {MOST_CELLS:,} cells",
            remedy="Use fewer points an axis",
        )
    return found


def units_of(robot: ClosedRobot, frame: str | None) -> dict[str, str]:
    """What may lead a robot: name → unit; the frame's coordinates come before joints."""
    kinds = singles(robot.model)
    units = {name: one.unit for name, one in kinds.items()}
    units |= {motor.name: kinds[motor.joint].unit for motor in robot.motors}
    if frame is not None:
        units |= {name: "m" if name in "xyz" else "rad" for name in COORDINATES}
    return units


def unit_of(name: str, units: Mapping[str, str]) -> tuple[str, float]:
    """A coordinate without the unit at the end of its name, and that unit in SI.

    Args:
        name: Such as ``x``, ``x_mm``, ``shoulder_deg``.
        units: From :func:`units_of`.

    Raises:
        UnknownName: It is none.
    """
    if name in units:
        return name, 1.0
    for one, unit in units.items():
        for heading, size in headings(one, LENGTH if unit == "m" else ANGLE).items():
            if heading == name:
                return one, size.size
    raise UnknownName("coordinate", name, list(units))


def ranges_of(robot: ClosedRobot, points: int) -> dict[str, Array]:
    """The whole ranges of a robot's motors, if these are few and have any.

    Raises:
        BadInput: They are none or more than three, or one has no range.
    """
    kinds = singles(robot.model)
    ranges = {one.joint: kinds[one.joint] for one in robot.motors}
    if not 1 <= len(ranges) <= MOST_AXES or any(np.isinf(r.high - r.low) for r in ranges.values()):
        raise BadInput(
            "no axes are named, and the motors aren't one to three with a range each",
            remedy="Name two or three: x, y, z of a frame, or motors",
        )
    return {name: np.linspace(one.low, one.high, points) for name, one in ranges.items()}


def _known(name: str, units: Mapping[str, str], frame: str | None) -> bool:
    if name not in units:
        more = "" if frame or name not in COORDINATES else "Name the frame whose coordinate it is"
        raise UnknownName("coordinate", name, list(units), remedy=more)
    return True
