"""Rows of a list, whose headings say quantity and unit → actuators."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import shown
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.units import QUANTITIES, Heading, bare, understood
from thesis_pin.tables.table import finite

Cell = float | str | tuple[float, ...]
"""What a cell of a table or a value of a TOML file may be."""

_WITH_UNIT = re.compile(r"([-+]?\d*(?:[.,]\d+)?(?:[eE][-+]?\d+)?)\s*([^\d\s.,].*)")
_GROUPED = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}")
_EDGES = ("length", "width", "height")
_ANY_SIGN = ("gear_ratio",)
_MAY_BE_ZERO = ("rotor_inertia", "armature")


def meanings_of(headings: Sequence[str], where: str) -> dict[str, Heading]:
    """What each column means, for those that mean something here.

    Raises:
        BadInput: Two say the same, or none says the torque or the speed.
    """
    meanings = {heading: found for heading in headings if (found := understood(heading))}
    count = Counter((one.quantity, one.voltage) for one in meanings.values())
    for heading, one in meanings.items():
        if count[one.quantity, one.voltage] > 1:
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
    return [f"{where} says no unit of {', '.join(plain)}: taken so"] if plain else []


def actuators_of(
    row: Mapping[str, Cell], meanings: Mapping[str, Heading], where: str
) -> Iterator[Actuator]:
    """A row's actuator, one for each voltage that its columns name.

    Args:
        row: Heading → cell.
        meanings: Of the headings, from :func:`meanings_of`.
        where: File and line, for messages.

    Raises:
        BadInput: It has no name, torque or speed, or a cell is no number.
    """
    volts = {one.voltage for one in meanings.values() if one.voltage is not None}
    extra = {key: _said(cell) for key, cell in row.items() if key not in meanings and key}
    each: list[float | None] = [*sorted(volts)] or [None]
    for voltage in each:
        values: dict[str, float] = {}
        name, size = "", None
        for heading, one in meanings.items():
            cell = row.get(heading, "")
            if one.voltage not in (None, voltage) or cell in ("", "-", "–"):
                continue
            here = f"{where}: {heading}"
            if one.quantity == "name":
                name = _said(cell)
            elif one.quantity == "size":
                size = _size(cell, one, here)
            else:
                values[one.quantity] = _value(cell, one, here)
        if voltage is not None and not {"stall_torque", "no_load_speed"} <= values.keys():
            continue  # not made for this voltage
        for needed in ("stall_torque", "no_load_speed"):
            if needed not in values:
                raise BadInput(f"it has no {_words(needed)}", where=f"{where}: {name or 'a servo'}")
        if not name:
            raise BadInput("it has no name", where=where)
        edges = [values.get(edge) for edge in _EDGES]
        if size is None and None not in edges:
            size = (values["length"], values["width"], values["height"])
        yield Actuator(
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
            extra=extra,
            where=where,
        )


def _said(cell: Cell) -> str:
    return cell if isinstance(cell, str) else f"{cell}"


def _value(cell: Cell, heading: Heading, where: str) -> float:
    """A cell as a number in SI, with its unit or without; ``200:1`` is a gear ratio."""
    text = str(cell).strip()
    value = cell if isinstance(cell, float) else finite(text)
    if value is None and heading.quantity == "gear_ratio":
        parts = [finite(part) for part in text.split(":")]
        if len(parts) == 2 and all(parts):
            turns, other = (float(part or 0) for part in parts)
            value = max(turns / other, other / turns)
    if value is None and (said := _WITH_UNIT.fullmatch(text)):
        units, unit = QUANTITIES[heading.quantity].units, bare(said[2])
        if unit in units and (heading.plain or units[unit] == heading.factor):
            number = said[1] if _GROUPED.fullmatch(said[1]) else said[1].replace(",", ".")
            value, heading = finite(number), replace(heading, factor=units[unit])
    least = 0.0 if heading.quantity in _MAY_BE_ZERO else LIMITS.smallest
    if isinstance(value, tuple) or value is None or not abs(value) <= LIMITS.magnitude:
        raise BadInput(f"{shown(cell)} isn't a number", where=where, allowed="a finite number")
    if (abs(value) if heading.quantity in _ANY_SIGN else value) < least:
        raise BadInput(f"it is {value:g}", where=where, allowed=f"at least {least:g}")
    return heading.si(float(value))


def _size(cell: Cell, heading: Heading, where: str) -> tuple[float, float, float]:
    """Three edges [m]: ``40 x 20 x 38``; in millimetres if no unit is said and they are large."""
    parts = cell if isinstance(cell, tuple) else re.split(r"[xX×*]", str(cell))
    edges = [part if isinstance(part, float) else finite(str(part).strip()) for part in parts]
    if len(edges) != 3 or any(edge is None or edge <= 0 for edge in edges):
        raise BadInput(f"{shown(cell)} isn't a size", where=where, allowed="as 40 x 20 x 38")
    unit = 1e-3 if heading.plain and max(map(float, edges)) > 1 else heading.factor  # type: ignore[arg-type]
    x, y, z = (float(edge or math.nan) * unit for edge in edges)
    return x, y, z
