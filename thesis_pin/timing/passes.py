"""The largest speeds along a path that limits leave: one pass back, one forth.

Between two places of a grid s̈ is constant, so that x = ṡ² is a straight line and the limits at
both ends of an interval bound a convex polygon of x and y, its values at both ends, with rest in
it. From the end backwards the largest x is found from which one can go on; from the beginning
forwards as fast as possible below that. As the grid is refined that is the fastest law: of two laws
within the limits, the faster one at each place is within them too.

Source: H. Pham and Q.-C. Pham, A new approach to time-optimal path parameterization based on
reachability analysis, 2018, with the limits of both ends of each interval.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from thesis_pin.timing.rows import Array, Rows

_MOST = 200  # steps of Newton's method, which ends after as many as a polygon has sides
_FAR = 1e6  # a speed's square beyond any, in those that a path's length and thrust give


@dataclass(frozen=True, eq=False)
class Spans:
    """Intervals of a grid, one after the other.

    Attributes:
        width: Of each in s, shape ``(n,)``.
        left, right: Limits at both its ends.
        cap: Largest ṡ² at the grid's places, shape ``(n + 1,)``; 0 where the motion rests.
    """

    width: Array
    left: Rows
    right: Rows
    cap: Array


def largest(spans: Spans, near: Array) -> Array:
    """The largest ṡ² at each place, shape ``(n + 1,)``.

    Args:
        spans: The intervals. At rest all their limits hold.
        near: ṡ² near which √ṡ² is taken for its tangent, which is never below it, ``(n + 1,)``.
    """
    p, r, h = _sides(spans, near)
    cap = _finite(spans, r, h)
    apex, lowest = _apex(p, r, h, cap)
    return _forth(p, r, h, _back(p, r, h, cap, apex, lowest), cap)


def _sides(spans: Spans, near: Array) -> tuple[Array, Array, Array]:
    """Sides p x + r y ≤ h of each interval's polygon, ``(n, 2m)``."""
    parts = []
    root = np.sqrt(near)[:, None]
    for rows, bar, end in ((spans.left, root[:-1], 0), (spans.right, root[1:], 1)):
        slope = rows.acceleration / (2 * spans.width[:, None])
        curved = rows.square + rows.rate / (2 * bar)
        limit = 1.0 - rows.rest - rows.rate * bar / 2
        parts.append(
            (curved - slope, slope, limit) if end == 0 else (-slope, slope + curved, limit)
        )
    p, r, h = (np.concatenate(pair, axis=1) for pair in zip(*parts, strict=True))
    return p, r, h


def _finite(spans: Spans, r: Array, h: Array) -> Array:
    """Caps that are finite also where nothing limits the rate alone."""
    if np.isfinite(spans.cap).all():
        return spans.cap
    with np.errstate(divide="ignore"):
        thrust = np.where(r > 0, h / r, np.inf).min(axis=1)
    thrust = thrust[np.isfinite(thrust)]
    return np.minimum(spans.cap, _FAR * float(thrust.sum()) if thrust.size else _FAR)


def _apex(p: Array, r: Array, h: Array, cap: Array) -> tuple[Array, Array]:
    """Each polygon's largest x, and the least y there.

    The gap between what bounds y from above and from below is concave in x: Newton's method
    comes down to its zero from the right, from side to side.
    """
    x = cap[:-1].copy()
    with np.errstate(divide="ignore", invalid="ignore"):
        upright = np.where((r == 0) & (p > 0), h / p, np.inf).min(axis=1)
        at, by, up, down = h / r, p / r, r > 0, r < 0
    up_at, up_by = np.where(up, at, np.inf), np.where(up, by, 0.0)
    down_at, down_by = np.where(down, at, -np.inf), np.where(down, by, 0.0)
    # 0 ≤ y ≤ cap are two more sides.
    zero, many = np.zeros((len(x), 1)), np.arange(len(x))
    up_at, up_by = np.hstack([up_at, cap[1:, None]]), np.hstack([up_by, zero])
    down_at, down_by = np.hstack([down_at, zero]), np.hstack([down_by, zero])
    x = np.minimum(x, upright)
    left = many
    for _ in range(_MOST):
        above = up_at[left] - up_by[left] * x[left, None]
        below = down_at[left] - down_by[left] * x[left, None]
        i, j, own = above.argmin(axis=1), below.argmax(axis=1), np.arange(len(left))
        gap = above[own, i] - below[own, j]
        slope = down_by[left, j] - up_by[left, i]
        with np.errstate(divide="ignore", invalid="ignore"):
            lower = np.where(slope < 0, x[left] - gap / slope, x[left])
        goes = (gap < 0) & (lower < x[left])
        left = left[goes]
        if not left.size:
            break
        x[left] = np.maximum(lower[goes], 0.0)
    lowest = (down_at - down_by * x[:, None]).max(axis=1)
    return x, lowest


def _back(p: Array, r: Array, h: Array, cap: Array, apex: Array, lowest: Array) -> Array:
    """The largest ṡ² at each place from which the end can be reached."""
    with np.errstate(divide="ignore", invalid="ignore"):
        at, by = np.where(p > 0, h / p, np.inf), np.where(p > 0, r / p, 0.0)
    most, least = cap.copy(), np.minimum.reduce
    y = float(most[-1])
    tops, lows, caps = apex.tolist(), lowest.tolist(), cap.tolist()
    for k in range(len(tops) - 1, -1, -1):
        x = tops[k]
        if y < lows[k]:
            x = min(x, float(least(at[k] - by[k] * y)))
        y = max(min(x, caps[k]), 0.0)
        most[k] = y
    return most


def _forth(p: Array, r: Array, h: Array, most: Array, cap: Array) -> Array:
    """As fast as possible from the beginning, never above what the end allows."""
    with np.errstate(divide="ignore", invalid="ignore"):
        at, by = np.where(r > 0, h / r, np.inf), np.where(r > 0, p / r, 0.0)
    found, least = np.empty_like(most), np.minimum.reduce
    x = found[0] = float(min(most[0], cap[0]))
    tops = most.tolist()
    # Where the last speed is the largest that the end allows, what follows is known beforehand.
    known = least(at - by * most[:-1, None], axis=1).tolist()
    for k, top in enumerate(tops[1:]):
        thrust = known[k] if x == tops[k] else float(least(at[k] - by[k] * x))
        x = max(min(top, thrust), 0.0)
        found[k + 1] = x
    return found


def ceiling(spans: Spans, near: Array) -> Array:
    """The largest ṡ² that the limits leave in each interval by itself, shape ``(n,)``.

    Args:
        spans: The intervals.
        near: See :func:`largest`.
    """
    p, r, h = _sides(spans, near)
    return _apex(p, r, h, _finite(spans, r, h))[0]
