"""Columns with what works them out, of which a study takes those that are asked for."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, ModelWarning, UnknownName
from thesis_pin.sweep.study import Cell, Column

Judged = TypeVar("Judged")


class Doubted(Protocol):
    """A report that says what is to be asked before its numbers are believed."""

    def doubts(self) -> list[str]:
        """What that is."""


Report = TypeVar("Report", bound=Doubted)


@dataclass(frozen=True)
class Measure(Brief, Generic[Judged]):
    """A column, and how it is read off what a design was judged by.

    Attributes:
        column: The column.
        of: Reads it off.
        usual: Whether it is worked out where nobody asks; others take long.
    """

    column: Column
    of: Callable[[Judged], Cell]
    usual: bool = True


def chosen(
    measures: Sequence[Measure[Judged]], extra: Iterable[str]
) -> tuple[Measure[Judged], ...]:
    """The usual measures, and those that are named.

    Args:
        measures: All there are.
        extra: Names of some.

    Raises:
        UnknownName: There is none of that name.
    """
    known = {one.column.name: one for one in measures}
    for name in (names := list(extra)):
        if name not in known:
            raise UnknownName("measure", name, tuple(known))
    return tuple(one for one in measures if one.usual or one.column.name in names)


def named(measures: Sequence[Measure[Judged]], text: str) -> list[str]:
    """Which of some measures a text speaks of, as an aim or a wish does."""
    import re

    words = set(re.findall(r"[\w]+", text))
    return [one.column.name for one in measures if one.column.name in words]


def row(measures: Sequence[Measure[Judged]], judged: Judged) -> Mapping[str, Cell]:
    """The cells of a design."""
    return {one.column.name: one.of(judged) for one in measures}


def columns_of(measures: Sequence[Measure[Judged]]) -> tuple[Column, ...]:
    """What is found of a design."""
    return tuple(one.column for one in measures)


def reported(measures: Sequence[Measure[Report]], report: Report) -> Mapping[str, Cell]:
    """The cells of a design that a report judges; what the report doubts is warned of."""
    for doubt in report.doubts():
        warnings.warn(doubt, ModelWarning, stacklevel=2)
    return row(measures, report)


def largest(find: Callable[[], NDArray[np.float64]]) -> float | None:
    """The largest of the numbers that a search finds; None where it says that there are none."""
    try:
        found = find()
    except BadInput:
        return None
    return float(found.max()) if np.isfinite(found).all() else None
