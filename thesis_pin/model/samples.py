"""Samples over time from CSV files, read alike for gaits and paths.

Lines that are empty or start with ``#`` are skipped; what the columns mean is
each robot's own business.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.source import read_text
from thesis_pin.numeric.checks import shown


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a CSV file.

    Attributes:
        file: The file.
        number: Number of the line, from 1.
        cells: Its cells without the blanks around them.
    """

    file: str
    number: int
    cells: tuple[str, ...]

    @property
    def where(self) -> str:
        """File and line, for messages."""
        return f"{self.file}:{self.number}"


def read_rows(kind: str, file: str | Path) -> list[Line]:
    """Lines of a CSV file, at least one; their widths are for :func:`check_width`.

    Args:
        kind: What the file is, for messages ("gait", "path").
        file: The file.

    Raises:
        BadInput: It can't be read, is empty, isn't CSV or passes a limit of
            :mod:`thesis_pin.model.limits`.
    """
    reader = csv.reader(io.StringIO(read_text(kind, file, LIMITS.csv_bytes)))
    rows: list[Line] = []
    name, count = str(file), 0
    try:
        for cells in reader:
            if (
                len(cells) > LIMITS.columns
                or count + len(cells) > LIMITS.cells
                or len(rows) >= LIMITS.rows
            ):
                _refuse_size(kind, f"{name}:{reader.line_num}", len(cells), count, len(rows))
            stripped = tuple([cell.strip() for cell in cells])  # faster than a generator
            if any(stripped) and not stripped[0].startswith("#"):
                rows.append(Line(name, reader.line_num, stripped))
                count += len(stripped)
    except csv.Error as error:
        where = f"{name}:{reader.line_num}"
        raise BadInput(f"the {kind} isn't CSV: {error}", where=where) from None
    if not rows:
        raise BadInput(f"the {kind} is empty", where=str(file))
    return rows


def _refuse_size(kind: str, where: str, columns: int, cells: int, rows: int) -> None:
    for what, count, most in (
        ("columns", columns, LIMITS.columns),
        ("cells", cells + columns, LIMITS.cells),
        ("lines", rows + 1, LIMITS.rows),
    ):
        if count > most:
            raise BadInput(
                f"the {kind} has {count:,} {what} up to here",
                where=where,
                allowed=f"at most {most:,}",
                remedy="Leave out samples or columns",
            )


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
    if "_" in cell:  # Python's own way of grouping digits, and nobody else's
        return None
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
    try:  # a column at a time, which is several times faster
        for j, column in enumerate(columns):
            cells = [row.cells[column] for row in rows]
            table[:, j] = list(map(float, cells))
            table[["_" in cell for cell in cells], j] = np.nan
        if (np.abs(table) <= LIMITS.magnitude).all():
            return table
    except ValueError:
        pass  # found again below, with its place
    for k, row in enumerate(rows):
        for j, column in enumerate(columns):
            value = finite(row.cells[column])
            if value is None or abs(value) > LIMITS.magnitude:
                raise BadInput(
                    f"{names[j]} is {shown(row.cells[column])}",
                    where=f"{row.where}, column {column + 1}",
                    allowed="a finite number"
                    + ("" if value is None else f" of magnitude at most {LIMITS.magnitude:g}"),
                )
            table[k, j] = value
    return table


def check_increasing(rows: Sequence[Line], time: np.ndarray) -> None:
    """Refuse samples whose time doesn't increase by at least ``LIMITS.time_step``.

    Raises:
        TrajectoryError: Names the line and both times.
    """
    back = np.flatnonzero(np.diff(time) < LIMITS.time_step)
    if back.size:
        k = int(back[0]) + 1
        raise TrajectoryError(
            f"time goes from {time[k - 1]:.12g} to {time[k]:.12g}",
            where=rows[k].where,
            allowed=f"strictly increasing time, in steps of at least {LIMITS.time_step:g}",
        )
