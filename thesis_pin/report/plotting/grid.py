"""Panels in rows and columns on one sheet."""

from __future__ import annotations

from collections.abc import Sequence

from thesis_pin.report.curves import Plot
from thesis_pin.report.plotting.panel import TITLE, Panel, panel
from thesis_pin.report.plotting.sheet import INCH, Box, Mark, Sheet, Text

PAD = 3.0
"""Around each panel and along the sheet's borders [pt]."""

LEAST = 20.0
"""Length of an axis however little room there is [pt]."""


def arranged(rows: Sequence[Sequence[Plot]], width: float, height: float, title: str = "") -> Sheet:
    """Plots side by side and one below the other, their axes in line and equally large.

    Args:
        rows: Rows of equally many plots.
        width: Width of the sheet [inch].
        height: Its height [inch].
        title: Headline above all; empty for none.
    """
    return Sheet(
        width, height, placed([[panel(plot) for plot in row] for row in rows], width, height, title)
    )


def placed(
    table: Sequence[Sequence[Panel]],
    width: float,
    height: float,
    title: str = "",
    floor: float = 0.0,
) -> list[Mark]:
    """Marks of panels in rows and columns; see :func:`arranged`.

    Args:
        table: Rows of equally many panels.
        width: Width of the sheet [inch].
        height: Its height [inch].
        title: Headline above all; empty for none.
        floor: Room left free below all [pt].
    """
    ceiling = height * INCH - (PAD + TITLE if title else 0.0)
    above = [max(one.above() for one in row) for row in table]
    below = [max(one.below() for one in row) for row in table]
    free = ceiling - floor - 2 * PAD * len(table) - sum(above) - sum(below)
    tall = max(free / len(table), LEAST)
    columns = list(zip(*table, strict=True))
    left = [max(one.left(tall) for one in column) for column in columns]
    right = [max(one.right(tall) for one in column) for column in columns]
    free = width * INCH - 2 * PAD * len(columns) - sum(left) - sum(right)
    wide = max(free / len(columns), LEAST)
    marks: list[Mark] = []
    if title:
        marks.append(Text(width * INCH / 2, height * INCH - PAD - 0.76 * TITLE, title, TITLE, 0.5))
    top = ceiling - PAD
    for row, over, under in zip(table, above, below, strict=True):
        start = PAD
        for one, before, after in zip(row, left, right, strict=True):
            cell = Box(start + before, top - over - tall, start + before + wide, top - over)
            marks += one.marks(cell)
            start += before + wide + after + 2 * PAD
        top -= over + tall + under + 2 * PAD
    return marks
