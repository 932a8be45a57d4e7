"""Legends: names beside samples of how things look."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.report.plotting.sheet import Box, Look, Mark, Shape, Text, colour, text_width

SIZE = 8.0
"""Of the font [pt]; all other lengths here are multiples of it."""

_LINE = 1.55 * SIZE
_PAD = 0.5 * SIZE
_SAMPLE = 2.0 * SIZE
_GAP = 0.8 * SIZE
_BETWEEN = 1.75 * SIZE
_SPARE = 0.04  # of a name: letters on whole pixels are that much wider
_EDGE = Look(colour("#cccccc"), 1.0, fill=colour("#ffffff", 0.8))


@dataclass(frozen=True)
class Entry:
    """A line of a legend.

    Attributes:
        name: Its text.
        look: Of what it names.
        area: Whether that is an area, not a line.
    """

    name: str
    look: Look
    area: bool = False


@dataclass(frozen=True)
class Legend:
    """What a legend holds, in columns.

    Attributes:
        entries: In their order.
        columns: Number of columns.
    """

    entries: Sequence[Entry]
    columns: int = 1

    @property
    def rows(self) -> int:
        """Entries of a column, at most."""
        return math.ceil(len(self.entries) / self.columns)

    @property
    def widths(self) -> list[float]:
        """Of the columns [pt]."""
        return [
            _SAMPLE + _GAP + max(_room(entry.name) for entry in column)
            for column in self._columns()
        ]

    @property
    def width(self) -> float:
        """Of the whole [pt]."""
        widths = self.widths
        return 2 * _PAD + sum(widths) + _BETWEEN * (len(widths) - 1)

    @property
    def height(self) -> float:
        """Of the whole [pt]."""
        return 2 * _PAD + self.rows * _LINE

    def marks(self, left: float, top: float) -> Iterator[Mark]:
        """Draw it with its upper left corner there [pt]."""
        frame = Box(left, top - self.height, left + self.width, top)
        yield Shape(frame.corners(), _EDGE, closed=True, snap=True)
        x = left + _PAD
        for column, width in zip(self._columns(), self.widths, strict=True):
            for k, entry in enumerate(column):
                middle = top - _PAD - (k + 0.5) * _LINE
                yield _sample(entry, x, middle)
                yield Text(x + _SAMPLE + _GAP, middle - 0.36 * SIZE, entry.name, SIZE)
            x += width + _BETWEEN

    def _columns(self) -> list[Sequence[Entry]]:
        rows = self.rows
        return [self.entries[k : k + rows] for k in range(0, len(self.entries), rows)]


def _room(name: str) -> float:
    width = text_width(name, SIZE)
    return width + max(_SPARE * width, 0.25 * SIZE)


def fitting(entries: Sequence[Entry], height: float) -> Legend:
    """A legend of as many columns as make it no higher than that [pt], if any do."""
    rows = max(1, math.floor((height - 2 * _PAD) / _LINE))
    return Legend(entries, math.ceil(len(entries) / rows))


def _sample(entry: Entry, x: float, y: float) -> Shape:
    if entry.look.marks:
        return Shape(np.array([(x + _SAMPLE / 2, y)]), entry.look)
    if entry.area:
        box = Box(x, y - 0.35 * SIZE, x + _SAMPLE, y + 0.35 * SIZE)
        return Shape(box.corners(), entry.look, closed=True)
    return Shape(np.array([(x, y), (x + _SAMPLE, y)]), entry.look)
