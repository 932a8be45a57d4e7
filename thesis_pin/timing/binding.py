"""Which limit binds when: stretches of a law, and shares of its time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.timing.judging import Use
from thesis_pin.timing.law import Law

BINDS = 0.985
"""Share of a limit from which it counts as what holds a law back; laws leave a thousandth."""

FREE = "none"


@dataclass(frozen=True)
class Stretch(Brief):
    """A stretch of time in which one limit binds.

    Attributes:
        limit: Its name; :data:`FREE` where none does.
        start, end: When [s].
        place: Where it begins, by the path's parameter.
    """

    limit: str
    start: float
    end: float
    place: float


def stretches(law: Law, use: Use) -> list[Stretch]:
    """A law in stretches, one limit after the other.

    Args:
        law: A law.
        use: Its use of its limits.
    """
    which = np.where(use.worst >= BINDS, use.binding, -1)
    first = np.flatnonzero(np.diff(which, prepend=-2))
    last = np.append(first[1:], len(which))
    time, place = law.time, law.place
    return [
        Stretch(
            use.names[which[a]] if which[a] >= 0 else FREE,
            float(time[a]),
            float(time[b]),
            float(place[a]),
        )
        for a, b in zip(first, last, strict=True)
    ]


def shares(law: Law, use: Use) -> dict[str, float]:
    """On which share of its time each limit binds, the most binding first; those that do."""
    found: dict[str, float] = {}
    for one in stretches(law, use):
        found[one.limit] = found.get(one.limit, 0.0) + (one.end - one.start) / law.duration
    return dict(sorted(found.items(), key=lambda pair: -pair[1]))
