"""How short a motion may be with which motor: of a list, or of a kind in growing sizes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.numeric.workers import silent
from thesis_pin.report.tables import Table
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.judging import by_size
from thesis_pin.sizing.loads import Array


@dataclass(frozen=True, eq=False)
class Timed(Brief):
    """The shortest time in which a motion can be done, motor by motor.

    Attributes:
        actuators: The motors, ``m`` of them.
        times: What a time is called → the time with each motor [s], shape ``(m,)``, NaN if the
            motor can't do the motion so; the shortest of all first.
        within: Time that was asked for [s]; None if any will do.
        notes: What has to be said, whole sentences.
    """

    actuators: tuple[Actuator, ...]
    times: Mapping[str, Array]
    within: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def fastest(self) -> Array:
        """Shortest time with each motor [s], ``(m,)``; NaN if it can't do the motion at all."""
        return next(iter(self.times.values()))

    @cached_property
    def able(self) -> list[bool]:
        """Whether each motor does the motion in the time that was asked for."""
        most = np.inf if self.within is None else self.within
        return [bool(one <= most) for one in self.fastest]  # NaN isn't

    @property
    def order(self) -> tuple[list[int], str]:
        """Numbers of the motors from the smallest on, and by what."""
        return by_size(self.actuators)

    @property
    def smallest(self) -> Actuator | None:
        """The smallest motor that does it in time."""
        return next((self.actuators[k] for k in self.order[0] if self.able[k]), None)

    @property
    def yes(self) -> bool:
        """Whether some motor does it in time."""
        return self.smallest is not None

    def verdict(self) -> list[str]:
        """The answer in sentences."""
        one, word, count = self.smallest, self.order[1], len(self.actuators)
        time = "" if self.within is None else f" in {self.within:.4g} s"
        if one is not None:
            best = self.fastest[self.actuators.index(one)]
            return [
                f"{one.name} is the smallest of {count} (by {word}) with which it can be done"
                f"{time}: it takes at least {best:.4g} s."
            ]
        said = [f"With no motor of {count} it can be done{time}."]
        if np.isfinite(self.fastest).any():
            k = int(np.nanargmin(self.fastest))
            said.append(f"{self.actuators[k].name} is the fastest: {self.fastest[k]:.4g} s.")
        return said

    def _cell(self) -> Cell:
        table = self.table()
        return Cell("Time against motor", self.verdict(), self.yes, table.columns, table.rows)

    def table(self) -> Table:
        """The motors from the smallest on, and how short the motion may be with each."""
        numbers = self.order[0]
        columns = {
            "motor": [self.actuators[k].name for k in numbers],
            "stall N·m": [f"{self.actuators[k].stall_torque:.4g}" for k in numbers],
            "rad/s": [f"{self.actuators[k].no_load_speed:.4g}" for k in numbers],
            **{
                f"{name} s": [_shown(values[k]) for k in numbers]
                for name, values in self.times.items()
            },
        }
        return Table.of("How short it may be", columns)

    def document(self) -> dict[str, object]:
        """JSON-ready; docs/sizing.md describes it."""
        one = self.smallest
        return {
            "motors": [
                {
                    "name": motor.name,
                    "stall_torque": motor.stall_torque,
                    "no_load_speed": motor.no_load_speed
                    if np.isfinite(motor.no_load_speed)
                    else None,
                    "armature": motor.armature,
                    "rating": motor.rating,
                    "mass": motor.mass,
                    "times": {name: _finite(values[k]) for name, values in self.times.items()},
                    "able": self.able[k],
                }
                for k, motor in enumerate(self.actuators)
            ],
            "within": self.within,
            "smallest": None if one is None else one.name,
            "by": self.order[1],
            "notes": list(self.notes),
        }

    def columns(self) -> dict[str, Array | list[str]]:
        """A row a motor."""
        return {
            "motor": ['"' + one.name.replace('"', '""') + '"' for one in self.actuators],
            "stall_torque_Nm": np.array([one.stall_torque for one in self.actuators]),
            "no_load_speed_rad_s": np.array([one.no_load_speed for one in self.actuators]),
            "armature_kgm2": np.array([one.armature for one in self.actuators]),
            **{f"{name}_s": values for name, values in self.times.items()},
        }


def timed(
    actuators: Sequence[Actuator],
    shortest: Callable[[Actuator], Mapping[str, float | None]],
    *,
    within: float | None = None,
    notes: Sequence[str] = (),
    progress: Callable[[int, int], None] = silent,
) -> Timed:
    """How short a motion may be with each of some motors.

    Args:
        actuators: The motors.
        shortest: Times with a motor [s], by what they are called, the shortest of all first; None
            where it can't be done so.
        within: Time that is asked for [s].
        notes: What has to be said.
        progress: Called with the motors done and their number.
    """
    rows: list[Mapping[str, float | None]] = []
    for one in actuators:
        progress(len(rows), len(actuators))
        rows.append(shortest(one))
    progress(len(rows), len(actuators))
    times = {
        name: np.array([np.nan if (time := row[name]) is None else time for row in rows])
        for name in rows[0]
    }
    return Timed(tuple(actuators), times, within, tuple(notes))


def sizes(least: float, count: int, most: float = 4.0) -> Iterator[float]:
    """Stall torques of a curve [N·m]: from the least to ``most`` times that, first finely."""
    yield least
    yield from (least * (1.0 + np.geomspace(0.01, most - 1.0, count - 1))).tolist()


def _shown(value: float) -> str:
    return "never" if np.isnan(value) else f"{value:.4g}"


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None
