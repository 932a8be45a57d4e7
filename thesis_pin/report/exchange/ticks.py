"""Servo ticks: what a board sends its servos for the joints' angles.

A servo's file, in TOML::

    format = 1
    [servos]                 # of all joints
    zero = 1500              # ticks at angle zero
    ticks_per_turn = 4000
    direction = 1            # or -1
    lowest = 500
    highest = 2500
    [joints.left_knee_pitch] # what is different about one
    zero = 1480

What is left out is the usual hobby servo: pulses of 500 to 2500 µs for −90° to 90°.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import TrajectoryError, UnknownName
from thesis_pin.model.limits import Key
from thesis_pin.model.strict import Positive, Strict

Array = NDArray[np.float64]


class Servo(Strict):
    """How one servo counts; None takes what all have."""

    zero: float | None = None
    ticks_per_turn: Positive | None = None
    direction: Literal[1, -1] | None = None
    lowest: float | None = None
    highest: float | None = None


_USUAL = {
    "zero": 1500.0,
    "ticks_per_turn": 4000.0,
    "direction": 1.0,
    "lowest": 500.0,
    "highest": 2500.0,
}


class ServosFile(Strict):
    """The format of a file of servos."""

    format: Literal[1]
    servos: Servo = Servo()
    joints: Mapping[str, Servo] = {}

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Ranges aren't empty."""
        for name in ("", *self.joints):
            one = self.of(name)
            if one["lowest"] >= one["highest"]:
                key: Key = ("joints", name, "highest") if name else ("servos", "highest")
                yield key, f"must exceed lowest, {one['lowest']:g}", one["highest"]

    def of(self, joint: str) -> dict[str, float]:
        """How the servo of a joint counts."""
        values = dict(_USUAL)
        for servo in (self.servos, self.joints.get(joint)):
            if servo is not None:
                said: dict[str, Any] = servo.model_dump()
                values |= {key: value for key, value in said.items() if value is not None}
        return values


USUAL = ServosFile.made(format=1)
"""Pulses of 500 to 2500 µs for −90° to 90°."""


def read_servos(file: str | Path, joints: Sequence[str]) -> ServosFile:
    """A file of servos; see the head of this module.

    Raises:
        SpecificationError: It breaks the format; carries every problem.
        UnknownName: It speaks of a joint that isn't one of ``joints``.
    """
    from thesis_pin.model.specification import read_toml

    found = read_toml("servo file", ServosFile, file)
    for name in found.joints:
        if name not in joints:
            raise UnknownName("joint", name, joints, where=str(file))
    return found


def ticks(
    joints: Sequence[str], time: Array, angles: Array, servos: ServosFile = USUAL
) -> dict[str, Sequence[str]]:
    """Whole ticks of each joint at each sample: column → texts.

    Args:
        joints: Names of the joints, ``k`` of them.
        time: Sample times [s], shape ``(n,)``, for messages.
        angles: [rad], shape ``(n, k)``.
        servos: How their servos count.

    Raises:
        TrajectoryError: A servo can't turn that far; names joint and time.
    """
    columns: dict[str, Sequence[str]] = {}
    for name, values, outside in _counted(joints, angles, servos):
        if outside.any():
            k, one = int(np.argmax(outside)), servos.of(name)
            raise TrajectoryError(
                f"{name} needs {values[k]:.0f} ticks",
                where=f"t = {time[k]:.6g} s",
                allowed=f"{one['lowest']:g} to {one['highest']:g}",
                remedy="Give the servos' ranges in a file",
            )
        columns[f"{name}_ticks"] = [f"{value:.0f}" for value in values]
    return columns


def ticks_where_possible(joints: Sequence[str], angles: Array) -> dict[str, Sequence[str]]:
    """The same for usual servos; cells are empty where one can't turn that far."""
    return {
        f"{name}_ticks": [
            "" if out else f"{value:.0f}" for value, out in zip(values, outside, strict=True)
        ]
        for name, values, outside in _counted(joints, angles, USUAL)
    }


def _counted(
    joints: Sequence[str], angles: Array, servos: ServosFile
) -> Iterator[tuple[str, Array, NDArray[np.bool_]]]:
    for k, name in enumerate(joints):
        one = servos.of(name)
        turns = one["direction"] * angles[:, k] / (2 * np.pi)
        values = np.rint(one["zero"] + one["ticks_per_turn"] * turns) + 0.0
        yield name, values, (values < one["lowest"]) | (values > one["highest"])
