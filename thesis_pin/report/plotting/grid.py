"""Panels in rows and columns on one sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from thesis_pin.report.plotting.legend import Legend
from thesis_pin.report.plotting.panel import TITLE, Panel
from thesis_pin.report.plotting.sheet import INCH, Box, Mark, Sheet, Text, size_within

PAD = 3.0
"""Around each panel and along the sheet's borders [pt]."""

LEAST = 72.0
"""Length of an axis [pt]: where there is less room the sheet grows."""


def arranged(
    table: Sequence[Sequence[Panel]],
    width: float,
    height: float,
    title: str = "",
    legend: Legend | None = None,
) -> Sheet:
    """Panels side by side and one below the other, their axes in line and equally large.

    Args:
        table: Rows of equally many panels; those of a row that have one legend share it.
        width: Width of the sheet [inch]; it gets wider and higher where axes would vanish.
        height: Its height [inch].
        title: Headline above all; empty for none.
        legend: What stands below all; None for nothing.
    """
    rows = [_with_one_legend(row) for row in table]
    columns = list(zip(*rows, strict=True))
    above = [max(one.above() for one in row) for row in rows]
    below = [max(one.below() for one in row) for row in rows]
    floor = legend.height + PAD if legend else 0.0
    used = 2 * PAD * len(rows) + sum(above) + sum(below) + floor + (PAD + TITLE if title else 0.0)
    tall = max((height * INCH - used) / len(rows), LEAST)
    high = used + tall * len(rows)
    left = [max(one.left(tall) for one in column) for column in columns]
    right = [max(one.right(tall) for one in column) for column in columns]
    used = 2 * PAD * len(columns) + sum(left) + sum(right)
    legends = max(one.least() for row in rows for one in row)
    wide = max((width * INCH - used) / len(columns), LEAST, legends)
    across = used + wide * len(columns)
    marks: list[Mark] = []
    top = high - PAD
    if title:
        size = size_within(title, TITLE, across - 2 * PAD)
        marks.append(Text(across / 2, top - 0.76 * TITLE, title, size, 0.5))
        top -= PAD + TITLE
    for row, over, under in zip(rows, above, below, strict=True):
        start = PAD
        for one, before, after in zip(row, left, right, strict=True):
            cell = Box(start + before, top - over - tall, start + before + wide, top - over)
            marks += one.marks(cell)
            start += before + wide + after + 2 * PAD
        top -= over + tall + under + 2 * PAD
    if legend:
        marks += legend.marks((across - legend.width) / 2, floor)
    return Sheet(across / INCH, high / INCH, marks)


def _with_one_legend(row: Sequence[Panel]) -> Sequence[Panel]:
    """Panels that name the same things, so that only the last of them does."""
    *others, last = row
    if last.plane or any(one.plane or one.entries != last.entries for one in others):
        return row
    return [*(replace(one, entries=()) for one in others), last]
