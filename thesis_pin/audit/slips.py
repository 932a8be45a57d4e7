"""Slips: each difference of print and correction, and causes that several lines share."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from thesis_pin.model.specification import Key, Strict, read_toml


@dataclass(frozen=True)
class Slip:
    """One difference of print and correction.

    Attributes:
        member: Number of the member; 0 is the left side.
        start: Number of its first symbol (or column) that differs, from 1.
        printed, corrected: What stands there and what should; "" for nothing.
        neighbours: What stands before and after it in the print.
        term: Which term of the member, as "term 3 of 8"; "" if it has one alone. Where the print
            has other terms, "term 3 of 8 of the correction".
        kind: One of :data:`thesis_pin.audit.comparison.kinds.KINDS`.
        residual: Of the corrected line with this slip alone put back: below
            :data:`thesis_pin.audit.rows.HOLDS` where it can't be seen alone, infinite where
            the line can't be evaluated with it; None if nothing was evaluated.
    """

    member: int
    start: int
    printed: str
    corrected: str
    neighbours: tuple[str, str] = ("", "")
    term: str = ""
    kind: str = ""
    residual: float | None = None


@dataclass(frozen=True)
class Cause:
    """One finding with many symptoms.

    Attributes:
        title: A few words, for tables.
        enters: Line of the derivation where the slip enters, as "(2.20)".
        explanation: What went wrong and what follows, for a reader who has the thesis open.
    """

    title: str
    enters: str
    explanation: str


class _Entry(Strict):
    name: str
    title: str
    enters: str
    explanation: str


class _CauseFile(Strict):
    cause: tuple[_Entry, ...]

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        names = [entry.name for entry in self.cause]
        for k, name in enumerate(names):
            if name in names[:k]:
                yield ("cause", k, "name"), "used twice", name


def read_causes(path: Path) -> dict[str, Cause]:
    """Causes by the name that the equations' ``cause`` has, in the file's order.

    Raises:
        SpecificationError: The file breaks the schema; lists every problem.
    """
    file = read_toml("causes", _CauseFile, path)
    return {one.name: Cause(one.title, one.enters, one.explanation) for one in file.cause}
