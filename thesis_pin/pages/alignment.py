"""How the times of two motions go together: from their starts, or phase by phase."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import finite_array

Array = NDArray[np.float64]
Names = tuple[str, str]
"""Of the first motion and of the second."""

PARTS = 100
"""Of a way that is compared by how much of it is done."""

_SAME = 1e-9  # of a duration: less is rounding
_DWELL = 1e-6  # share of time in what counts as done, so that it never stands still


@dataclass(frozen=True)
class Phase:
    """A stretch of a motion that has its like in others.

    Attributes:
        name: What it is: phases of one name are alike.
        start, end: When [s], of the motion's own time.
    """

    name: str
    start: float
    end: float


@dataclass(frozen=True, eq=False)
class Alignment:
    """Which times of two motions belong together.

    Attributes:
        first: Times of the first motion, ascending, shape ``(k,)`` [s].
        second: Those of the second one that belong to them.
        names: Of the phases between; empty where both go on from one time each, at one pace.
        left: How many phases of each have no like in the other, or one that takes no time there.
    """

    first: Array
    second: Array
    names: tuple[str, ...] = ()
    left: tuple[int, int] = (0, 0)

    @property
    def how(self) -> str:
        """In a word or two, for JSON."""
        return "by phase" if self.names else "from the start"

    def of_first(self, time: Array) -> Array:
        """Times of the second motion as times of the first; NaN where they have none."""
        if not self.names:
            return np.asarray(time - self.second[0] + self.first[0])
        found: Array = np.interp(time, self.second, self.first, left=np.nan, right=np.nan)
        for k in np.flatnonzero(self.first[1:] == self.first[:-1]):
            found[(time > self.second[k]) & (time < self.second[k + 1])] = np.nan
        return found

    def gaps(self, time: Array) -> NDArray[np.intp]:
        """After which of the second motion's times it does nothing for a phase of the first.

        Args:
            time: Ascending, shape ``(n,)`` [s].
        """
        instants = self.second[1:][self.second[1:] == self.second[:-1]]
        after = np.searchsorted(time, instants, side="left")
        return np.asarray(np.unique(after[(after > 0) & (after < len(time))]), dtype=np.intp)

    def of_second(self, time: Array) -> Array:
        """Times of the first motion as times of the second; an end's beyond it."""
        if not self.names:
            return np.asarray(time - self.first[0] + self.second[0])
        return np.asarray(np.interp(time, self.first, self.second))

    def said(self, names: Names, durations: tuple[float, float]) -> str:
        """How the times of two motions go together, in a sentence.

        Args:
            names: What they are called.
            durations: Of both [s].
        """
        if self.names:
            return self._said_of_phases(names, durations)
        text = "Both begin at the same moment"
        if abs(durations[0] - durations[1]) <= _SAME * max(durations):
            return f"{text} and take {durations[0]:.4g} s."
        short = int(durations[1] < durations[0])
        return (
            f"{text}; {names[short]} ends after {durations[short]:.4g} s and stands still, "
            f"{names[1 - short]} goes on to {durations[1 - short]:.4g} s."
        )

    def _said_of_phases(self, names: Names, durations: tuple[float, float]) -> str:
        text = (
            f"Both are in the same phase at each moment: {names[1]}, which takes "
            f"{durations[1]:.4g} s, is drawn at the times of {names[0]}, which takes "
            f"{durations[0]:.4g} s"
        )
        rest = [f"{count} of {name}" for name, count in zip(names, self.left, strict=True) if count]
        return f"{text}; phases without their like: {', '.join(rest)}." if rest else f"{text}."

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        told: dict[str, object] = {"aligned": self.how}
        if self.names:
            told["phases"] = [
                {"name": name, "first": self.first[k : k + 2].tolist()}
                | {"second": self.second[k : k + 2].tolist()}
                for k, name in enumerate(self.names)
            ]
        return told


def by_time(first: Array, second: Array) -> Alignment:
    """Two motions from the same start.

    Args:
        first: The first one's times [s].
        second: The second one's.
    """
    return Alignment(np.asarray(first[:1], dtype=float), np.asarray(second[:1], dtype=float))


def by_phase(first: Sequence[Phase], second: Sequence[Phase]) -> Alignment:
    """Two motions phase by phase: the longest run of phases that both have in the same order.

    Args:
        first: The first one's phases, each beginning where the last one ends.
        second: The second one's.

    Raises:
        BadInput: They have no such run, or one without a change where there are changes.
    """
    words = [phase.name for phase in first], [phase.name for phase in second]
    count, a, b = max(
        (_run(words[0][a:], words[1][b:]), -a, -b)
        for a in range(max(len(first), 1))
        for b in range(max(len(second), 1))
    )
    a, b = -a, -b
    if count < min(2, max(len(first), len(second), 1)):
        raise BadInput(
            "the two motions have no phases in common to be compared by: "
            f"{_told(words[0])} beside {_told(words[1])}",
            where="--align phase",
            remedy="--align time compares them from their starts",
        )
    runs = first[a : a + count], second[b : b + count]
    knots = [np.array([run[0].start, *(phase.end for phase in run)]) for run in runs]
    lasts = [np.diff(one) > 0 for one in knots]
    left = (
        len(first) - count + int((lasts[0] & ~lasts[1]).sum()),
        len(second) - count + int((lasts[1] & ~lasts[0]).sum()),
    )
    return Alignment(knots[0], knots[1], tuple(words[0][a : a + count]), left)


def by_way(time: Array, points: Array, what: str) -> tuple[Phase, ...]:
    """Phases of a motion by how much of a point's way is done, in :data:`PARTS` equal parts.

    Args:
        time: Sample times [s], shape ``(n,)``.
        points: Where the point is [m], shape ``(n, 3)``.
        what: What moves, for messages.

    Raises:
        BadInput: The point moves nowhere.
    """
    points = finite_array("points", points, 3)
    done = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    if not done[-1] > 0:
        raise BadInput(
            f"{what} moves nowhere: none of its way can be compared by",
            where="--align phase",
            remedy="--align time compares motions from their starts",
        )
    passed = (time - time[0]) / (time[-1] - time[0])
    share = (1 - _DWELL) * done / done[-1] + _DWELL * passed
    at = np.interp(np.linspace(0.0, 1.0, PARTS + 1), share, time)
    return tuple(
        Phase(f"to {k + 1} % of the way", float(at[k]), float(at[k + 1])) for k in range(PARTS)
    )


def _run(first: list[str], second: list[str]) -> int:
    """How many names two lists begin with in common."""
    count = 0
    for one, other in zip(first, second, strict=False):
        if one != other:
            break
        count += 1
    return count


def _told(names: list[str]) -> str:
    return ", ".join(names[:4]) + (" …" if len(names) > 4 else "") or "none"
