"""Tables of samples from text files, within the limits of what is read.

Lines that are empty or start with ``#`` or ``%`` are skipped, and so is Excel's first line
``sep=;``; a line of units below the header is added to it.
"""

from __future__ import annotations

import csv
import io
import itertools
import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from thesis_pin.display.counted import counted
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.source import read_any_text
from thesis_pin.tables.dialect import MARKS, NUMBER, Dialect, decimal_of, separator_of, split
from thesis_pin.tables.table import Table

TABLES = (".csv", ".tsv", ".txt", ".dat")
"""Endings of files that are read as tables."""

_ANNOUNCED = re.compile(r'"?sep=(.)"?[;,\t]*', re.IGNORECASE)
_COMMENT = ("#", "%")
_UNITS = re.compile(r"(|-|°|[mµμu]?s|[mc]?m|rad|deg)(/(s²?|s\^?2|min))?")
_LOOKED = 50
"""Lines from which the separator is recognised."""

_Row = tuple[int, tuple[str, ...]]
"""Number of a line, from 1, and its cells."""


def read_table(
    kind: str,
    file: str | Path,
    *,
    bare: Sequence[str] = (),
    means: Callable[[str], object] | None = None,
) -> Table:
    """A table with a header from a text file.

    Args:
        kind: What the file is, for messages ("gait", "path").
        file: The file.
        bare: Names of the columns of a table that has no header; none, where it has to.
        means: Whether a column of that name is used; how numbers are written in others, as
            prices, doesn't matter. None: all are.

    Raises:
        BadInput: It can't be read, is empty, has no header, lines of different widths or two
            decimal marks, or passes a limit of :mod:`thesis_pin.model.limits`.
    """
    name = str(file)
    whole, encoding = read_any_text(kind, file, LIMITS.csv_bytes)
    text, separator = _separated(whole)
    rows = list(_bounded(kind, name, _rows(kind, name, text, separator)))
    if not rows:
        raise BadInput(f"the {kind} is empty", where=name)
    header, commented = _header(kind, name, text, rows, bare, separator)
    decimal = "."
    if separator != "," or '"' in text:
        decimal = decimal_of(name, _used(rows, header, means))
    if not commented and not _numeric(rows[0][1]):
        rows = rows[1:]
    units = rows[0][0] if len(rows) > 1 and _units(rows[0][1]) else 0
    if units:
        said = itertools.chain((one.strip("-[]()") for one in rows[0][1]), itertools.repeat(""))
        header = tuple(
            f"{one} [{unit}]" if unit else one for one, unit in zip(header, said, strict=False)
        )
        rows = rows[1:]
    cells = list(_of_one_width(name, rows, header, commas=separator == ","))
    lines = np.array([line for line, _ in rows], dtype=np.intp)
    return Table(
        name, header, lines, cells, Dialect(separator, decimal, commented, encoding, units)
    )


def _separated(text: str) -> tuple[str, str]:
    """The text, without a line that announces the separator, and the separator."""
    first, _, rest = text.partition("\n")
    announced = _ANNOUNCED.fullmatch(first.strip(" "))
    if announced and announced[1] in MARKS:
        return "\n" + rest, announced[1]
    looked = list(itertools.islice((x for x in io.StringIO(text) if _content(x)), _LOOKED))
    return text, separator_of(looked) if looked else ","


def _content(line: str) -> bool:
    line = line.strip().lstrip('"')
    return bool(line.strip(';,|" \t')) and not line.startswith(_COMMENT)


def _rows(kind: str, name: str, text: str, separator: str) -> Iterator[_Row]:
    """Lines that hold something and aren't comments."""
    if separator == " ":
        for number, line in enumerate(io.StringIO(text), start=1):
            cells = tuple(line.split())
            if cells and not cells[0].startswith(_COMMENT):
                yield number, cells
        return
    reader = csv.reader(io.StringIO(text), delimiter=separator)
    try:
        for written in reader:
            stripped = tuple([cell.strip() for cell in written])  # faster than a generator
            if len(stripped) > LIMITS.columns or (
                any(stripped) and not stripped[0].startswith(_COMMENT)
            ):
                yield reader.line_num, stripped
    except csv.Error as error:
        where = f"{name}:{reader.line_num}"
        raise BadInput(f"the {kind} isn't CSV: {error}", where=where) from None


def _bounded(kind: str, name: str, rows: Iterator[_Row]) -> Iterator[_Row]:
    """The same lines, as far as they keep the limits of what is read."""
    cells = 0
    for count, row in enumerate(rows, start=1):
        columns = len(row[1])
        cells += columns
        if columns <= LIMITS.columns and cells <= LIMITS.cells and count <= LIMITS.rows:
            yield row
            continue
        for what, size, most in (
            ("columns", columns, LIMITS.columns),
            ("cells", cells, LIMITS.cells),
            ("lines", count, LIMITS.rows),
        ):
            if size > most:
                raise BadInput(
                    f"the {kind} has {size:,} {what} up to here",
                    where=f"{name}:{row[0]}",
                    allowed=f"at most {most:,}",
                    remedy="Leave out samples or columns",
                )


def _numeric(cells: Sequence[str]) -> bool:
    return all(NUMBER.fullmatch(cell) or not cell for cell in cells) and any(cells)


def _units(cells: Sequence[str]) -> bool:
    """Whether a line below the header holds the columns' units."""
    return any(one.strip("-[]()") for one in cells) and all(
        _UNITS.fullmatch(one.strip("[]()")) for one in cells
    )


def _header(
    kind: str, name: str, text: str, rows: Sequence[_Row], bare: Sequence[str], separator: str
) -> tuple[tuple[str, ...], int]:
    """Names of the columns, and the line of the comment that says them, else 0."""
    first, cells = rows[0]
    if not _numeric(cells):
        return _without_last(cells), 0
    comment, line = "", 0
    for number, one in enumerate(itertools.islice(io.StringIO(text), first - 1), start=1):
        if one.lstrip().startswith(_COMMENT):
            comment, line = one.strip().lstrip("#% "), number
    cells = _without_last(cells)
    said = tuple(split(comment, separator)) if comment else ()
    if len(said) == len(cells) and all(re.fullmatch(r"[^\W\d]\w*", one) for one in said):
        return said, line
    if len(bare) != len(cells):
        allowed = f"{len(bare)}: {', '.join(bare)}" if bare else "a header of names"
        raise BadInput(
            f"the {kind} has {counted(len(cells), 'column')} without a header",
            where=f"{name}:{first}",
            allowed=allowed,
            remedy="Write the columns' names into the first line",
        )
    return tuple(bare), 0


def _used(
    rows: Sequence[_Row], header: Sequence[str], means: Callable[[str], object] | None
) -> Sequence[_Row]:
    """The rows with the cells of those columns only that are used."""
    if means is None:
        return rows
    places = [k for k, heading in enumerate(header) if means(heading)]
    if not places or len(places) == len(header):
        return rows
    return [(line, tuple(cells[k] for k in places if k < len(cells))) for line, cells in rows]


def _without_last(cells: tuple[str, ...]) -> tuple[str, ...]:
    """Cells without the empty ones at the end, which spreadsheets leave there."""
    while cells and not cells[-1]:
        cells = cells[:-1]
    return cells


def _of_one_width(
    name: str, rows: Sequence[_Row], header: Sequence[str], *, commas: bool
) -> Iterator[tuple[str, ...]]:
    """Cells of the rows, as many as the header's; more at the end have to be empty."""
    width = len(header)
    for line, cells in rows:
        if len(cells) != width:
            if len(cells) < width or any(cells[width:]):
                raise BadInput(
                    counted(len(cells), "cell"),
                    where=f"{name}:{line}",
                    allowed=f"{width}, as in the first row",
                    remedy="If commas are decimal marks, separate cells by semicolons"
                    if commas and len(cells) > width
                    else "",
                )
            cells = cells[:width]
        yield cells
