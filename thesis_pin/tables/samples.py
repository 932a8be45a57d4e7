"""Columns of a table as samples of a motion: how fine they are, and single bad ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.smoothing.noise import acceleration_noise, sample_noise
from thesis_pin.smoothing.outliers import outliers
from thesis_pin.smoothing.stated import Stated
from thesis_pin.tables.table import Column, Table
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_CLOSE = 1e-3  # of the usual step: rows nearer than this are two of the same instant
_MOST = 10  # pairs of rows that are named


@dataclass(frozen=True)
class Samples:
    """Samples of a motion.

    Attributes:
        table: Where they stand, for messages.
        time: Sample times [s].
        columns: By name [m] or [rad].
        turning: Names of those that are angles.
    """

    table: Table
    time: Column
    columns: Mapping[str, Column]
    turning: frozenset[str]

    def moves(self, name: str) -> bool:
        """Whether a column changes at all."""
        return bool(np.ptp(self.columns[name].values) > 0)


def quanta(samples: Samples, how: Stated) -> dict[str, float]:
    """Resolution of each column [m] or [rad]; one that never moves has that of its kind.

    Where nothing of its kind moves, zero is zero, and other values are as written.
    """
    moving: dict[bool, list[float]] = {True: [], False: []}
    for name, column in samples.columns.items():
        if samples.moves(name):
            moving[name in samples.turning].append(column.quantum)
    found = {}
    for name, column in samples.columns.items():
        turns, own = name in samples.turning, column.quantum
        if not samples.moves(name):
            own = float(np.median(moving[turns])) if moving[turns] else 0.0
        found[name] = max(own, how.angle if turns else how.length)
    return found


def errors(samples: Samples, resolved: Mapping[str, float]) -> Iterator[tuple[str, float, float]]:
    """By how much curves through every sample would be wrong, and may be.

    Args:
        samples: The samples.
        resolved: Of :func:`quanta`.

    Yields:
        A column's name, the error of its second derivative [m/s²] or [rad/s²], the limit.
    """
    time = samples.time.values
    step = float(np.diff(time).min())
    for name, column in samples.columns.items():
        if samples.moves(name):
            sigma = sample_noise(time, column.values, resolved[name], samples.time.quantum)
            turns = name in samples.turning
            limit = TOLERANCES.exact_turn if turns else TOLERANCES.exact_move
            yield name, acceleration_noise(sigma, step), limit


def exact(samples: Samples, resolved: Mapping[str, float]) -> bool:
    """Whether curves through every sample are as good as the samples."""
    return all(error <= limit for _, error, limit in errors(samples, resolved))


def warning(samples: Samples, resolved: Mapping[str, float]) -> Iterator[str]:
    """What interpolation as asked for makes of samples that aren't exact."""
    worst = max(errors(samples, resolved), key=lambda one: one[1] / one[2], default=None)
    if worst is not None and worst[1] > worst[2]:
        unit = "rad/s²" if worst[0] in samples.turning else "m/s²"
        yield (
            f"curves pass through every sample as asked, though {worst[0]} doesn't resolve "
            f"accelerations below {worst[1]:.2g} {unit}; numbers may be those of rounding"
        )


def mended(samples: Samples) -> tuple[Samples, tuple[str, ...]]:
    """The samples without those that don't belong to their neighbours, and a note on each."""
    columns, notes = dict(samples.columns), []
    step = float(np.median(np.diff(samples.time.values)))
    for name, column in samples.columns.items():
        turns = name in samples.turning
        # A slow motion may well be written with one row at its turning point.
        least = (TOLERANCES.outlier_turn if turns else TOLERANCES.outlier_move) * step**2
        found = [one for one in outliers(column.values, column.quantum) if abs(one.error) > least]
        if not found:
            continue
        values = column.values.copy()
        for one in found:
            values[one.sample] -= one.error
            size = f"{np.degrees(one.error):.3g}°" if turns else f"{one.error * 1e3:.3g} mm"
            notes.append(
                f"{samples.table.where(one.sample)}: {name} is {size} off its neighbours, an "
                "outlier; what they say stands in for it"
            )
        columns[name] = replace(column, values=values)
    return replace(samples, columns=columns), tuple(notes)


def close_rows(samples: Samples) -> Iterator[str]:
    """A note on each pair of rows that are nearly at one time."""
    steps = np.diff(samples.time.values)
    for row in np.flatnonzero(steps < _CLOSE * np.median(steps))[:_MOST]:
        yield (
            f"{samples.table.between((int(row), int(row) + 1))}: these rows are only "
            f"{steps[row]:.2g} s apart"
        )
