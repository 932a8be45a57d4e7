"""Rows of a list, whose headings say quantity and unit → actuators."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.cells import RANGE, Cell, blank, number_in, of_edges, said_in, size_in
from thesis_pin.sizing.units import QUANTITIES, Heading, bare, understood
from thesis_pin.tables.table import finite
from thesis_pin.tolerances import TOLERANCES

_EDGES = ("length", "width", "height")
_NEEDED = ("stall_torque", "no_load_speed")


def meanings_of(
    headings: Sequence[str], rows: Sequence[Mapping[str, Cell]], where: str
) -> dict[str, Heading]:
    """What each column means, for those that mean something here.

    Of several that could be the name the likeliest is taken. A column of words, as of what gears
    are made of, is no quantity. Two may say the same in two units.

    Args:
        headings: The columns.
        rows: Heading → cell, all of them.
        where: Their file, for messages.

    Raises:
        BadInput: Two say the same, or none says the torque or the speed.
    """
    meanings = {
        heading: found
        for heading in headings
        if (found := understood(heading)) and not _of_words(heading, found, rows)
    }
    names = QUANTITIES["name"].names
    called = [heading for heading, one in meanings.items() if one.quantity == "name"]
    for other in sorted(called, key=lambda heading: names.index(bare(heading)))[1:]:
        del meanings[other]
    count = Counter((one.quantity, one.voltage, one.factor) for one in meanings.values())
    for heading, one in meanings.items():
        if count[one.quantity, one.voltage, one.factor] > 1:
            same = [h for h, other in meanings.items() if other.quantity == one.quantity]
            raise BadInput(
                f"{' and '.join(map(shown, same))} both say the {_words(one.quantity)}",
                where=where,
                allowed="one column",
            )
        if one.voltage is not None and one.quantity not in _BY_VOLTAGE:
            raise BadInput(f"{heading!r} can't depend on the voltage", where=where)
    for needed in ("name", "stall_torque", "no_load_speed"):
        if all(one.quantity != needed for one in meanings.values()):
            raise BadInput(
                f"no column says the {_words(needed)}",
                where=where,
                allowed=needed + QUANTITIES[needed].example,
                remedy=f"It has {', '.join(map(shown, headings[:12]))}",
            )
    return meanings


def _of_words(heading: str, meaning: Heading, rows: Sequence[Mapping[str, Cell]]) -> bool:
    """Whether a column that needn't be there holds words only."""
    if meaning.quantity in ("name", *_NEEDED):
        return False
    cells = [str(row.get(heading, "")) for row in rows]
    return not any(map(blank, cells)) and not any(re.search(r"\d", cell) for cell in cells)


def lacking(row: Mapping[str, Cell], meanings: Mapping[str, Heading]) -> str:
    """The torque or the speed, in words, if a row lacks it at every voltage; else nothing."""
    least = ""
    for voltage in _volts(meanings):
        said = {
            one.quantity
            for heading, one in meanings.items()
            if one.voltage in (None, voltage) and not blank(row.get(heading, ""))
        }
        missing = [_words(one) for one in _NEEDED if one not in said]
        if not missing:
            return ""
        least = least or " and no ".join(missing)
    return least


def named(row: Mapping[str, Cell], meanings: Mapping[str, Heading]) -> str:
    """What a row calls its actuator."""
    called = [heading for heading, one in meanings.items() if one.quantity == "name"]
    return said_in(row[called[0]]) or "a servo" if called else "a servo"


def _volts(meanings: Mapping[str, Heading]) -> list[float | None]:
    """The voltages that headings name; None alone, if none does."""
    return [*sorted({one.voltage for one in meanings.values() if one.voltage is not None})] or [
        None
    ]


_BY_VOLTAGE = ("stall_torque", "no_load_speed", "rated_torque")


def _words(quantity: str) -> str:
    return quantity.replace("_", " ").replace("no load", "no-load")


def unsaid(
    meanings: Mapping[str, Heading], rows: Sequence[Mapping[str, Cell]], where: str
) -> list[str]:
    """Columns of which neither heading nor cells say a unit, and what they were taken for."""
    plain = [
        f"{heading} ({QUANTITIES[one.quantity].si})"
        for heading, one in meanings.items()
        if one.plain
        and QUANTITIES[one.quantity].si
        and any(finite(str(row.get(heading, ""))) is not None for row in rows)
    ]
    said = [f"{where} says no unit of {', '.join(plain)}: taken so"] if plain else []
    edges = [
        heading
        for heading, one in meanings.items()
        if one.plain
        and one.quantity in ("size", *_EDGES)
        and any(re.search(r"[\d)]\s*$", str(row.get(heading, ""))) for row in rows)
    ]
    if edges:
        said.append(
            f"{where} says no unit of {', '.join(edges)}: taken as mm where above 1, else as m"
        )
    firsts: dict[tuple[str, float | None], str] = {}
    for heading, one in meanings.items():
        first = firsts.setdefault((one.quantity, one.voltage), heading)
        if first != heading:
            said.append(
                f"{where} says the {_words(one.quantity)} twice: {first} is used, {heading} agrees"
            )
    return said


def actuators_of(
    row: Mapping[str, Cell], meanings: Mapping[str, Heading], where: str
) -> Iterator[Actuator]:
    """A row's actuator, one for each voltage that its columns name and at which it has both.

    Args:
        row: Heading → cell.
        meanings: Of the headings, from :func:`meanings_of`.
        where: File and line, for messages.

    Raises:
        BadInput: It has no name, a cell is no number, or two say something else.
    """
    extra = {key: said_in(cell) for key, cell in row.items() if key not in meanings and key}
    for voltage in _volts(meanings):
        here = {h: one for h, one in meanings.items() if one.voltage in (None, voltage)}
        if lacking(row, here):
            continue  # not made for this voltage
        yield _actuator(row, here, where, voltage, dict(extra))


def _actuator(
    row: Mapping[str, Cell],
    meanings: Mapping[str, Heading],
    where: str,
    voltage: float | None,
    extra: dict[str, str],
) -> Actuator:
    """The actuator of a row whose headings hold at one voltage."""
    values: dict[str, float] = {}
    name, size, notes = "", None, []
    for heading, one in meanings.items():
        cell = row.get(heading, "")
        if blank(cell):
            continue
        here = f"{where}: {heading}"
        if one.quantity == "name":
            name = said_in(cell)
        elif one.quantity == "size":
            size = size_in(cell, one, here)
        elif one.quantity == "voltage" and RANGE.fullmatch(str(cell).strip()):
            extra[heading] = said_in(cell)
            notes.append(f"nothing says at which voltage of {cell} its torque and speed hold")
        else:
            _take(values, one, number_in(cell, one, here), here)
    if not name:
        raise BadInput("it has no name", where=where)
    if size is None and all(edge in values for edge in _EDGES):
        plain = any(one.plain for one in meanings.values() if one.quantity in _EDGES)
        size = of_edges([values[edge] for edge in _EDGES], plain)
    return Actuator(
        name,
        values["stall_torque"],
        values["no_load_speed"],
        values.get("rated_torque"),
        values.get("voltage", voltage),
        values.get("mass"),
        size,
        values.get("rotor_inertia", 0.0),
        values.get("gear_ratio", 1.0),
        values.get("armature", 0.0),
        notes=tuple(notes),
        extra=extra,
        where=where,
    )


def _take(values: dict[str, float], heading: Heading, value: float, where: str) -> None:
    """Keep a quantity's first value, which a second has to agree with."""
    first = values.setdefault(heading.quantity, value)
    if abs(first - value) > TOLERANCES.sheet_rounding * max(abs(first), abs(value)):
        si = QUANTITIES[heading.quantity].si
        raise BadInput(
            f"it says a {_words(heading.quantity)} of {value:.4g} {si}, and another column "
            f"says {first:.4g} {si}",
            where=where,
            allowed="the same up to rounding",
        )
