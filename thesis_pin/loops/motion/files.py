"""Motion of some joints from a CSV file, for any robot.

A header with ``t`` [s] and, for each joint, ``NAME``; where they are known also
``NAME_rate`` and ``NAME_acceleration``. Units are SI; an ending says others: ``NAME_deg``,
``NAME_mm``, ``NAME_rate_deg_s``, ``NAME_acceleration_mm_s2``. ``NAME`` is a joint's or a
motor's; either way the coordinate is the joint's. Of a free root: ``base_x``, ``base_y``,
``base_z`` and ``base_roll``, ``base_pitch``, ``base_yaw`` (about the world's x, y, z, in
that order), or the quaternion ``base_qx``, ``base_qy``, ``base_qz``, ``base_qw``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, TrajectoryError, UnknownName
from thesis_pin.files import name_as_text
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.sampled import (
    quantum,
    resolution_warning,
    unlike,
    unwound,
    with_derivatives,
)
from thesis_pin.model.samples import check_increasing, check_width, numbers, read_rows

Array = NDArray[np.float64]

_TIME = {"t": 1.0, "time_s": 1.0}
_DEGREE = math.pi / 180
_TURN = {"": 1.0, "rad": 1.0, "deg": _DEGREE}
_SLIDE = {"": 1.0, "m": 1.0, "mm": 1e-3}
_ORDERS = (("", ""), ("_rate", "_s"), ("_acceleration", "_s2"))
BASE_PLACE = ("base_x", "base_y", "base_z")
BASE_ANGLES = ("base_roll", "base_pitch", "base_yaw")
BASE_QUATERNION = ("base_qx", "base_qy", "base_qz", "base_qw")


@dataclass(frozen=True, eq=False)
class JointMotion:
    """How some joints of a robot move.

    Attributes:
        name: What it is called in reports.
        time: Sample times [s], shape ``(n,)``.
        joints: Names of the joints, ``k`` of them.
        position: [rad] or [m], shape ``(n, k)``.
        rate: [rad/s] or [m/s], the same shape.
        acceleration: [rad/s²] or [m/s²], the same.
        base: Placement of a free root over time, position and quaternion x, y, z, w,
            shape ``(n, 7)``; None if it isn't given.
        interpolated: Joints whose rates or accelerations were made from the samples, ``base``
            among them.
        warnings: What is odd about the samples.
    """

    name: str
    time: Array
    joints: tuple[str, ...]
    position: Array
    rate: Array
    acceleration: Array
    base: Array | None = None
    interpolated: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Column:
    """What a column may hold: of which joint or part of the base, which derivative."""

    of: str
    order: int
    factor: float
    turns: bool


def read_motion(robot: ClosedRobot, file: str | Path) -> JointMotion:
    """A motion of a robot's joints from CSV; see the head of this module.

    Args:
        robot: The robot, for the names of its joints and motors.
        file: The file.

    Raises:
        BadInput: It can't be read, a column is missing or means two things, a cell isn't a
            number.
        UnknownName: A column is none of the robot's.
        TrajectoryError: Time doesn't increase, or there are too few samples.
    """
    lines = read_rows("motion", file)
    where, header = str(file), lines[0].cells
    columns = _columns(robot, header, where)
    check_width(lines)
    rows = lines[1:]
    if len(rows) < 2:
        raise TrajectoryError(f"{len(rows)} samples", where=where, allowed="at least 2")
    table = numbers(rows, range(len(header)), header)
    time = table[:, next(k for k, name in enumerate(header) if name in _TIME)]
    check_increasing(rows, time)
    values = {
        (column.of, column.order): (table[:, k] * column.factor, k, column)
        for k, column in columns.items()
    }
    joints = tuple(dict.fromkeys(c.of for c in columns.values() if not c.of.startswith("base_")))
    if not joints:
        raise BadInput(
            "no column is a joint's", where=where, allowed=", ".join(singles(robot.model))
        )
    position, rate, acceleration = np.empty((3, len(time), len(joints)))
    interpolated, warnings = [], []
    for j, joint in enumerate(joints):
        value, k, column = values[joint, 0]
        if column.turns:
            value, doubts = unwound(joint, value)
            warnings += doubts
        given = [values[joint, order][0] if (joint, order) in values else None for order in (1, 2)]
        position[:, j] = value
        if given[1] is None and len(time) < 4:
            raise TrajectoryError(
                f"{len(time)} samples of {joint!r} without {joint}_rate and {joint}_acceleration",
                where=where,
                allowed="at least 4",
            )
        rate[:, j], acceleration[:, j] = with_derivatives(time, value, *given)
        if given[0] is None:
            interpolated.append(joint)
            step = quantum([row.cells[k] for row in rows], table[:, k]) * column.factor
            warnings += resolution_warning(joint, time, step, acceleration[:, j], column.turns)
        elif given[1] is None:
            interpolated.append(joint)
        warnings += unlike(joint, time, value, given)
    base = _base(robot, values, len(time), where)
    if base is not None:
        interpolated.append("base")
    return JointMotion(
        name_as_text(Path(file).name),
        time,
        joints,
        position,
        rate,
        acceleration,
        base,
        tuple(interpolated),
        tuple(warnings),
    )


def _known(robot: ClosedRobot) -> dict[str, list[_Column]]:
    """Every column a file may have, with all it could mean."""
    turning = {name: one.turns for name, one in singles(robot.model).items()}
    names = {name: name for name in turning}
    for motor in robot.motors:
        names.setdefault(motor.name, motor.joint)
    known: dict[str, list[_Column]] = {}
    for name, joint in names.items():
        turns = turning[joint]
        for order, (word, per) in enumerate(_ORDERS):
            for unit, factor in (_TURN if turns else _SLIDE).items():
                column = f"{name}{word}" + (f"_{unit}{per}" if unit else "")
                known.setdefault(column, []).append(_Column(joint, order, factor, turns))
    if len(robot.base):
        for names_of, units in ((BASE_PLACE, _SLIDE), (BASE_ANGLES, _TURN)):
            for part in names_of:
                for unit, factor in units.items():
                    name = f"{part}_{unit}" if unit else part
                    known.setdefault(name, []).append(_Column(part, 0, factor, units is _TURN))
        for part in BASE_QUATERNION:
            known.setdefault(part, []).append(_Column(part, 0, 1.0, False))
    return known


def _columns(robot: ClosedRobot, header: Sequence[str], where: str) -> dict[int, _Column]:
    """The header, checked: what each column but the time's holds."""
    known = _known(robot)
    columns: dict[int, _Column] = {}
    seen: dict[tuple[str, int], str] = {}
    times = [name for name in header if name in _TIME]
    if len(times) != 1:
        joined = any(mark in name for name in header for mark in ";\t")
        remedy = "Separate cells by commas, and write decimals with points" if joined else ""
        raise BadInput(
            f"{len(times)} columns of time", where=where, allowed="one, t [s]", remedy=remedy
        )
    for k, name in enumerate(header):
        if name in _TIME:
            continue
        meanings = known.get(name)
        if meanings is None:
            shown = [*_TIME, *singles(robot.model), *(BASE_PLACE if len(robot.base) else ())]
            raise UnknownName(
                "column", name, [*shown, "NAME_rate", "NAME_acceleration"], where=where
            )
        if len({(one.of, one.order) for one in meanings}) > 1:
            could = (f"{_ORDERS[one.order][0][1:] or 'position'} of {one.of!r}" for one in meanings)
            raise BadInput(
                f"column {name!r} could be {' or '.join(could)}",
                where=where,
                remedy="Write the unit behind it, as in NAME_rad",
            )
        column = meanings[0]
        if (twice := seen.get((column.of, column.order))) is not None:
            raise BadInput(f"columns {twice!r} and {name!r} say the same", where=where)
        seen[column.of, column.order] = name
        columns[k] = column
    for of, order in seen:
        for lower in range(order):
            if (of, lower) not in seen:
                raise BadInput(
                    f"column {seen[of, order]!r} stands without {of}{_ORDERS[lower][0]}",
                    where=where,
                )
    return columns


def _base(
    robot: ClosedRobot,
    values: Mapping[tuple[str, int], tuple[Array, int, _Column]],
    count: int,
    where: str,
) -> Array | None:
    """The root's placement over time; None if no column says it."""
    from scipy.spatial.transform import Rotation

    parts = [of for of, _ in values if of.startswith("base_")]
    if not parts:
        return None
    angles = [part for part in parts if part in BASE_ANGLES]
    wanted = {*BASE_PLACE, *(BASE_ANGLES if angles else BASE_QUATERNION)}
    if set(parts) != wanted:
        raise BadInput(
            f"the base has the columns {', '.join(parts)}",
            where=where,
            allowed=f"{', '.join(BASE_PLACE)} and {', '.join(BASE_ANGLES)}, or these and "
            f"{', '.join(BASE_QUATERNION)} instead of angles",
        )
    place = np.empty((count, 7))
    place[:, :3] = np.column_stack([values[part, 0][0] for part in BASE_PLACE])
    if angles:
        turns = np.column_stack([values[part, 0][0] for part in BASE_ANGLES])
        place[:, 3:] = Rotation.from_euler("xyz", turns).as_quat()
        return place
    quaternion = np.column_stack([values[part, 0][0] for part in BASE_QUATERNION])
    length = np.linalg.norm(quaternion, axis=1)
    if (np.abs(length - 1) > 1e-3).any():
        k = int(np.argmax(np.abs(length - 1)))
        raise BadInput(
            f"the quaternion of sample {k} has length {length[k]:.6g}", where=where, allowed="1"
        )
    place[:, 3:] = quaternion / length[:, None]
    return place
