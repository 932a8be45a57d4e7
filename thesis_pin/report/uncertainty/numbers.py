"""Intervals of a report's numbers, and whether they decide."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from thesis_pin.smoothing.intervals import SPREAD, Interval, largest_value

Array = NDArray[np.float64]

LOST = 0.5
"""Share of draws that may fail before nothing is decided."""

PEAK = 2e-4
"""What the grid of samples may miss of a peak, relative."""


def few_draws(lost: int, left: int) -> bool:
    """Whether most motions that the samples leave open can't be worked out."""
    return lost > LOST * (lost + left)


def within(uses: Iterable[Interval], few: bool) -> bool | None:
    """Whether shares of limits stay below 1; None where the samples can't say.

    Args:
        uses: The shares.
        few: Of :func:`few_draws`.
    """
    sides = {use.side(1.0) for use in uses}
    if 1 in sides:
        return False
    return None if few or 0 in sides else True


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
