"""What samples of finite resolution leave open of a report's numbers: in words, as data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.tables import Table
from thesis_pin.smoothing.intervals import SPREAD, Interval, largest_value
from thesis_pin.smoothing.noise import ROUNDING
from thesis_pin.smoothing.resolution import Resolution

Array = NDArray[np.float64]

LOST = 0.5
"""Share of draws that may fail before nothing is decided."""

PEAK = 2e-4
"""What the grid of samples may miss of a peak, relative."""

_WRITTEN = 1.5  # how many times rounding's own noise still is rounding


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


def percent(held: Interval) -> str:
    """``98%, between 96% and 101%``; ``98%`` where they are the same."""
    value, low, high = (f"{x:.0%}" for x in (held.value, held.low, held.high))
    return value if low == high else f"{value}, between {low} and {high}"


def measured(held: Interval, unit: str, digits: str = ".3f") -> str:
    """``0.341 N·m, between 0.338 and 0.357``."""
    value, low, high = (format(x, digits) for x in (held.value, held.low, held.high))
    return f"{value} {unit}, between {low} and {high}"


def resolution(size: float, turns: bool) -> str:
    """A length or angle in a unit that suits it: ``0.1 mm``, ``1 µm``, ``0.01°``."""
    if turns:
        return f"{np.degrees(size):.2g}°"
    if size >= 1e-5:
        return f"{size * 1e3:.3g} mm"
    return f"{size * 1e6:.3g} µm" if size >= 1e-8 else f"{size * 1e9:.3g} nm"


def how_fine(column: Resolution, rate: float) -> str:
    """``written to 0.1 mm at 370 Hz`` or ``noisy by 0.03 mm at 370 Hz``."""
    if column.noise > _WRITTEN * ROUNDING * column.quantum:
        said = f"noisy by {resolution(float(f'{column.noise:.1g}'), column.turns)}"
    else:
        said = f"written to {resolution(float(f'{column.quantum:.3g}'), column.turns)}"
    return f"{said} at {rate:.3g} Hz"


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
    needed = resolution(column.needed(held, limit), column.turns)
    return (
        f"{column.name}, {how_fine(column, rate)}, makes {share:.0%} of it; {needed} or better "
        "is needed, more samples a second hardly help"
    )


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
        "samples": [how_fine(one, rate) for one in moving],
    }
    rows = list(zip(*told.values(), strict=True))
    return Table("What the samples resolve", list(told), rows, prose=True)
