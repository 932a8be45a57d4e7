"""What the columns of a table mean, by what they are called."""

from __future__ import annotations

import difflib
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.tables.table import Column, Table, check_increasing
from thesis_pin.tables.units import PLAIN, TIME, TIME_NAMES, Unit, Units, headings

CLOSE = 0.6
"""How alike two names have to be for one to be offered for the other, of 1."""


@dataclass(frozen=True)
class Meaning:
    """What a column may hold.

    Attributes:
        quantity: Which quantity, as the reader calls it.
        unit: Its unit.
        said: The quantity for messages.
    """

    quantity: Hashable
    unit: Unit
    said: str = ""


Known = Mapping[str, Sequence[Meaning]]
"""What a column may be called → all that it could mean then."""

Chosen = dict[Hashable, tuple[int, Unit]]
"""Quantity → number of its column, from 0, and its unit."""


def known_names(quantities: Iterable[tuple[str, Units]]) -> dict[str, list[Meaning]]:
    """All headings of some quantities that are called by their names."""
    return {
        heading: [Meaning(name, unit, name)]
        for name, units in quantities
        for heading, unit in headings(name, units).items()
    }


def time_names() -> dict[str, list[Meaning]]:
    """All headings of a column of time, which is the quantity ``"t"``."""
    return {
        heading: [Meaning("t", unit, "the time")]
        for name in TIME_NAMES
        for heading, unit in headings(name, TIME).items()
    }


def text_names(*names: str) -> dict[str, list[Meaning]]:
    """Headings of columns that hold words."""
    return {name: [Meaning(name, PLAIN[0], name)] for name in names}


def chosen(
    table: Table, known: Known, allowed: Sequence[str], *, lenient: bool = False
) -> tuple[Chosen, list[str]]:
    """Which column holds what.

    Args:
        table: The table.
        known: What its columns may be called.
        allowed: The same in short, for messages.
        lenient: Pass over columns that mean nothing.

    Returns:
        The columns, and the headings that are passed over.

    Raises:
        UnknownName: A column means nothing; names the nearest that do.
        BadInput: One could mean two things, two mean the same, or one with content has no name.
    """
    found: Chosen = {}
    unused = []
    for place, heading in enumerate(table.header):
        meanings = known.get(heading)
        if not heading:
            if any(row[place] for row in table.rows):
                raise BadInput(f"column {place + 1} has no name", where=table.file)
            continue
        if meanings is None:
            if not lenient:
                raise _unknown(table, heading, known, allowed)
            unused.append(heading)
            continue
        if len({one.quantity for one in meanings}) > 1:
            could = " or ".join(one.said for one in meanings)
            raise BadInput(
                f"column {heading!r} could be {could}",
                where=table.file,
                remedy="Write the unit behind it, as in NAME_rad",
            )
        quantity = meanings[0].quantity
        if quantity in found:
            raise BadInput(
                f"columns {table.header[found[quantity][0]]!r} and {heading!r} say the same",
                where=table.file,
            )
        found[quantity] = place, meanings[0].unit
    return found, unused


def time_column(table: Table, columns: Chosen) -> Column:
    """The column of time; it has to be there, and to increase.

    Raises:
        BadInput: There is none, or a cell isn't a number.
        TrajectoryError: It doesn't increase.
    """
    if "t" not in columns:
        raise BadInput(
            "there is no column of time",
            where=table.file,
            allowed="t or time [s], t_ms, t_us",
        )
    time = table.column(*columns["t"], "t")
    check_increasing(table, time)
    return time


def _unknown(table: Table, name: str, known: Known, allowed: Sequence[str]) -> UnknownName:
    near = difflib.get_close_matches(name, known, 3, CLOSE)
    if not near:  # a name that only lacks or has another unit
        near = [one for one in known if name and (one.startswith(name) or name.startswith(one))]
    remedy = f"Did you mean {' or '.join(map(repr, near[:3]))}?" if near else ""
    return UnknownName("column", name, allowed, where=table.file, remedy=remedy)
