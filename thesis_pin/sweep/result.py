"""A sweep as it is handed over: every design's row, and the effort that it took."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sweep.designs.making import Designs
from thesis_pin.sweep.study import DONE, FAILED, LOST, Cell, Column, Row, Study

_NUMBER = re.compile(r"[-+−]?\d[\d.,]*(e[-+]?\d+)?")
_SHARE = "×"
"""Unit of values that multiply what a key is in the file."""


@dataclass(frozen=True)
class Effort(Brief):
    """What a sweep took, which isn't part of its answer.

    Attributes:
        jobs: Processes of this machine; 0 on a cluster.
        scheduler: Of the cluster.
        judged: Designs that were judged in this run; the others' rows stood in the folder.
        seconds: How long it took [s].
        memory: Most memory that a process had [byte].
    """

    jobs: int
    scheduler: str | None
    judged: int
    seconds: float
    memory: float


@dataclass(frozen=True, eq=False)
class Sweep(Brief):
    """Every design's row.

    Attributes:
        study: What was asked.
        designs: Of what.
        rows: A row for each design, in their order.
        effort: What it took.
    """

    study: Study
    designs: Designs
    rows: tuple[Row, ...]
    effort: Effort

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """What varied and what was found, in the order of the table."""
        varied = (
            Column(one.label, _SHARE * one.relative, kind="number" if number else "text")
            for one, number in zip(self.designs.parameters, self.designs.numeric, strict=True)
        )
        return (*varied, *self.study.columns)

    def column(self, name: str) -> Column:
        """A column by its name.

        Raises:
            UnknownName: There is none.
        """
        known = {column.name: column for column in self.columns}
        if name not in known:
            raise UnknownName("column", name, tuple(known))
        return known[name]

    def numbers(self, name: str) -> NDArray[np.float64]:
        """A column of numbers or flags, shape ``(designs,)``; NaN where there is none.

        Raises:
            UnknownName: There is no such column.
            BadInput: It holds texts.
        """
        if self.column(name).kind == "text":
            raise BadInput(
                f"{name} holds texts",
                where="column",
                allowed=", ".join(one.name for one in self.columns if one.kind == "number"),
            )
        cells = self._cells(name)
        return np.array([np.nan if one is None else float(one) for one in cells])

    def _cells(self, name: str) -> list[Cell]:
        names = [column.name for column in self.columns]
        k, many = names.index(name), len(self.designs.parameters)
        if k < many:
            return [row.values[k] for row in self.rows]
        return [row.cells[k - many] for row in self.rows]

    @cached_property
    def done(self) -> NDArray[np.bool_]:
        """Which designs were judged, shape ``(designs,)``."""
        return np.array([row.status == DONE for row in self.rows], dtype=bool)

    @cached_property
    def feasible(self) -> NDArray[np.bool_]:
        """Which designs keep every limit, shape ``(designs,)``."""
        return np.asarray(self.done & (self.numbers(self.study.feasible) == 1.0))

    @property
    def considered(self) -> NDArray[np.bool_]:
        """Which designs are chosen from: those that keep every limit; if none does, all judged."""
        return self.feasible if self.feasible.any() else self.done

    def reasons(self) -> list[tuple[str, str, int]]:
        """Status and reason of designs that weren't judged, and how many; the commonest first.

        Reasons that differ in numbers only count as one, of which the first is given.
        """
        first: dict[tuple[str, str], str] = {}
        counted: Counter[tuple[str, str]] = Counter()
        for row in self.rows:
            if row.status != DONE:
                kind = row.status, _NUMBER.sub("#", row.reason)
                first.setdefault(kind, row.reason)
                counted[kind] += 1
        return [(kind[0], first[kind], count) for kind, count in counted.most_common()]

    def mistakes(self) -> list[str]:
        """Reasons of designs that failed by a mistake of ours or whose process died."""
        return [reason for status, reason, _ in self.reasons() if status in (FAILED, LOST)]

    def table(self) -> dict[str, NDArray[np.float64] | Sequence[str]]:
        """All rows as columns: heading → values; NaN and empty texts where there is nothing."""
        found: dict[str, NDArray[np.float64] | Sequence[str]] = {
            "design": [str(row.design) for row in self.rows]
        }
        for column in self.columns[: len(self.designs.parameters)]:
            found[column.heading] = self._written(column)
        found["status"] = [row.status for row in self.rows]
        for column in self.study.columns:
            found[column.heading] = self._written(column)
        found["warnings"] = [row.warnings for row in self.rows]
        found["reason"] = [row.reason for row in self.rows]
        return found

    def _written(self, column: Column) -> NDArray[np.float64] | Sequence[str]:
        if column.kind == "number":
            return self.numbers(column.name)
        cells = self._cells(column.name)
        return list(map(_text, cells))


def _text(cell: Cell) -> str:
    if cell is None:
        return ""
    return str(cell).lower() if isinstance(cell, bool) else str(cell)
