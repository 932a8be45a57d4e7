"""Samples over time from CSV files, read alike for gaits and paths.

Lines that are empty or start with ``#`` are skipped; what the columns mean is
each robot's own business.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.model.specification import read_text


@dataclass(frozen=True)
class Line:
    """A line of a CSV file.

    Attributes:
        where: File and line, for messages.
        cells: Its cells without the blanks around them.
    """

    where: str
    cells: tuple[str, ...]


def read_rows(kind: str, file: str | Path) -> list[Line]:
    """Lines of a CSV file, at least one; their widths are for :func:`check_width`.

    Args:
        kind: What the file is, for messages ("gait", "path").
        file: The file.

    Raises:
        BadInput: It can't be read, is empty or isn't CSV.
    """
    lines = read_text(kind, file).splitlines()
    rows = []
    try:
        for number, cells in enumerate(csv.reader(lines), start=1):
            stripped = tuple(cell.strip() for cell in cells)
            if any(stripped) and not stripped[0].startswith("#"):
                rows.append(Line(f"{file}:{number}", stripped))
    except csv.Error as error:
        raise BadInput(f"the {kind} isn't CSV: {error}", where=str(file)) from None
    if not rows:
        raise BadInput(f"the {kind} is empty", where=str(file))
    return rows


def check_width(rows: Sequence[Line]) -> None:
    """Refuse lines that are longer or shorter than the first.

    Raises:
        BadInput: Names the line and both widths.
    """
    width = len(rows[0].cells)
    for row in rows:
        if len(row.cells) != width:
            raise BadInput(
                f"{len(row.cells)} cells", where=row.where, allowed=f"{width}, as in the first row"
            )


def finite(cell: str) -> float | None:
    """The number in a cell; None if it isn't a finite one."""
    try:
        value = float(cell)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def numbers(rows: Sequence[Line], columns: Sequence[int], names: Sequence[str]) -> np.ndarray:
    """Some columns as numbers, shape ``(rows, columns)``.

    Args:
        rows: Lines below the header.
        columns: Numbers of the columns, from 0.
        names: What they are called, for messages.

    Raises:
        BadInput: A cell isn't a finite number; says line and column.
    """
    table = np.empty((len(rows), len(columns)))
    for k, row in enumerate(rows):
        for j, column in enumerate(columns):
            value = finite(row.cells[column])
            if value is None:
                raise BadInput(
                    f"{names[j]} is {row.cells[column]!r}",
                    where=f"{row.where}, column {column + 1}",
                    allowed="a finite number",
                )
            table[k, j] = value
    return table


def check_increasing(rows: Sequence[Line], time: np.ndarray) -> None:
    """Refuse samples whose time doesn't increase strictly.

    Raises:
        TrajectoryError: Names the line and both times.
    """
    back = np.flatnonzero(np.diff(time) <= 0)
    if back.size:
        k = int(back[0]) + 1
        raise TrajectoryError(
            f"time goes from {time[k - 1]:g} to {time[k]:g}",
            where=rows[k].where,
            allowed="strictly increasing time",
        )
