"""Motion of some joints from a table, for any robot.

A header with ``t`` [s] and, for each joint, ``NAME``; where they are known also
``NAME_rate`` and ``NAME_acceleration``. Units are SI; an ending says others: ``t_ms``,
``NAME_deg``, ``NAME_mm``, ``NAME_rate_deg_s``, ``NAME_acceleration_mm_s2``. ``NAME`` is a joint's
or a motor's; either way the coordinate is the joint's. Of a free root: ``base_x``, ``base_y``,
``base_z`` and ``base_roll``, ``base_pitch``, ``base_yaw`` (about the world's x, y, z, in
that order), or the quaternion ``base_qx``, ``base_qy``, ``base_qz``, ``base_qw``, and where they
are known the rates and accelerations of all of them, as ``base_x_rate``: derivatives of the
columns. Of a frame that leads the robot: ``x``, ``y``, ``z`` and an orientation as
:data:`thesis_pin.tables.orientations.FORMS` has it, or as many of them as the robot has freedoms.
How the table may be written is said in :mod:`thesis_pin.tables`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.counted import counted
from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.files import name_as_text
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.base import (
    BASE_ANGLES,
    BASE_PLACE,
    Flight,
    odd_rates,
    read_flight,
)
from thesis_pin.loops.motion.columns import ORDERS, columns_of
from thesis_pin.loops.motion.leading import Names, left_to_the_robot, read_lead, without_turns
from thesis_pin.loops.motion.sampled import unlike, unwound, with_derivatives
from thesis_pin.loops.motion.smoothing import within_resolution
from thesis_pin.loops.motion.told import JointMotion, Tool
from thesis_pin.model.loading import frame_id
from thesis_pin.numeric.checks import shown
from thesis_pin.smoothing.stated import stated
from thesis_pin.tables.doubts import doubted
from thesis_pin.tables.meaning import time_column
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.samples import Samples, close_rows, exact, mended, quanta, warning
from thesis_pin.tables.table import Column, Table

Array = NDArray[np.float64]

LEAST = 12
"""Rows below which nothing is known of their noise: curves pass through them."""


def read_motion(
    robot: ClosedRobot,
    file: str | Path,
    *,
    smooth: str = "auto",
    frame: str | None = None,
    euler: str | None = None,
    beside: Sequence[str] = (),
) -> JointMotion:
    """A motion of a robot's joints, or of a frame of it, from CSV; see the head of this module.

    Args:
        robot: The robot, for the names of its joints and motors.
        file: The file.
        smooth: Of columns whose rates aren't given: ``auto`` takes their samples for as fine
            as they show themselves to be, ``none`` for exact, and a length such as ``0.1mm``,
            an angle such as ``0.05deg`` or both with a comma for no finer than that.
        frame: Name of the frame that the file leads through the world; None if it leads joints.
        euler: Order of the angles in columns a, b, c or rx, ry, rz; see
            :func:`thesis_pin.tables.orientations.check_order`.
        beside: Headings of columns that may stand beside these, for other readers.

    Raises:
        BadInput: ``smooth`` is none of these, the file can't be read, a column is missing or
            means two things, a cell isn't a number.
        UnknownName: A column is none of the robot's, or the frame isn't.
        TrajectoryError: Time doesn't increase, or there are too few samples.
    """
    how = stated(smooth)
    lead = _lead(robot, frame, euler)
    table = read_table("motion", file)
    columns = columns_of(robot, table, lead, beside)
    if len(table) < 2:
        raise TrajectoryError(counted(len(table), "sample"), where=table.file, allowed="at least 2")
    time = time_column(table, columns)
    values = {
        key: table.column(*place, key[0] + ORDERS[key[1]][0])
        for key, place in columns.items()
        if isinstance(key, tuple)
    }
    kinds = singles(robot.model)
    joints = tuple(dict.fromkeys(of for of, _ in values if of in kinds))
    tool, said = None, list[str]()
    if lead is not None:
        without_turns(values, lead)
        _, tool, said = _led(robot, values, table, lead, euler)
    elif not joints:
        raise BadInput("no column is a joint's", where=table.file, allowed=", ".join(kinds))
    placed = BASE_PLACE if lead is None else lead("x", "y", "z")
    asked = _doubted(robot, table, values, joints, lead)
    warnings = _unwound(robot, values, joints, time.values) + odd_rates(values, time.values)
    read = _differentiated(robot, table, time, values, placed)
    friction = bool(robot.model.upperDryFrictionLimit.any())
    resolved, notes = quanta(read, how), [*table.dialect.notes, *asked, *said]
    through = how.through or len(table) < LEAST
    if through:
        warnings += warning(read, resolved, friction)
    else:
        read, mending = mended(read)
        notes += [*mending, *close_rows(read)]
        values |= {
            key: read.columns[one.name] for key, one in values.items() if one.name in read.columns
        }
    if lead is None:
        flight = read_flight(values, table)
    else:
        flight, _, _ = _led(robot, values, table, lead, euler)
    motion = _splined(values, joints, table, time.values, flight)
    motion = replace(
        motion,
        warnings=tuple(warnings),
        notes=tuple(notes),
        tool=tool,
        lines=table.lines,
    )
    if through or exact(read, resolved, friction):
        return motion
    return within_resolution(motion, read, resolved, flight)


def _led(
    robot: ClosedRobot,
    values: Mapping[tuple[str, int], Column],
    table: Table,
    lead: Names,
    euler: str | None,
) -> tuple[Flight, Tool, list[str]]:
    """How the frame that leads moves, what of it is told, and what is to be said."""
    flight, told, notes = read_lead(values, table, lead, euler)
    beside = {of for of, _ in values} & {*singles(robot.model)}
    freedoms = len(robot.actuators or singles(robot.model)) - len(beside)
    flight, tool, said = left_to_the_robot(flight, told, values, lead, freedoms)
    return flight, tool, notes + said


def _lead(robot: ClosedRobot, frame: str | None, euler: str | None) -> Names | None:
    """What columns of the frame that leads are called; None if none leads."""
    if frame is None:
        if euler is not None:
            raise BadInput("an order of angles is given, and no frame", remedy="Name the frame")
        return None
    frame_id(robot.model, frame)
    if len(robot.base):
        raise BadInput(
            f"frame {shown(frame)} can't lead a robot whose root flies freely",
            remedy="Tell the base and the joints, or fix the root",
        )
    return Names.of(frame, singles(robot.model))


def _doubted(
    robot: ClosedRobot,
    table: Table,
    values: Mapping[tuple[str, int], Column],
    joints: Sequence[str],
    lead: Names | None,
) -> tuple[str, ...]:
    """What is to be asked of positions that may be in another unit."""
    kinds = singles(robot.model)
    slides = [joint for joint in joints if not kinds[joint].turns]
    turns = [joint for joint in joints if kinds[joint].turns and kinds[joint].high < np.inf]
    places = BASE_PLACE if lead is None else lead("x", "y", "z")
    angles = BASE_ANGLES if lead is None else lead.turning()
    return doubted(table.file, _at(values, [*slides, *places]), _at(values, [*turns, *angles]))


def _unwound(
    robot: ClosedRobot,
    values: dict[tuple[str, int], Column],
    joints: Sequence[str],
    time: Array,
) -> list[str]:
    """Unwind the joints' angles in place; returns what is to be warned of."""
    kinds, warnings = singles(robot.model), list[str]()
    for joint in joints:
        if kinds[joint].turns:
            found, doubts = unwound(joint, values[joint, 0].values)
            values[joint, 0] = replace(values[joint, 0], values=found)
            warnings += doubts
        orders = [values[joint, o] for o in range(3) if (joint, o) in values]
        warnings += unlike(joint, time, orders)
    return warnings


def _at(values: Mapping[tuple[str, int], Column], names: Sequence[str]) -> list[Column]:
    """Columns of positions, of those that are there."""
    return [values[name, 0] for name in names if (name, 0) in values]


def _given(values: Mapping[tuple[str, int], Column], joint: str) -> list[Array | None]:
    """Rates and accelerations of a joint, as far as columns hold them."""
    return [values[joint, o].values if (joint, o) in values else None for o in (1, 2)]


def _splined(
    values: Mapping[tuple[str, int], Column],
    joints: tuple[str, ...],
    table: Table,
    time: Array,
    flight: Flight | None,
) -> JointMotion:
    """The motion through every sample."""
    position, rate, acceleration = np.empty((3, len(time), len(joints)))
    interpolated = []
    for j, joint in enumerate(joints):
        given = _given(values, joint)
        if given[1] is None and len(time) < 4:
            raise TrajectoryError(
                f"{counted(len(time), 'sample')} of {joint!r} without {joint}_rate "
                f"and {joint}_acceleration",
                where=table.file,
                allowed="at least 4",
            )
        position[:, j] = values[joint, 0].values
        rate[:, j], acceleration[:, j] = with_derivatives(time, position[:, j], *given)
        if given[1] is None:
            interpolated.append(joint)
    if flight is not None and flight.change[1] is None:
        moving = "the base" if flight.place == BASE_PLACE else "the frame"
        if len(time) < 4:
            raise TrajectoryError(
                f"{counted(len(time), 'sample')} of {moving} without its rates and accelerations",
                where=table.file,
                allowed="at least 4",
            )
        interpolated.append("base" if moving == "the base" else moving)
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
    robot: ClosedRobot,
    table: Table,
    time: Column,
    values: Mapping[tuple[str, int], Column],
    placed: Sequence[str],
) -> Samples:
    """The columns of which rates or accelerations are made."""
    kinds, columns, turning = singles(robot.model), {}, set()
    for (of, order), column in values.items():
        if order == 2 or (of, order + 1) in values:
            continue
        columns[column.name] = column
        if kinds[of].turns if of in kinds else of not in placed:
            turning.add(column.name)
    rates = {column.name for (_, order), column in values.items() if order == 1}
    return Samples(table, time, columns, frozenset(turning), frozenset(rates))
