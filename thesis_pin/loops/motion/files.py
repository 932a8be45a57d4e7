"""Motion of some joints from a table, for any robot.

A header with ``t`` [s] and, for each joint, ``NAME``; where they are known also
``NAME_rate`` and ``NAME_acceleration``. Units are SI; an ending says others: ``t_ms``,
``NAME_deg``, ``NAME_mm``, ``NAME_rate_deg_s``, ``NAME_acceleration_mm_s2``. ``NAME`` is a joint's
or a motor's; either way the coordinate is the joint's. Of a free root: ``base_x``, ``base_y``,
``base_z`` and ``base_roll``, ``base_pitch``, ``base_yaw`` (about the world's x, y, z, in
that order), or the quaternion ``base_qx``, ``base_qy``, ``base_qz``, ``base_qw``. How the table
may be written is said in :mod:`thesis_pin.tables`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.files import name_as_text
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.sampled import (
    resolution_warning,
    unlike,
    unwound,
    with_derivatives,
)
from thesis_pin.tables.meaning import Chosen, Meaning, chosen, time_column, time_names
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.table import Column, Table
from thesis_pin.tables.units import ANGLE, LENGTH, PLAIN, headings

Array = NDArray[np.float64]

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
        notes: How the file was read, where that isn't plain.
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
    notes: tuple[str, ...] = ()


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
    table = read_table("motion", file)
    where = table.file
    columns = _columns(robot, table)
    if len(table) < 2:
        raise TrajectoryError(f"{len(table)} samples", where=where, allowed="at least 2")
    time = time_column(table, columns).values
    values = {
        key: table.column(*place, key[0] + _ORDERS[key[1]][0])
        for key, place in columns.items()
        if isinstance(key, tuple)
    }
    kinds = singles(robot.model)
    joints = tuple(dict.fromkeys(of for of, _ in values if of in kinds))
    if not joints:
        raise BadInput("no column is a joint's", where=where, allowed=", ".join(kinds))
    position, rate, acceleration = np.empty((3, len(time), len(joints)))
    interpolated, warnings = [], []
    for j, joint in enumerate(joints):
        column, turns = values[joint, 0], kinds[joint].turns
        value = column.values
        if turns:
            value, doubts = unwound(joint, value)
            warnings += doubts
        given = [values[joint, o].values if (joint, o) in values else None for o in (1, 2)]
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
            warnings += resolution_warning(joint, time, column.quantum, acceleration[:, j], turns)
        elif given[1] is None:
            interpolated.append(joint)
        warnings += unlike(joint, time, value, given)
    base = _base(values, table)
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
        table.dialect.notes,
    )


def _known(robot: ClosedRobot) -> dict[str, list[Meaning]]:
    """Every column a file may have, with all it could mean."""
    turning = {name: one.turns for name, one in singles(robot.model).items()}
    names = {name: name for name in turning}
    for motor in robot.motors:
        names.setdefault(motor.name, motor.joint)
    known = time_names()
    for name, joint in names.items():
        units = ANGLE if turning[joint] else LENGTH
        for order, (word, per) in enumerate(_ORDERS):
            said = f"{word[1:] or 'position'} of {joint!r}"
            for heading, unit in headings(name + word, units, per).items():
                known.setdefault(heading, []).append(Meaning((joint, order), unit, said))
    if len(robot.base):
        for parts, units in (
            (BASE_PLACE, LENGTH),
            (BASE_ANGLES, ANGLE),
            (BASE_QUATERNION, PLAIN),
        ):
            for part in parts:
                for heading, unit in headings(part, units).items():
                    known.setdefault(heading, []).append(Meaning((part, 0), unit, part))
    return known


def _columns(robot: ClosedRobot, table: Table) -> Chosen:
    """Which column holds which derivative of which joint or part of the base."""
    base = BASE_PLACE if len(robot.base) else ()
    allowed = ["t", *singles(robot.model), *base, "NAME_rate", "NAME_acceleration"]
    columns, _ = chosen(table, _known(robot), allowed)
    for key, (place, _) in columns.items():
        if not isinstance(key, tuple):
            continue
        of, order = key
        for lower in range(order):
            if (of, lower) not in columns:
                raise BadInput(
                    f"column {table.header[place]!r} stands without {of}{_ORDERS[lower][0]}",
                    where=table.file,
                )
    return columns


def _base(
    values: Mapping[tuple[str, int], Column],
    table: Table,
) -> Array | None:
    """The root's placement over time; None if no column says it."""
    from scipy.spatial.transform import Rotation

    parts = [of for of, _ in values if of in (*BASE_PLACE, *BASE_ANGLES, *BASE_QUATERNION)]
    if not parts:
        return None
    angles = [part for part in parts if part in BASE_ANGLES]
    wanted = {*BASE_PLACE, *(BASE_ANGLES if angles else BASE_QUATERNION)}
    if set(parts) != wanted:
        raise BadInput(
            f"the base has the columns {', '.join(parts)}",
            where=table.file,
            allowed=f"{', '.join(BASE_PLACE)} and {', '.join(BASE_ANGLES)}, or these and "
            f"{', '.join(BASE_QUATERNION)} instead of angles",
        )
    place = np.empty((len(table), 7))
    place[:, :3] = np.column_stack([values[part, 0].values for part in BASE_PLACE])
    if angles:
        turns = np.column_stack([values[part, 0].values for part in BASE_ANGLES])
        place[:, 3:] = Rotation.from_euler("xyz", turns).as_quat()
        return place
    quaternion = np.column_stack([values[part, 0].values for part in BASE_QUATERNION])
    length = np.linalg.norm(quaternion, axis=1)
    if (np.abs(length - 1) > 1e-3).any():
        k = int(np.argmax(np.abs(length - 1)))
        raise BadInput(
            f"the quaternion of the base has length {length[k]:.6g}",
            where=table.where(k),
            allowed="1",
        )
    place[:, 3:] = quaternion / length[:, None]
    return place
