"""A law held against its limits, also between the places of its grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.rows import Array
from thesis_pin.timing.track import Grid

_ROOM = 20_000  # places that are looked at together


@dataclass(frozen=True, eq=False)
class Use(Brief):
    """How much of its limits a law uses.

    Attributes:
        names: The limits, ``k`` of them.
        peak: Largest share of each, 1 at the limit, shape ``(k,)``.
        place: Where on the path, its parameter s, shape ``(k,)``.
        worst: Largest share of any limit in each interval of the grid, shape ``(n,)``.
        binding: Which limit that is, shape ``(n,)``.
        points: How many points inside each interval it was looked at.
    """

    names: tuple[str, ...]
    peak: Array
    place: Array
    worst: Array
    binding: NDArray[np.intp]
    points: int

    @property
    def largest(self) -> float:
        """Largest share of any limit."""
        return float(self.peak.max())


def use(law: Law, grid: Grid, limits: Limits, points: int) -> Use:
    """Hold a law against its limits between the places of its grid.

    Args:
        law: Over the places of the grid.
        grid: Their track is asked what it asks for there.
        limits: The limits.
        points: How many points there are inside each interval.
    """
    counts = np.cumsum([len(one) - 1 for one in grid.places])[:-1]
    every = [np.split(one, counts) for one in law.within(points)]
    names: tuple[str, ...] = ()
    shares, places = [], []
    for piece, (s, rate, bend) in enumerate(zip(*every, strict=True)):
        step = max(1, _ROOM // points)
        for first in range(0, len(s), step):
            some = slice(first, first + step)
            at = s[some].ravel()
            rows = limits.rows(grid.track.values(piece, at))
            found = rows.use(rate[some].ravel(), bend[some].ravel())
            names = tuple(dict.fromkeys(rows.names))
            columns = [[k for k, n in enumerate(rows.names) if n == name] for name in names]
            by_name = np.stack([found[:, c].max(axis=1) for c in columns], axis=-1)
            by_name = by_name.reshape(-1, points, len(names))
            which = by_name.argmax(axis=1)
            shares.append(by_name.max(axis=1))
            places.append(np.take_along_axis(s[some], which, axis=1))
    share, place = np.concatenate(shares), np.concatenate(places)
    where = share.argmax(axis=0)
    column = np.arange(share.shape[1])
    return Use(
        names,
        share[where, column],
        place[where, column],
        share.max(axis=1),
        share.argmax(axis=1),
        points,
    )
