"""Columns of a table as samples of a motion: how fine they are, and single bad ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.smoothing.noise import acceleration_noise, rate_noise, sample_noise
from thesis_pin.smoothing.outliers import outliers
from thesis_pin.smoothing.stated import Stated
from thesis_pin.tables.table import Column, Table, alike
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_CLOSE = 1e-3  # of the usual step: rows nearer than this are two of the same instant
_ROUNDED = 0.6  # of a step of the text that rounding may leave about a curve
_FAR = 6.0  # times the usual distance from a curve that none of many samples of noise reaches
_MOST = 10  # pairs of rows that are named


@dataclass(frozen=True)
class Samples:
    """Samples of a motion.

    Attributes:
        table: Where they stand, for messages.
        time: Sample times [s].
        columns: By name [m] or [rad].
        turning: Names of those that are angles.
        rates: Names of those that are rates already [m/s] or [rad/s].
    """

    table: Table
    time: Column
    columns: Mapping[str, Column]
    turning: frozenset[str]
    rates: frozenset[str] = frozenset()

    def moves(self, name: str) -> bool:
        """Whether a column changes at all."""
        return bool(np.ptp(self.columns[name].values) > 0)


def quanta(samples: Samples, how: Stated) -> dict[str, float]:
    """Resolution of each column [m], [rad] or of a rate; see :func:`thesis_pin.tables.table.alike`.

    Where nothing of its kind moves, a column that doesn't either is as written.
    """
    found = {}
    for turns in (False, True):
        for rates in (False, True):
            names = [
                name
                for name in samples.columns
                if (name in samples.turning) == turns and (name in samples.rates) == rates
            ]
            stated = 0.0 if rates else how.angle if turns else how.length
            moves = any(samples.moves(name) for name in names)
            for name, column in zip(names, alike([samples.columns[n] for n in names]), strict=True):
                found[name] = max(column.quantum if moves else 0.0, stated)
    return found


def errors(
    samples: Samples, resolved: Mapping[str, float], friction: bool = False
) -> Iterator[tuple[str, float, float]]:
    """By how much curves through every sample would be wrong, and may be.

    Args:
        samples: The samples.
        resolved: Of :func:`quanta`.
        friction: Whether the sign of a wrong rate counts, where a joint rests.

    Yields:
        A column's name, the error of its acceleration [m/s²] or [rad/s²], the limit.
    """
    time = samples.time.values
    step = float(np.diff(time).min())
    for name, column in samples.columns.items():
        if not samples.moves(name):
            continue
        sigma = sample_noise(time, column.values, resolved[name], samples.time.quantum)
        limit = TOLERANCES.exact_turn if name in samples.turning else TOLERANCES.exact_move
        if name in samples.rates:
            yield name, rate_noise(sigma, step), limit
            continue
        if friction:
            limit = min(limit, acceleration_noise(TOLERANCES.exact_rate, 1.0) / step)
        yield name, acceleration_noise(sigma, step), limit


def exact(samples: Samples, resolved: Mapping[str, float], friction: bool = False) -> bool:
    """Whether curves through every sample are as good as the samples; see :func:`errors`."""
    return all(error <= limit for _, error, limit in errors(samples, resolved, friction))


def warning(
    samples: Samples, resolved: Mapping[str, float], friction: bool = False, asked: bool = False
) -> Iterator[str]:
    """What interpolation, maybe because it was asked for, makes of samples that aren't exact."""
    every = errors(samples, resolved, friction)
    worst = max(every, key=lambda one: one[1] / one[2], default=None)
    if worst is not None and worst[1] > worst[2]:
        unit = "rad/s²" if worst[0] in samples.turning else "m/s²"
        yield (
            f"curves pass through every sample{' as asked' * asked}, though {worst[0]} doesn't "
            f"resolve accelerations below {worst[1]:.2g} {unit}; numbers may be those of rounding"
        )


def mended(samples: Samples) -> tuple[Samples, tuple[str, ...]]:
    """The samples without those that don't belong to their neighbours, and a note on each.

    Rows that are ``node_step`` apart are nodes, and each is meant.
    """
    columns, notes = dict(samples.columns), []
    step = float(np.median(np.diff(samples.time.values)))
    if step >= TOLERANCES.node_step:
        return samples, ()
    for name, column in samples.columns.items():
        turns = name in samples.turning
        # A slow motion may well be written with one row at its turning point.
        least = (TOLERANCES.outlier_turn if turns else TOLERANCES.outlier_move) * step**2
        if name in samples.rates:
            least /= step
        found = outliers(column.values, column.quantum, least)
        if not found:
            continue
        values = column.values.copy()
        for one in found:
            values[one.sample] -= one.error
            size = f"{np.degrees(one.error):.3g}°" if turns else f"{one.error * 1e3:.3g} mm"
            size += "/s" if name in samples.rates else ""
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


def scatter(
    samples: Samples, resolved: Mapping[str, float], curves: Mapping[str, Array]
) -> tuple[bool, tuple[str, ...]]:
    """Whether what smooth curves leave out is motion, and a note on what it is taken for.

    Args:
        samples: The samples.
        resolved: Of :func:`quanta`.
        curves: Values of the curves at the samples, by the columns' names.

    Returns:
        True if rows are so far apart that their scatter is taken for motion.
    """
    largest = {True: 0.0, False: 0.0}
    names, step = [], float(np.median(np.diff(samples.time.values)))
    for name, values in curves.items():
        off, turns = np.abs(samples.columns[name].values - values), name in samples.turning
        usual, worst, quantum = float(np.sqrt(np.mean(off**2))), float(off.max()), resolved[name]
        # Rounding leaves a third of a step, half of one at most.
        left = usual > _ROUNDED * quantum or worst > max(1.5 * quantum, _FAR * usual)
        noise = rate_noise if name in samples.rates else acceleration_noise
        limit = TOLERANCES.exact_turn if turns else TOLERANCES.exact_move
        if left and noise(worst, step) > limit:
            names.append(name)
            largest[turns] = max(largest[turns], worst)
    if not names:
        return False, ()
    sizes = [f"{largest[False] * 1e3:.2g} mm"] * (largest[False] > 0)
    sizes += [f"{np.degrees(largest[True]):.2g}°"] * (largest[True] > 0)
    found = f"{', '.join(names)}: rows scatter about a smooth curve by up to {' and '.join(sizes)}"
    if step >= TOLERANCES.node_step:
        return True, (
            f"{found}, which at {step:.3g} s from row to row is taken for motion: curves pass "
            "through every row",
        )
    return False, (f"{found}, which is taken for noise; --smooth none takes it for motion",)
