"""How the benchmarks measure: ours and the peer's in turns, so that a busy machine hits both."""

from __future__ import annotations

import math
import resource
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

Json = dict[str, object]


@dataclass(frozen=True)
class Spent:
    """What some work took.

    Attributes:
        cpu: Time of all threads and of children that have ended [s].
        wall: Time by the clock on the wall [s].
        memory: Peak of a process of its own [MB]; NaN where nobody looked.
    """

    cpu: float
    wall: float
    memory: float = math.nan


Work = Callable[[], object]
"""Does some work. A :class:`Spent` that it returns counts instead of what is measured here."""


@dataclass(frozen=True)
class Scale:
    """How much is done.

    Attributes:
        sizes: Stacks of poses.
        many: Samples of a motion, or poses of a stack where one size is enough.
        few: Items for peers that take long.
        million: Samples of a stream.
        rounds: Turns of ours and the peer's.
        turn: Calls are repeated until a turn takes as long [s].
    """

    sizes: tuple[int, ...] = (1, 100, 10_000, 1_000_000)
    many: int = 10_000
    few: int = 50
    million: int = 1_000_000
    rounds: int = 7
    turn: float = 0.01

    @property
    def quick(self) -> bool:
        """Whether this is only a smoke run."""
        return self == QUICK


FULL = Scale()
QUICK = Scale(sizes=(1, 20), many=40, few=3, million=3000, rounds=1, turn=0.0)


@dataclass(frozen=True)
class Peer:
    """Who else does the work, or what it is measured by.

    Attributes:
        name: What it is called.
        size: Number of its items.
        work: Does them; None if it isn't installed.
    """

    name: str
    size: int
    work: Work | None


@dataclass(frozen=True)
class Equal:
    """That both give the same answer.

    Attributes:
        what: What is compared, with its unit.
        difference: Works out the largest difference.
        tolerance: How much it may be.
    """

    what: str
    difference: Callable[[], float]
    tolerance: float


Of = Literal["ratio", "µs", "ms", "s", "s by the clock", "s more", "MB"]
"""What a goal is about: the ratio, time of one item (µs, ms), of everything (s; by the clock on the
wall whatever the row's is), beyond the peer's (s more), or memory."""


@dataclass(frozen=True)
class Goal:
    """What is to be reached: at most so much of that."""

    most: float
    of: Of = "ratio"


class Unequal(Exception):
    """Ours and the peer's answers differ: there is nothing to time."""


@dataclass(frozen=True)
class Row:
    """One row of a table.

    Attributes:
        work: What is done.
        size: Number of items.
        ours: Does it for all of them.
        peer: Who else does.
        equal: How the answers are compared before anything is timed.
        goals: What is to be reached.
        clock: Which time the ratio is of: ``"cpu"`` where one thread works, so that others on the
            machine don't count; ``"wall"`` where several do.
        rounds: Turns, if other than the scale's.
        warm: Whether the works are tried before a turn counts; not what takes seconds and has
            been done.
    """

    work: str
    size: int
    ours: Work
    peer: Peer
    equal: Equal | None = None
    goals: tuple[Goal, ...] = field(default=())
    clock: Literal["cpu", "wall"] = "cpu"
    rounds: int | None = None
    warm: bool = True

    def measure(self, scale: Scale) -> Json:
        """Compare the answers, then take turns; the row as JSON-ready data.

        Raises:
            Unequal: The answers differ.
        """
        equal = self._compared()
        works = [self.ours] if self.peer.work is None else [self.ours, self.peer.work]
        times = [_repeats(work, scale.turn) if self.warm else 1 for work in works]
        turns: list[list[Spent]] = [[] for _ in works]
        for number in range(self.rounds or scale.rounds):
            for k in (0, 1) if number % 2 == 0 else (1, 0):  # neither always comes first
                if k < len(works):
                    turns[k].append(spent(works[k], times[k]))
        sizes = (self.size, self.peer.size)
        ours, *other = [_shown(one, size) for one, size in zip(turns, sizes, strict=False)]
        found: Json = {"work": self.work, "size": self.size, "ours": ours}
        found["peer"] = {"name": self.peer.name, "size": self.peer.size} | (
            other[0] if other else {"missing": True}
        )
        found |= {"equal": equal, "clock": self.clock, "rounds": len(turns[0]), "ratio": None}
        if other:
            pairs = zip(turns[0], turns[1], strict=True)
            share = self.peer.size / self.size
            ratios = [getattr(a, self.clock) / getattr(b, self.clock) * share for a, b in pairs]
            found["ratio"] = quartiles(ratios)
        found["goals"] = [self._judged(goal, turns) for goal in self.goals]
        return found

    def _compared(self) -> Json | None:
        if self.equal is None or self.peer.work is None:
            return None
        found = float(self.equal.difference())
        if not found <= self.equal.tolerance:
            raise Unequal(
                f"{self.work}, {self.size}: ours and {self.peer.name} differ by {found:.3g} in "
                f"{self.equal.what}; allowed are {self.equal.tolerance:g}"
            )
        return {
            "what": self.equal.what,
            "difference": found,
            "tolerance": self.equal.tolerance,
        }

    def _judged(self, goal: Goal, turns: list[list[Spent]]) -> Json:
        def middle(values: Iterable[float]) -> float:
            return float(np.median(list(values)))

        ours, theirs = turns[0], turns[1] if len(turns) > 1 else None
        found: float | None
        if goal.of == "MB":
            found = max(one.memory for one in ours)
        elif goal.of in ("µs", "ms"):
            scale = {"µs": 1e6, "ms": 1e3}[goal.of] / self.size
            found = scale * middle(getattr(one, self.clock) for one in ours)
        elif goal.of == "s":
            found = middle(getattr(one, self.clock) for one in ours)
        elif goal.of == "s by the clock":
            found = middle(one.wall for one in ours)
        elif theirs is None:
            found = None
        else:
            pairs = [
                (getattr(a, self.clock), getattr(b, self.clock))
                for a, b in zip(ours, theirs, strict=True)
            ]
            share = self.peer.size / self.size
            found = middle(a - b if goal.of == "s more" else a / b * share for a, b in pairs)
        met = None if found is None else found <= goal.most
        return {"of": goal.of, "most": goal.most, "found": found, "met": met}


def spent(work: Work, times: int = 1) -> Spent:
    """What a work takes once, if it is done several times over."""
    cpu, wall = _cpu(), time.perf_counter()
    for _ in range(times):
        answer = work()
    found = Spent((_cpu() - cpu) / times, (time.perf_counter() - wall) / times)
    return answer if isinstance(answer, Spent) else found


def _cpu() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def _repeats(work: Work, turn: float) -> int:
    """How often a work is done in one turn; the first time warms up."""
    if turn <= 0:
        return 1
    if spent(work).wall > turn:
        return 1
    return max(1, math.ceil(turn / max(spent(work).wall, 1e-7)))


def quartiles(values: Iterable[float]) -> Json:
    """Median, and the quarters below and above which a quarter of the values lies."""
    low, middle, high = np.quantile(list(values), (0.25, 0.5, 0.75))
    return {"median": float(middle), "low": float(low), "high": float(high)}


def _shown(turns: list[Spent], size: int) -> Json:
    """Seconds an item by both clocks; memory of processes that looked."""
    found: Json = {
        clock: quartiles(getattr(one, clock) / size for one in turns) for clock in ("cpu", "wall")
    }
    if any(math.isfinite(one.memory) for one in turns):
        found["memory_mb"] = max(one.memory for one in turns)
    return found
