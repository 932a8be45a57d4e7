"""The fastest law along a track, refined until it keeps its limits between the grid's places."""

from __future__ import annotations

import numpy as np

from thesis_pin.errors import Infeasible
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.passes import Spans, largest
from thesis_pin.timing.rows import Array
from thesis_pin.timing.track import Grid

TIGHT = 1e-4
"""Relative change of the duration below which tangents of √ṡ² lie where they belong."""

_ROUNDS = 12  # of tangents
_LOW = 1e-6  # share of the largest ṡ² below which √ṡ² isn't taken for its tangent


def spans(grid: Grid, limits: Limits, *, rests: bool = True) -> Spans:
    """A grid's intervals with their limits.

    Args:
        grid: Places on a track.
        limits: The limits.
        rests: Whether the motion rests where the track asks for it.

    Raises:
        Infeasible: At rest a limit is exceeded somewhere.
    """
    left, right = (limits.rows(one) for one in grid.sides())
    every = grid.every
    for rows, at in ((left, every[:-1]), (right, every[1:])):
        if (rows.rest > 1.0).any():
            place, row = np.unravel_index(int(rows.rest.argmax()), rows.rest.shape)
            raise Infeasible(rows.names[row], float(rows.rest[place, row]), float(at[place]))
    cap = np.minimum(np.append(left.cap, np.inf), np.append(np.inf, right.cap))
    return Spans(np.diff(every), left, right, np.where(grid.rests & rests, 0.0, cap))


def fastest(grid: Grid, limits: Limits, near: Law | None = None) -> Law:
    """The fastest law on a grid's places, at rest where the track asks for it.

    Args:
        grid: Places on a track.
        limits: Kept at all of them, on both sides.
        near: A law of the same track with much the same limits, which leads there sooner.

    Raises:
        Infeasible: At rest a limit is exceeded somewhere.
    """
    known = spans(grid, limits)
    if not (known.left.rate.any() or known.right.rate.any()):
        return Law(grid.every, np.sqrt(largest(known, np.ones(len(known.cap)))))
    # √ṡ² is taken for its tangent where the last law went: each law keeps the limits, and none
    # is slower than the one before.
    half = np.minimum(known.cap / 4, _halfway(known))
    square, last = half if near is None else near.square(grid.every), np.inf
    for _ in range(_ROUNDS):
        square = largest(known, np.maximum(square, _LOW * half.max()))
        law = Law(grid.every, np.sqrt(square))
        if last - law.duration <= TIGHT * law.duration:
            break
        last = law.duration
    return law


def _halfway(known: Spans) -> Array:
    """ṡ² at which half of some limit is used by the rate alone."""
    most = np.zeros(len(known.cap))
    most[:-1] = known.left.rate.max(axis=1)
    most[1:] = np.maximum(most[1:], known.right.rate.max(axis=1))
    return np.divide(0.25, most**2, out=np.ones_like(most), where=most > 0)
