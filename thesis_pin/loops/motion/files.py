"""Motion of some joints from a table, for any robot.

A header with ``t`` [s] and, for each joint, ``NAME``; where they are known also
``NAME_rate`` and ``NAME_acceleration``. Units are SI; an ending says others: ``t_ms``,
``NAME_deg``, ``NAME_mm``, ``NAME_rate_deg_s``, ``NAME_acceleration_mm_s2``. ``NAME`` is a joint's
or a motor's; either way the coordinate is the joint's. Of a free root: ``base_x``, ``base_y``,
``base_z`` and ``base_roll``, ``base_pitch``, ``base_yaw`` (about the world's x, y, z, in
that order), or the quaternion ``base_qx``, ``base_qy``, ``base_qz``, ``base_qw``, and where they
are known the rates and accelerations of all of them, as ``base_x_rate``: derivatives of the
columns. How the table may be written is said in :mod:`thesis_pin.tables`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, TrajectoryError, UnknownName
from thesis_pin.files import name_as_text
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.base import (
    BASE_ANGLES,
    BASE_PARTS,
    BASE_PLACE,
    BASE_QUATERNION,
    odd_rates,
    read_flight,
)
from thesis_pin.loops.motion.sampled import unlike, unwound, with_derivatives
from thesis_pin.loops.motion.smoothing import within_resolution
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.smoothing.stated import stated
from thesis_pin.tables.doubts import doubted
from thesis_pin.tables.meaning import Chosen, Meaning, chosen, time_column, time_names
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.samples import Samples, close_rows, exact, mended, quanta, warning
from thesis_pin.tables.table import Column, Table
from thesis_pin.tables.units import ANGLE, LENGTH, PLAIN, headings

Array = NDArray[np.float64]

_ORDERS = (("", ""), ("_rate", "_s"), ("_acceleration", "_s2"))
LEAST = 12
"""Rows below which nothing is known of their noise: curves pass through them."""


def read_motion(robot: ClosedRobot, file: str | Path, *, smooth: str = "auto") -> JointMotion:
    """A motion of a robot's joints from CSV; see the head of this module.

    Args:
        robot: The robot, for the names of its joints and motors.
        file: The file.
        smooth: Of columns whose rates aren't given: ``auto`` takes their samples for as fine
            as they show themselves to be, ``none`` for exact, and a length such as ``0.1mm``,
            an angle such as ``0.05deg`` or both with a comma for no finer than that.

    Raises:
        BadInput: ``smooth`` is none of these, the file can't be read, a column is missing or
            means two things, a cell isn't a number.
        UnknownName: A column is none of the robot's.
        TrajectoryError: Time doesn't increase, or there are too few samples.
    """
    how = stated(smooth)
    table = read_table("motion", file)
    columns = _columns(robot, table)
    if len(table) < 2:
        raise TrajectoryError(f"{len(table)} samples", where=table.file, allowed="at least 2")
    time = time_column(table, columns)
    values = {
        key: table.column(*place, key[0] + _ORDERS[key[1]][0])
        for key, place in columns.items()
        if isinstance(key, tuple)
    }
    kinds = singles(robot.model)
    joints = tuple(dict.fromkeys(of for of, _ in values if of in kinds))
    if not joints:
        raise BadInput("no column is a joint's", where=table.file, allowed=", ".join(kinds))
    asked = doubted(
        table.file,
        _at(values, [*(joint for joint in joints if not kinds[joint].turns), *BASE_PLACE]),
        _at(
            values,
            [
                *(one for one in joints if kinds[one].turns and kinds[one].high < np.inf),
                *BASE_ANGLES,
            ],
        ),
    )
    warnings = []
    for joint in joints:
        if kinds[joint].turns:
            found, doubts = unwound(joint, values[joint, 0].values)
            values[joint, 0] = replace(values[joint, 0], values=found)
            warnings += doubts
        warnings += unlike(
            joint, time.values, [values[joint, o] for o in range(3) if (joint, o) in values]
        )
    warnings += odd_rates(values, time.values)
    read = _differentiated(robot, table, time, values)
    friction = bool(robot.model.upperDryFrictionLimit.any())
    resolved, notes = quanta(read, how), [*table.dialect.notes, *asked]
    through = how.through or len(table) < LEAST
    if through:
        warnings += warning(read, resolved, friction)
    else:
        read, mending = mended(read)
        notes += [*mending, *close_rows(read)]
        values |= {
            key: read.columns[one.name] for key, one in values.items() if one.name in read.columns
        }
    motion = _splined(values, joints, table, time.values)
    motion = replace(motion, warnings=tuple(warnings), notes=tuple(notes))
    if through or exact(read, resolved, friction):
        return motion
    return within_resolution(motion, read, resolved, read_flight(values, table))


def _at(values: Mapping[tuple[str, int], Column], names: Sequence[str]) -> list[Column]:
    """Columns of positions, of those that are there."""
    return [values[name, 0] for name in names if (name, 0) in values]


def _given(values: Mapping[tuple[str, int], Column], joint: str) -> list[Array | None]:
    """Rates and accelerations of a joint, as far as columns hold them."""
    return [values[joint, o].values if (joint, o) in values else None for o in (1, 2)]


def _splined(
    values: Mapping[tuple[str, int], Column], joints: tuple[str, ...], table: Table, time: Array
) -> JointMotion:
    """The motion through every sample."""
    position, rate, acceleration = np.empty((3, len(time), len(joints)))
    interpolated = []
    for j, joint in enumerate(joints):
        given = _given(values, joint)
        if given[1] is None and len(time) < 4:
            raise TrajectoryError(
                f"{len(time)} samples of {joint!r} without {joint}_rate and {joint}_acceleration",
                where=table.file,
                allowed="at least 4",
            )
        position[:, j] = values[joint, 0].values
        rate[:, j], acceleration[:, j] = with_derivatives(time, position[:, j], *given)
        if given[1] is None:
            interpolated.append(joint)
    flight = read_flight(values, table)
    if flight is not None and flight.change[1] is None:
        if len(time) < 4:
            raise TrajectoryError(
                f"{len(time)} samples of the base without its rates and accelerations",
                where=table.file,
                allowed="at least 4",
            )
        interpolated.append("base")
    change = None if flight is None else flight.derivatives(time)
    return JointMotion(
        name_as_text(Path(table.file).name),
        time,
        joints,
        position,
        rate,
        acceleration,
        None if flight is None else flight.base,
        tuple(interpolated),
        base_change=change,
    )


def _differentiated(
    robot: ClosedRobot, table: Table, time: Column, values: Mapping[tuple[str, int], Column]
) -> Samples:
    """The columns of which rates or accelerations are made."""
    kinds, columns, turning = singles(robot.model), {}, set()
    for (of, order), column in values.items():
        if order == 2 or (of, order + 1) in values:
            continue
        columns[column.name] = column
        if kinds[of].turns if of in kinds else of not in BASE_PLACE:
            turning.add(column.name)
    rates = {column.name for (_, order), column in values.items() if order == 1}
    return Samples(table, time, columns, frozenset(turning), frozenset(rates))


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
                for order, (word, per) in enumerate(_ORDERS):
                    for heading, unit in headings(part + word, units, per).items():
                        meaning = Meaning((part, order), unit, part + word)
                        known.setdefault(heading, []).append(meaning)
    return known


def _columns(robot: ClosedRobot, table: Table) -> Chosen:
    """Which column holds which derivative of which joint or part of the base."""
    known, base = _known(robot), BASE_PARTS if len(robot.base) else ()
    allowed = ["t", *singles(robot.model), *base, "NAME_rate", "NAME_acceleration"]
    flies = [one for one in table.header if one.startswith(BASE_PARTS) and one not in known]
    if flies and not base:
        raise UnknownName(
            "column",
            flies[0],
            allowed,
            where=table.file,
            remedy="The base's columns are of a free root, and this robot's is fixed: "
            "--free-flyer lets it fly, in Python root_joint=pin.JointModelFreeFlyer()",
        )
    columns, _ = chosen(table, known, allowed)
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
