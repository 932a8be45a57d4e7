"""Laws on grids that are refined until nothing is gained and all limits hold between places."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.numeric.workers import silent
from thesis_pin.timing.judging import Use, use
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.track import Grid
from thesis_pin.tolerances import TOLERANCES

INTERVALS = 400
"""Of the first grid."""

GAIN = 4e-3
"""Share of the duration that a grid half as fine may cost and needn't be halved again for."""

SPARE = 1e-3
"""Share of all limits that laws leave, so that what lies between places keeps them too."""

POINTS = 20
"""Between two places, at which limits are looked at."""

_MOST = 25_000  # places, beyond which nothing is refined
_ROUNDS = 8


@dataclass(frozen=True, eq=False)
class Solved(Brief):
    """A law that was found.

    Attributes:
        law: The law.
        grid: Its places.
        use: How much it uses of its limits, looked at between places.
        gain: Share of the duration that the last halving of all intervals saved: a finer grid
            would save about as much again.
    """

    law: Law
    grid: Grid
    use: Use
    gain: float

    @property
    def keeps(self) -> bool:
        """Whether it keeps its limits, also between the places of its grid."""
        return self.use.largest <= 1.0 + TOLERANCES.law_share


def refined(
    grid: Grid, make: Callable[[Grid], Law], progress: Callable[[int, int], None] = silent
) -> tuple[Grid, Law, float]:
    """Halve intervals until the duration stays what it is.

    Args:
        grid: To begin with.
        make: Makes a law on a grid.
        progress: Called with the steps done and their total.

    Returns:
        Grid, law, and what the last halving saved, as a share.
    """
    law, gain = make(grid), 0.0
    for step in range(_ROUNDS):
        progress(step, _ROUNDS)
        finer = grid.finer([np.full(len(one) - 1, 2) for one in grid.places])
        better = make(finer)
        gain = 1.0 - better.duration / law.duration
        grid, law = finer, better
        if abs(gain) <= GAIN or 2 * len(law.place) > _MOST:
            break
    return grid, law, gain


def solve(
    grid: Grid,
    limits: Limits,
    make: Callable[[Grid], Law],
    gain: float = 0.0,
    progress: Callable[[int, int], None] = silent,
) -> Solved:
    """A law that keeps its limits everywhere, on a grid made finer where it doesn't.

    Args:
        grid: To begin with.
        limits: What it is judged by.
        make: Makes a law on a grid.
        gain: What is known of that, see :class:`Solved`.
        progress: Called with the steps done and their total.

    Returns:
        The law as it is after the last refinement, whether it keeps the limits or not: see
        :attr:`Solved.keeps`.
    """
    for step in range(_ROUNDS):
        progress(step, _ROUNDS)
        law = make(grid)
        judged = use(law, grid, limits, POINTS)
        beyond = judged.worst > 1.0
        if not beyond.any() or len(law.place) > _MOST or step == _ROUNDS - 1:
            break
        grid = grid.finer([1 + 3 * one.astype(int) for one in grid.split(beyond)])
    progress(_ROUNDS, _ROUNDS)
    return Solved(law, grid, judged, gain)
