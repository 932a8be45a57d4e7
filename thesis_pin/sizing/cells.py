"""Cells of a list as people fill them: numbers with or without units, ratios, sizes, nothing."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import shown
from thesis_pin.sizing.units import QUANTITIES, Heading, bare
from thesis_pin.tables.table import finite

Cell = float | str | tuple[float, ...]
"""What a cell of a table or a value of a TOML file may be."""

RANGE = re.compile(
    r"\d+(?:[.,]\d+)?\s*v?\s*(?:-|–|~|to|…|\.\.+|/)\s*\d+(?:[.,]\d+)?\s*v?", re.IGNORECASE
)
"""A range of voltages."""

_WITH_UNIT = re.compile(r"([-+]?\d*(?:[.,]\d+)?(?:[eE][-+]?\d+)?)\s*([^\d\s.,].*)")
_EDGE = re.compile(r"\s*(\d+(?:[.,]\d+)?)\s*(mm|cm|m|in|\"|″)?\s*", re.IGNORECASE)
_GROUPED = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}")
_NOTHING = frozenset(
    ("", "-", "–", "—", "/", "?", "n/a", "n.a.", "na", "nan", "none", "unknown", "tbd", "tba")
)
"""What stands in a cell that says nothing."""
_ANY_SIGN = ("gear_ratio",)
_MAY_BE_ZERO = ("rotor_inertia", "armature")


def blank(cell: Cell) -> bool:
    """Whether a cell says nothing."""
    return isinstance(cell, str) and cell.strip().casefold() in _NOTHING


def said_in(cell: Cell) -> str:
    return cell if isinstance(cell, str) else f"{cell}"


def number_in(cell: Cell, heading: Heading, where: str) -> float:
    """A cell as a number in SI, with its unit or without; ``200:1`` is a gear ratio."""
    text = str(cell).strip()
    value = cell if isinstance(cell, float) else finite(text)
    if value is None and heading.quantity == "gear_ratio":
        parts = [finite(part.strip()) for part in re.split("[:/]", text)]
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
        raise BadInput(
            f"{shown(cell)} isn't a number",
            where=where,
            allowed=f"a finite number of magnitude at most {LIMITS.magnitude:g}",
        )
    if (abs(value) if heading.quantity in _ANY_SIGN else value) < least:
        raise BadInput(f"it is {value:g}", where=where, allowed=f"at least {least:g}")
    return heading.si(float(value))


def size_in(cell: Cell, heading: Heading, where: str) -> tuple[float, float, float]:
    """Three edges [m]: ``40 x 20 x 38 mm``; see :func:`of_edges` if no unit is said."""
    parts = (
        [str(part) for part in cell] if isinstance(cell, tuple) else re.split(r"[xX×*]", str(cell))
    )
    edges = [_EDGE.fullmatch(part) for part in parts]
    said = {(edge[2] or "").lower() for edge in edges if edge} - {""}
    unit = heading.factor
    if len(said) == 1:
        word = said.pop()
        named = QUANTITIES["size"].units["in" if word in '"″' else word]
        unit = named if heading.plain or named == unit else 0.0
        heading = replace(heading, plain=False)
    lengths = [float(edge[1].replace(",", ".")) * unit for edge in edges if edge]
    if len(parts) != 3 or len(lengths) != 3 or said or min(lengths) <= 0:
        raise BadInput(f"{shown(cell)} isn't a size", where=where, allowed="as 40 x 20 x 38")
    return of_edges(lengths, heading.plain)


def of_edges(lengths: Sequence[float], plain: bool) -> tuple[float, float, float]:
    """Edges in metres; without a unit those of more than a metre are millimetres."""
    unit = 1e-3 if plain and max(lengths) > 1 else 1.0
    x, y, z = (length * unit for length in lengths)
    return x, y, z
