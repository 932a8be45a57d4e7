"""Where inequalities in one number hold: many at once, and what intervals leave of a range."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Intervals:
    """Intervals of one number, each with what it comes from.

    Attributes:
        start, end: Their ends, shape ``(m,)``.
        source: Numbers of what each comes from, shape ``(m, k)``.
    """

    start: np.ndarray
    end: np.ndarray
    source: np.ndarray

    @classmethod
    def joined(cls, parts: Sequence[Intervals], columns: int) -> Intervals:
        """Several lists as one; ``columns`` is k, for an empty one."""
        none = cls(np.empty(0), np.empty(0), np.empty((0, columns), dtype=np.intp))
        every = [none, *parts]
        return cls(
            np.concatenate([part.start for part in every]),
            np.concatenate([part.end for part in every]),
            np.concatenate([part.source for part in every]),
        )

    def within(self, low: np.ndarray, high: np.ndarray) -> Intervals:
        """The part of each between its own bounds, ``(m,)`` each; empty ones are left out."""
        start, end = np.maximum(self.start, low), np.minimum(self.end, high)
        keep = end > start
        return Intervals(start[keep], end[keep], self.source[keep])


@dataclass(frozen=True)
class Rest:
    """What intervals leave of a range.

    Attributes:
        low, high: Its ends.
        below, above: Number of the interval that ends it there, None at the range's ends.
    """

    low: float
    high: float
    below: int | None
    above: int | None


def rest_of(taken: Intervals, low: float, high: float) -> list[Rest]:
    """What is left of a range when intervals are taken from it, in order.

    Args:
        taken: The intervals.
        low: Lower end of the range.
        high: Its upper end.
    """
    order = np.argsort(taken.start, kind="stable")
    start, end = taken.start[order], taken.end[order]
    reach = np.maximum.accumulate(end)
    # The interval that reaches farthest so far ends what is taken.
    farthest = np.maximum.accumulate(np.where(end == reach, np.arange(len(end)), -1))
    before = np.concatenate([[low], reach])
    after = np.concatenate([start, [high]])
    result = []
    for k in np.flatnonzero(np.minimum(after, high) > np.maximum(before, low)):
        below = None if k == 0 or before[k] <= low else int(order[farthest[k - 1]])
        above = None if k == len(order) or after[k] >= high else int(order[k])
        result.append(Rest(float(max(before[k], low)), float(min(after[k], high)), below, above))
    return result


def where_positive(
    coefficients: tuple[np.ndarray, np.ndarray, np.ndarray], low: float, high: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where quadratics are positive in a range.

    Args:
        coefficients: a, b, c of a s² + b s + c, shape ``(m,)`` each.
        low: Lower end of the range of s.
        high: Its upper end.

    Returns:
        Starts and ends of the intervals, and the number of the quadratic of each, ``(k,)``.
    """
    a, b, c = coefficients
    with np.errstate(all="ignore"):
        top = -b / (2 * a)
        peak = np.where((a < 0) & (top > low) & (top < high), c - b * b / (4 * a), -np.inf)
    highest = np.maximum(np.maximum((a * low + b) * low + c, (a * high + b) * high + c), peak)
    some = np.flatnonzero(highest > 0)
    a, b, c = a[some], b[some], c[some]
    with np.errstate(all="ignore"):
        # No difference of nearly equal numbers: one root by this q, the other as c / q.
        q = -0.5 * (b + np.copysign(np.sqrt(np.maximum(b * b - 4 * a * c, 0.0)), b))
        roots = np.stack([q / a, c / q])
    roots = np.sort(np.clip(np.where(np.isnan(roots), low, roots), low, high), axis=0)
    cuts = np.concatenate([np.full((1, len(some)), low), roots, np.full((1, len(some)), high)])
    middle = (cuts[1:] + cuts[:-1]) / 2
    piece, which = np.nonzero(((a * middle + b) * middle + c > 0) & (cuts[1:] > cuts[:-1]))
    return cuts[piece, which], cuts[piece + 1, which], some[which]


def where_lines_hold(offset: np.ndarray, slope: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For each row the interval in which all its lines are at most zero.

    Args:
        offset: Shape ``(n, m)``.
        slope: The lines are ``offset + slope x``.

    Returns:
        Lower and upper ends, ``(n,)`` each; the lower is above the upper if there is no x.
    """
    lower, upper = np.empty((2, len(offset)))
    easy = (offset < 0).all(axis=1)
    if easy.all():  # zero is inside: 1 / x of each line's root, and no need to tell signs apart
        steep = slope / -offset
        most, least = steep.max(axis=1, initial=0.0), steep.min(axis=1, initial=0.0)
        with np.errstate(divide="ignore"):
            return np.where(least < 0, 1 / least, -np.inf), np.where(most > 0, 1 / most, np.inf)
    if easy.any():
        lower[easy], upper[easy] = where_lines_hold(offset[easy], slope[easy])
    offset, slope = offset[~easy], slope[~easy]
    with np.errstate(all="ignore"):
        root = -offset / slope
    high = np.where(slope > 0, root, np.inf).min(axis=1, initial=np.inf)
    low = np.where(slope < 0, root, -np.inf).max(axis=1, initial=-np.inf)
    never = ((slope == 0) & (offset > 0)).any(axis=1)
    lower[~easy], upper[~easy] = np.where(never, np.inf, low), np.where(never, -np.inf, high)
    return lower, upper
