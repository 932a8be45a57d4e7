"""How the benchmarks measure: ours and the peer's in turns, so that a busy machine hits both."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Work = Callable[[], object]


@dataclass(frozen=True)
class Comparison:
    """One row of the table.

    Attributes:
        work: What is done, for instance one pose's inverse kinematics.
        ours: Does it for ``count`` items.
        count: Number of items.
        peer: Who else does it, or what it is measured by.
        theirs: Does the peer's for ``peer_count`` items.
        peer_count: Number of the peer's items.
        repeats: Number of turns.
    """

    work: str
    ours: Work
    count: int
    peer: str
    theirs: Work
    peer_count: int
    repeats: int = 9

    def measure(self) -> tuple[float, float, float]:
        """Medians: our seconds an item, the peer's, and the ratio of the two in one turn."""
        self.ours()
        self.theirs()
        turns = np.array(
            [
                (_seconds(self.ours) / self.count, _seconds(self.theirs) / self.peer_count)
                for _ in range(self.repeats)
            ]
        )
        ours, theirs = np.median(turns, axis=0)
        return float(ours), float(theirs), float(np.median(turns[:, 0] / turns[:, 1]))


def _seconds(work: Work) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def again(work: Work, times: int) -> Work:
    """The same work several times over, for single calls."""

    def repeat() -> None:
        for _ in range(times):
            work()

    return repeat
