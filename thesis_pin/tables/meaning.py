"""What the columns of a table mean, by what they are called."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
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


_BRACKETS = re.compile(r"(.*?)[\s_]*[\[(]\s*([^\[\]()]*?)\s*[\])]")
_SPELT = (
    ("°", "deg"),
    ("degrees", "deg"),
    ("degree", "deg"),
    ("radians", "rad"),
    ("millimetres", "mm"),
    ("millimeters", "mm"),
    ("milliseconds", "ms"),
    ("microseconds", "us"),
    ("seconds", "s"),
    ("sec", "s"),
    ("µ", "u"),
    ("μ", "u"),
    ("²", "2"),
    ("^", ""),
    ("ψ", "psi"),
    ("θ", "theta"),
    ("φ", "phi"),
)


def spelt(heading: str) -> str:
    """A heading in our spelling: ``Time [ms]`` → ``time_ms``, ``X (mm)`` → ``x_mm``.

    A lone T, which may be a temperature or a tool, stays as it is.
    """
    if heading == "T":
        return heading
    text = heading.strip().casefold()
    found = _BRACKETS.fullmatch(text)
    name, unit = found.groups() if found else (text, "")
    for written, meant in _SPELT:
        name, unit = name.replace(written, meant), unit.replace(written, meant)
    return "_".join(filter(None, re.split(r"[\s/_·-]+", f"{name} {unit}")))


def reader(known: Known) -> Callable[[str], Sequence[Meaning]]:
    """What a heading may mean: as it is written, else in our spelling; nothing, if neither."""
    folded: dict[str, list[Meaning]] = {}
    for name, meanings in known.items():
        folded.setdefault(spelt(name), []).extend(meanings)
    return lambda heading: known.get(heading, ()) or folded.get(spelt(heading), ())


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
    look = reader(known)
    exact = {one.quantity for heading in table.header for one in known.get(heading, ())}
    for place, heading in enumerate(table.header):
        meanings = look(heading)
        if not heading:
            if any(row[place] for row in table.rows) and not (place == 0 and _counts(table)):
                raise BadInput(f"column {place + 1} has no name", where=table.file)
            continue
        named_by_another = heading not in known and exact & {one.quantity for one in meanings}
        if not meanings or (lenient and named_by_another):
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


def _counts(table: Table) -> bool:
    """Whether the first column numbers the rows, as data frames write it."""
    first = table.rows[0][0] if table.rows else ""
    if not first.isdecimal() or len(first) > 9:
        return False
    return all(row[0] == str(k) for k, row in enumerate(table.rows, start=int(first)))


def _unknown(table: Table, name: str, known: Known, allowed: Sequence[str]) -> UnknownName:
    near = difflib.get_close_matches(name, known, 3, CLOSE)
    near = near or difflib.get_close_matches(name.casefold(), known, 3, CLOSE)
    if not near:  # a name that only lacks or has another unit
        near = [one for one in known if name and (one.startswith(name) or name.startswith(one))]
    remedy = f"Did you mean {' or '.join(map(repr, near[:3]))}?" if near else ""
    return UnknownName("column", name, allowed, where=table.file, remedy=remedy)
