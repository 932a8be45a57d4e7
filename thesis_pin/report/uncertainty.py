"""What samples of finite resolution leave open of a report's numbers: in words, as data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.resolution import fault, how_fine, size
from thesis_pin.report.tables import Table
from thesis_pin.smoothing.intervals import SPREAD, Interval, largest_value
from thesis_pin.smoothing.resolution import Resolution

Array = NDArray[np.float64]

LOST = 0.5
"""Share of draws that may fail before nothing is decided."""

PEAK = 2e-4
"""What the grid of samples may miss of a peak, relative."""


def few_draws(lost: int, left: int) -> bool:
    """Whether most motions that the samples leave open can't be worked out."""
    return lost > LOST * (lost + left)


def peaks(own: Array, rival: Array, draws: Array, more: Array | float = 0.0) -> list[Interval]:
    """Intervals of the largest sizes over a motion.

    Args:
        own: Sizes by the motion's own curves, shape ``(k, joints)``.
        rival: By the rival's, the same shape.
        draws: By the draws, ``(draws, k, joints)``.
        more: What may come on top of them, such as friction that nobody knows.
    """
    value, beside = own.max(axis=0, initial=0.0), rival.max(axis=0, initial=0.0)
    each, most = draws.max(axis=1, initial=0.0), (own + more).max(axis=0, initial=0.0)
    return [
        largest_value(float(v), float(r), d, most=float(m), slack=PEAK)
        for v, r, d, m in zip(value, beside, each.T, most, strict=True)
    ]


def band(own: Array, rival: Array, draws: Array, more: Array | float = 0.0) -> Array:
    """From and to at each sample, for plots; arguments as in :func:`peaks`, ``(2, k, …)``."""
    spread = SPREAD * draws.std(axis=0, ddof=1) if len(draws) > 1 else np.zeros(own.shape)
    half = spread + np.abs(rival - own) + more
    return np.stack([own - half, own + half])


def measured(held: Interval, unit: str, digits: str = ".3f") -> str:
    """``0.341 N·m, between 0.338 and 0.357``."""
    value, low, high = (format(x, digits) for x in (held.value, held.low, held.high))
    return f"{value} {unit}, between {low} and {high}"


def culprit(columns: Sequence[Resolution], found: Array) -> tuple[Resolution, float] | None:
    """The column that makes most of what is open, and its share; None if it can't be told.

    Args:
        columns: What each column resolves.
        found: The number with one column after the other drawn, shape ``(columns, draws)``.
    """
    variance = found.var(axis=1)
    if not variance.sum() > 0:
        return None
    k = int(np.argmax(variance))
    return columns[k], float(variance[k] / variance.sum())


def why(found: tuple[Resolution, float] | None, rate: float, held: Interval, limit: float) -> str:
    """Whose fault it is that an interval holds a limit, and what would help."""
    if found is None:
        return "finer samples are needed"
    column, share = found
    needed = size(column.needed(held, limit), column.turns)
    return fault(column.name, _fine(column, rate), share, needed)


def _fine(column: Resolution, rate: float) -> str:
    return how_fine(column.quantum, column.noise, column.turns, rate)


def ends(one: Interval) -> dict[str, float]:
    """An interval, JSON-ready."""
    return {"value": one.value, "low": one.low, "high": one.high}


def columns_document(columns: Sequence[Resolution]) -> list[dict[str, object]]:
    """What each column resolves, JSON-ready."""
    return [
        {"name": one.name, "resolution": one.quantum, "noise": one.noise, "moves": one.moves}
        for one in columns
    ]


def columns_table(columns: Sequence[Resolution], rate: float) -> Table:
    """What each column of the samples resolves."""
    moving = [one for one in columns if one.moves]
    told = {
        "column": [one.name for one in moving],
        "samples": [_fine(one, rate) for one in moving],
    }
    rows = list(zip(*told.values(), strict=True))
    return Table("What the samples resolve", list(told), rows, prose=True)
