"""A table that has been read: its lines, its cells, its columns as numbers in SI."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import shown
from thesis_pin.tables.dialect import Dialect
from thesis_pin.tables.resolution import quantum
from thesis_pin.tables.units import SI, Unit

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Column:
    """A column of numbers.

    Attributes:
        name: What it holds, without its unit.
        values: In SI, shape ``(n,)``.
        quantum: Smallest step that its text resolves, in SI; 0.0 if unknown.
        heading: What it is called in the file, for messages.
        unit: What it is written in.
    """

    name: str
    values: Array
    quantum: float = 0.0
    heading: str = ""
    unit: Unit = SI


@dataclass(frozen=True, eq=False)
class Table:
    """A table below its header.

    Attributes:
        file: Its file.
        header: What its columns are called.
        lines: Line of the file on which each row ends, from 1, shape ``(n,)``.
        rows: Cells of each row without the blanks around them, as many as the header's.
        dialect: How it is written.
    """

    file: str
    header: tuple[str, ...]
    lines: NDArray[np.intp]
    rows: Sequence[tuple[str, ...]]
    dialect: Dialect

    def __len__(self) -> int:
        return len(self.rows)

    def where(self, row: int) -> str:
        """File and line of a row, for messages."""
        return f"{self.file}:{self.lines[row]}"

    def between(self, rows: Iterable[int]) -> str:
        """File and lines of some rows, for messages."""
        return f"{self.file}:{', '.join(str(self.lines[row]) for row in rows)}"

    def refuse_repeats(self, used: Callable[[str], object] = bool) -> None:
        """Refuse two columns of one heading, of which only one would be read.

        Args:
            used: Whether a heading is of a column that is read.

        Raises:
            BadInput: There are two; with their heading and places.
        """
        for heading, count in Counter(self.header).items():
            if count > 1 and used(heading):
                places = [k for k, one in enumerate(self.header, 1) if one == heading]
                raise BadInput(
                    f"columns {' and '.join(map(str, places))} are both called {heading!r}",
                    where=self.file,
                    remedy="Keep one of them, or rename what isn't meant",
                )

    def texts(self, place: int) -> list[str]:
        """Cells of a column as they are written."""
        return [row[place] for row in self.rows]

    def column(self, place: int, unit: Unit, name: str) -> Column:
        """A column as numbers in SI.

        Args:
            place: Its number, from 0.
            unit: Its unit.
            name: What it holds.

        Raises:
            BadInput: A cell isn't a finite number; says line and column.
        """
        cells = self.texts(place)
        if self.dialect.decimal == ",":
            cells = [cell.replace(",", ".") for cell in cells]
        values = self._values(cells, place, name, unit) * unit.factor
        step = float(quantum(cells, values / unit.size)) * unit.size
        return Column(name, values, step, self.header[place], unit)

    def _values(self, cells: Sequence[str], place: int, name: str, unit: Unit) -> Array:
        tail = f"e{unit.tens}" if unit.tens else ""
        try:
            numbers = [float(cell + tail) for cell in cells] if tail else list(map(float, cells))
            values = np.array(numbers)
            grouped = "_" in "".join(cells)
            if not grouped and (np.abs(values) <= LIMITS.magnitude).all():
                return values
        except ValueError:
            pass  # an exponent of its own, or found again below with its place
        values = np.empty(len(cells))
        for k, cell in enumerate(cells):
            value = finite(cell, unit.tens)
            if value is None or abs(value) > LIMITS.magnitude:
                raise BadInput(
                    f"{name} is {shown(self.rows[k][place]) if cell else 'empty'}",
                    where=f"{self.where(k)}, column {place + 1}",
                    allowed="a finite number"
                    + ("" if value is None else f" of magnitude at most {LIMITS.magnitude:g}"),
                )
            values[k] = value
        return values


def alike(columns: Sequence[Column]) -> list[Column]:
    """Columns of one kind, those that never move with the resolution of those that do.

    Args:
        columns: Columns of one unit that one program wrote: all lengths, or all angles.
    """
    moving = [one.quantum for one in columns if np.ptp(one.values) > 0]
    if not moving:
        return list(columns)
    return [one if np.ptp(one.values) > 0 else replace(one, quantum=max(moving)) for one in columns]


def finite(cell: str, tens: int = 0) -> float | None:
    """The number in a cell times a power of ten; None if it isn't a finite one."""
    if "_" in cell:  # Python's own way of grouping digits, and nobody else's
        return None
    try:
        value = float(cell)
        if tens and math.isfinite(value):
            value = float(Decimal(cell.strip()).scaleb(tens))
    except (ValueError, InvalidOperation):
        return None
    return value if math.isfinite(value) else None


def check_increasing(table: Table, time: Column) -> None:
    """Refuse samples whose time doesn't increase by at least ``LIMITS.time_step``.

    Raises:
        TrajectoryError: Names the line and both times.
    """
    back = np.flatnonzero(np.diff(time.values) < LIMITS.time_step)
    if back.size:
        k = int(back[0]) + 1
        raise TrajectoryError(
            f"time goes from {time.values[k - 1]:.12g} to {time.values[k]:.12g}",
            where=table.where(k),
            allowed=f"strictly increasing time, in steps of at least {LIMITS.time_step:g}",
        )
