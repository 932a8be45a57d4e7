"""A motion of either robot in the forms that other programs read."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.report.exchange.joint_trajectory import (
    JointStates,
    apart,
    joint_trajectory_yaml,
)
from thesis_pin.report.exchange.ticks import USUAL, ServosFile, ticks, ticks_where_possible
from thesis_pin.report.writers import csv_bytes
from thesis_pin.tables.writing import WrittenUnits, heading, texts

Array = NDArray[np.float64]

FORMS = ("poses", "joints", "toml", "joint-trajectory", "ticks")
"""What a motion can be written as."""

_BY_ENDING = {".csv": "poses", ".tsv": "poses", ".toml": "toml", ".yaml": "joint-trajectory"}
_BY_ENDING |= {".yml": "joint-trajectory"}


@dataclass(frozen=True, eq=False)
class Movement:
    """A motion at some times.

    Attributes:
        time: Sample times [s], shape ``(n,)``.
        words: Columns of words, by name.
        poses: Columns of poses, by name: whether a length or an angle, and values in SI.
        joints: Names of the joints.
        angles: Works their angles out [rad], shape ``(n, joints)``.
        states: Works out everything about them.
        toml: Writes it in our own format, in some units.
        curves: Whether that holds curves, piece by piece, and no samples.
    """

    time: Array
    words: Mapping[str, Sequence[str]]
    poses: Mapping[str, tuple[Literal["length", "angle"], Array]]
    joints: Sequence[str]
    angles: Callable[[], Array]
    states: Callable[[], JointStates]
    toml: Callable[[WrittenUnits], str]
    curves: bool = False


def form_of(file: str, form: str | None) -> str:
    """What a file is to hold: what was asked for, or what its ending says.

    Raises:
        BadInput: Neither says it.
    """
    if form is not None:
        return form
    ending = file[file.rfind(".") :].lower() if "." in file else ""
    if ending not in _BY_ENDING:
        raise BadInput(
            f"{file!r} doesn't say what to write",
            allowed=f"an ending of {', '.join(_BY_ENDING)}, or --as {'|'.join(FORMS)}",
        )
    return _BY_ENDING[ending]


def content(
    movement: Movement,
    form: str,
    units: WrittenUnits | None = None,
    servos: ServosFile = USUAL,
    *,
    tabs: bool = False,
) -> bytes:
    """A motion as a file's content.

    Args:
        movement: The motion.
        form: One of :data:`FORMS`.
        units: Units of tables and of our own format; None is SI.
        servos: How the servos count, for ticks.
        tabs: Whether tabs stand between the cells of a table rather than commas.
    """
    if tabs and form in ("poses", "joints", "ticks"):  # no cell of which holds a comma
        return content(movement, form, units, servos).replace(b",", b"\t")
    units = WrittenUnits() if units is None else units
    if form == "toml":
        return movement.toml(units).encode()
    if form == "joint-trajectory":
        return joint_trajectory_yaml(movement.states())
    columns: dict[str, Sequence[str]] = {heading("t", units.time): texts(movement.time, units.time)}
    if form == "ticks":
        angles = movement.angles()
        return csv_bytes(columns | ticks(movement.joints, movement.time, angles, servos))
    columns |= movement.words
    if form == "joints":
        angles = movement.angles()
        for k, name in enumerate(movement.joints):
            columns[heading(name, units.angle)] = texts(angles[:, k], units.angle)
        return csv_bytes(columns)
    for name, (kind, values) in movement.poses.items():
        unit = units.length if kind == "length" else units.angle
        columns[heading(name, unit)] = texts(values, unit)
    return csv_bytes(columns)


def exchange_files(states: JointStates) -> dict[str, bytes]:
    """What stands beside every report: the joints' trajectory for ROS, and usual servos' ticks."""
    kept = apart(states.time)
    columns: dict[str, Sequence[str]] = {"t": texts(states.time[kept], WrittenUnits().time)}
    columns |= ticks_where_possible(states.names, states.position[kept])
    return {
        "joint_trajectory.yaml": joint_trajectory_yaml(states),
        "ticks.csv": csv_bytes(columns),
    }
