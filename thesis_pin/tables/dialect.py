"""How a table is written: what stands between its cells, and before its decimals.

Nothing is guessed in silence: a mark is taken where every cell makes sense with it, one file
has one decimal mark, and what could be read in two ways is refused.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown

MARKS = {",": "commas", ";": "semicolons", "\t": "tabs", "|": "bars", " ": "blanks"}
"""What may stand between cells, and its name; a blank means any run of blanks and tabs."""

NUMBER = re.compile(r"[+-]?(\d[\d.,]*|[.,]\d+)([eE][+-]?\d+)?")
"""A number in whatever convention."""

_GROUPED = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")
"""What may be a whole number with its thousands grouped, or one with three decimals."""

_TWO_NUMBERS = re.compile(r"\d\s+[-+]?[.,]?\d")


@dataclass(frozen=True)
class Dialect:
    """How a table is written.

    Attributes:
        separator: What stands between cells, a key of :data:`MARKS`.
        decimal: Decimal mark, ``"."`` or ``","``.
        header: Line of the header where that is a comment (``# t, x``); 0 where it is not.
        encoding: Of its text, where that isn't UTF-8.
        units: Line below the header that holds the columns' units; 0 if none does.
    """

    separator: str = ","
    decimal: str = "."
    header: int = 0
    encoding: str = ""
    units: int = 0

    @property
    def notes(self) -> tuple[str, ...]:
        """What isn't plain CSV about it, for people, without a full stop; empty if nothing is."""
        said = [f"as {self.encoding}, since it isn't UTF-8"] if self.encoding else []
        if self.separator != ",":
            said.append(f"with {MARKS[self.separator]} between cells")
        if self.decimal != ".":
            said.append("with decimal commas")
        if self.header:
            said.append(f"with the comment in line {self.header} as its header")
        if self.units:
            said.append(f"with the units in line {self.units}")
        return (f"the table is read {', '.join(said)}",) if said else ()


def split(line: str, separator: str) -> list[str]:
    """Cells of one line without the blanks around them; quotes are taken off."""
    if separator == " ":
        return line.split()
    (cells,) = csv.reader([line], delimiter=separator)
    return [cell.strip() for cell in cells]


def separator_of(lines: Sequence[str]) -> str:
    """What stands between the cells of a table.

    Args:
        lines: Its first lines, the header first; neither empty nor comments.

    Returns:
        The first mark with which every cell is a name or a single number; a comma if there is
        none.
    """
    for mark in (";", "\t", "|", ",", " "):
        if mark in lines[0].strip() and all(_sensible(line, mark) for line in lines):
            return mark
    return next((mark for mark in (";", "\t", ",", "|") if mark in lines[0]), ",")


def _sensible(line: str, mark: str) -> bool:
    try:
        cells = split(line, mark)
    except (csv.Error, ValueError):
        return False
    others = {";", "\t", "|", ","} - {mark}
    return all(
        NUMBER.fullmatch(cell) or (others.isdisjoint(cell) and not _TWO_NUMBERS.search(cell))
        for cell in cells
    )


def decimal_of(file: str, rows: Sequence[tuple[int, Sequence[str]]]) -> str:
    """The decimal mark of a table in which commas don't just separate cells.

    Args:
        file: Its file, for messages.
        rows: Number and cells of each line.

    Raises:
        BadInput: Some cells have commas and some points, digits are grouped, or nothing
            tells whether they are.
    """
    if not any("," in cell for _, cells in rows for cell in cells):
        return "."
    comma = point = grouped = ""
    for line, cells in rows:
        for cell in cells:
            commas, points = cell.count(","), cell.count(".")
            marks = commas + points
            if not marks or (comma and marks == commas == 1) or not NUMBER.fullmatch(cell):
                continue
            place = f"{file}:{line}: {shown(cell)}"
            if marks > 1:
                raise BadInput(
                    f"the number {shown(cell)} groups its digits",
                    where=f"{file}:{line}",
                    allowed="digits and one decimal mark",
                )
            if points:
                point = point or place
            elif _GROUPED.fullmatch(cell):
                grouped = grouped or place
            else:
                comma = place
            if point and (comma or grouped):
                raise BadInput(
                    f"decimals are written with points ({point}) and with commas "
                    f"({comma or grouped})",
                    allowed="one decimal mark in a file",
                )
    if grouped and not comma:
        raise BadInput(
            f"nothing tells whether the comma in {grouped} is a decimal mark or groups thousands",
            remedy="Write decimals with points, and no thousands separators",
        )
    return "," if comma else "."
