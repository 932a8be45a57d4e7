"""What several tries of a motion have in common: how many keep what is asked, in what range."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import Protocol

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell

QUANTILES = (0.05, 0.5, 0.95)
"""Of draws, in summaries."""


class Criterion(Protocol):
    """One thing that is asked of a try.

    Attributes:
        name: What, the same in every try.
        met: Whether it is as asked.
    """

    @property
    def name(self) -> str: ...
    @property
    def met(self) -> bool: ...


class Doubted(Protocol):
    """A report that may be doubted."""

    def doubts(self) -> list[str]:
        """What is to be asked before its numbers are believed."""


Tries = Sequence[Sequence[Criterion]]
"""The criteria of each try, in one order."""


class Tally(ABC, Brief):
    """Several tries of a motion by any robot, and whether they keep what is asked."""

    report: Doubted

    @property
    @abstractmethod
    def tries(self) -> Tries:
        """What is asked of each try, with its answers."""

    @abstractmethod
    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""

    def _cell(self) -> Cell:
        names = [one.name for one in self.tries[0]]
        met = np.array([[one.met for one in each] for each in self.tries]).sum(axis=0)
        rows = [
            (name.replace("_", " "), f"{count} of {len(self.tries)}")
            for name, count in zip(names, met, strict=True)
        ]
        heads = ("what is asked", "tries that keep it")
        return Cell(type(self).__name__, self.verdict(), self.passed, heads, rows)

    @property
    def passed(self) -> bool:
        """Whether every try keeps all that is asked."""
        return all(map(kept, self.tries))

    @property
    def within_limits(self) -> bool:
        """The same, by the name that all reports have."""
        return self.passed

    def doubts(self) -> list[str]:
        """What is to be asked before the numbers are believed: what the report asks."""
        return self.report.doubts()


def kept(criteria: Sequence[Criterion]) -> bool:
    """Whether a try keeps all that is asked."""
    return all(one.met for one in criteria)


def tallied(tries: Tries, spread: Mapping[str, Sequence[float]]) -> dict[str, object]:
    """How many tries keep what is asked, all of it and each criterion, and in what range they are.

    Args:
        tries: What is asked of each, with its answers.
        spread: What tries differ in: name → value of each.
    """
    return {
        "draws": len(tries),
        "draws_passed": passed(tries),
        "kept": {each[0].name: sum(one.met for one in each) for each in zip(*tries, strict=True)},
        "quantiles": {
            "of": list(QUANTILES),
            **{name: np.quantile(values, QUANTILES) for name, values in spread.items()},
        },
    }


def passed(tries: Tries) -> int:
    """How many tries keep all that is asked."""
    return sum(map(kept, tries))


def passed_sentence(tries: Tries) -> str:
    """How many tries keep all that is asked, in a sentence."""
    return f"{passed(tries)} of {len(tries)} draws keep all that is asked."


def lost_sentences(tries: Tries, words: Mapping[str, str]) -> Iterator[str]:
    """How many tries fail by each criterion that isn't met by all.

    Args:
        tries: What is asked of each, with its answers.
        words: Name of a criterion → what a try fails by.
    """
    for each in zip(*tries, strict=True):
        lost = sum(not one.met for one in each)
        if lost:
            yield f"{lost} of {len(tries)} fail by {words[each[0].name]}."
