"""What each actuator of a robot has to do over a motion."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.report.cells import table_cell
from thesis_pin.report.tables import Table

ROUNDING = 1e-9
"""Share of a column's largest number below which tables for notebooks say 0."""


@dataclass(frozen=True)
class ActuatorSummary(Brief):
    """What each actuator has to do over a motion; arrays of shape ``(k,)``.

    Attributes:
        names: Actuator names.
        peak_torque: Largest |τ| [N·m].
        rms_torque: Root mean square of τ over time [N·m].
        peak_speed: Largest |θ̇| [rad/s].
        peak_power: Largest |τ θ̇| [W].
        positive_work: Work given to the mechanism [J].
        negative_work: Work taken from it [J], ≤ 0.
    """

    names: tuple[str, ...]
    peak_torque: np.ndarray
    rms_torque: np.ndarray
    peak_speed: np.ndarray
    peak_power: np.ndarray
    positive_work: np.ndarray
    negative_work: np.ndarray

    def table(self, units: Sequence[tuple[str, str]] | None = None) -> Table:
        """The same as a table.

        Args:
            units: Of each actuator's load and speed; None where all turn.
        """
        units = units or [("N·m", "rad/s")] * len(self.names)
        load, speed = ([pair[k] for pair in units] for k in (0, 1))
        watts, joules = ["W"] * len(units), ["J"] * len(units)
        columns = {
            "motor": self.names,
            "peak": _texts(self.peak_torque, load),
            "RMS": _texts(self.rms_torque, load),
            "peak speed": _texts(self.peak_speed, speed),
            "peak power": _texts(self.peak_power, watts),
            "net work": _texts(self.net_work, joules, self.positive_work),
        }
        return Table.of("Motors", columns)

    def _cell(self) -> Cell:
        return table_cell(self.table())

    def document(self) -> dict[str, np.ndarray]:
        """JSON-ready, without the names."""
        own = {name: values for name, values in vars(self).items() if name != "names"}
        return {**own, "net_work": self.net_work}

    @property
    def net_work(self) -> np.ndarray:
        """Work given minus work taken back [J]."""
        return np.asarray(self.positive_work + self.negative_work)


def _texts(values: np.ndarray, units: Sequence[str], size: np.ndarray | None = None) -> list[str]:
    """Numbers with units, 0 for what is only rounding beside the largest of a column."""
    least = ROUNDING * np.abs(values if size is None else size).max(initial=0.0)
    told = np.where(np.abs(values) <= least, 0.0, values)
    return [f"{x:z.4g} {unit}" for x, unit in zip(told, units, strict=True)]


def summarise(
    names: Sequence[str], time: np.ndarray, torque: np.ndarray, speed: np.ndarray
) -> ActuatorSummary:
    """Summary of sampled torques and speeds.

    Integrals over time use the trapezoidal rule on the samples.

    Args:
        names: Actuator names, k of them.
        time: Sample times [s], shape ``(n,)``.
        torque: τ [N·m], shape ``(n, k)``.
        speed: θ̇ [rad/s], shape ``(n, k)``.
    """
    return summarise_parts(names, [(time, torque, speed)])


def summarise_parts(
    names: Sequence[str], parts: Iterable[tuple[np.ndarray, np.ndarray, np.ndarray]]
) -> ActuatorSummary:
    """:func:`summarise` of a motion in parts, of which only one at a time is in memory.

    Args:
        names: Actuator names, k of them.
        parts: Time ``(m,)``, torque and speed ``(m, k)`` of consecutive samples; each
            part begins with the last sample of the one before.
    """
    peaks: list[np.ndarray] = []  # of torque, speed, power
    sums: list[np.ndarray] = []  # integrals of τ², of work given, of work taken
    duration = 0.0
    for time, torque, speed in parts:
        power = torque * speed
        highest = [np.abs(values).max(axis=0) for values in (torque, speed, power)]
        integrands = (torque**2, np.maximum(power, 0.0), np.minimum(power, 0.0))
        areas = [np.trapezoid(values, time, axis=0) for values in integrands]
        peaks = [np.maximum(a, b) for a, b in zip(peaks or highest, highest, strict=True)]
        sums = [a + b for a, b in zip(sums, areas, strict=True)] if sums else areas
        duration += float(time[-1] - time[0])
    return ActuatorSummary(
        names=tuple(names),
        peak_torque=peaks[0],
        rms_torque=np.sqrt(sums[0] / duration),
        peak_speed=peaks[1],
        peak_power=peaks[2],
        positive_work=sums[1],
        negative_work=sums[2],
    )
