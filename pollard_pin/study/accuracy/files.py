"""Tolerances as people write them: TOML, or a table with a row for each.

::

    format = 1
    distribution = "normal"        # the tolerance is three standard deviations; or "uniform"
    [[tolerances]]
    of = "lengths"                 # a kind, a name, a pattern such as "x_8*", or a list of them
    mm = 0.1
    [[tolerances]]
    of = ["axes", "motors"]
    deg = 0.05

A table has the columns ``parameter`` and ``tolerance_mm``, ``tolerance_deg`` or ``tolerance`` with
``unit``; ``distribution`` if need be. A later row comes before an earlier one; what no row names is
exact.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from pollard_pin.study.accuracy.tolerances import (
    DISTRIBUTIONS,
    Distribution,
    Rule,
    Tolerances,
    fitting,
    tolerances,
)
from thesis_pin.errors import BadInput
from thesis_pin.model.specification import Key, NotNegative, Strict, read_toml
from thesis_pin.numeric.checks import choice, shown
from thesis_pin.tables.reading import TABLES, read_table
from thesis_pin.tables.table import Table, finite

KIND = "list of tolerances"

_UNIT = {
    "mm": ("mm", 1.0),
    "millimetres": ("mm", 1.0),
    "m": ("mm", 1e3),
    "cm": ("mm", 10.0),
    "um": ("mm", 1e-3),
    "deg": ("deg", 1.0),
    "degrees": ("deg", 1.0),
    "rad": ("deg", 57.29577951308232),
    "mrad": ("deg", 0.05729577951308232),
}
"""Unit as people write it → ours, and its size in ours."""
_NAMES = ("parameter", "parameters", "of", "name", "dimension")


class Entry(Strict):
    """A tolerance of one or several parameters."""

    of: str | tuple[str, ...]
    mm: NotNegative | None = None
    deg: NotNegative | None = None
    distribution: Distribution | None = None

    def rules(self) -> Iterator[Rule]:
        """What it asks for, pattern by pattern."""
        for pattern in (self.of,) if isinstance(self.of, str) else self.of:
            for unit, size in (("mm", self.mm), ("deg", self.deg)):
                if size is not None:
                    yield Rule(pattern, size, "mm" if unit == "mm" else "deg", self.distribution)


class ToleranceFile(Strict):
    """Tolerances in TOML."""

    format: Literal[1]
    distribution: Distribution | None = None
    tolerances: tuple[Entry, ...]

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Every entry has a size, and its patterns fit something."""
        for number, entry in enumerate(self.tolerances):
            if entry.mm is None and entry.deg is None:
                yield ("tolerances", number), "has no size: mm = … or deg = …", None
            for rule in entry.rules():
                try:
                    fitting(rule)
                except BadInput as error:
                    yield ("tolerances", number, "of"), error.message(), None


def read_tolerances(file: str | Path, distribution: Distribution | None = None) -> Tolerances:
    """Read tolerances; see the head of this module.

    Args:
        file: ``.toml``, or a table.
        distribution: Of those whose file doesn't say theirs; None for ``"uniform"``.

    Raises:
        BadInput: It can't be read, or a row can't be used; says which.
        SpecificationError: A TOML file is wrong; carries every problem.
    """
    name = str(file)
    if distribution is not None:
        choice("distribution", distribution, DISTRIBUTIONS)
    usual: Distribution = "uniform" if distribution is None else distribution
    if not name.lower().endswith(TABLES):
        listed = read_toml(KIND, ToleranceFile, file)
        rules = [rule for entry in listed.tolerances for rule in entry.rules()]
        return tolerances(rules, listed.distribution or usual, source=name)
    table = read_table(KIND, file, means=lambda heading: _spelt(heading).startswith("tolerance"))
    notes = tuple(f"{name}: {one}" for one in table.dialect.notes)
    return tolerances(list(_rows(table)), usual, source=name, notes=notes)


def _spelt(text: str) -> str:
    """A heading or unit in one spelling: ``Tolerance [mm]`` is ``tolerance_mm``."""
    text = text.strip().lower().replace("°", "deg").replace("µ", "u").replace("μ", "u")
    return re.sub(r"[\s_]*[\[(]?[\s_±]*([\w]+)\s*[\])]", r"_\1", text).replace(" ", "_")


def _rows(table: Table) -> Iterator[Rule]:
    heads = [_spelt(heading) for heading in table.header]
    names = [k for k, head in enumerate(heads) if head in _NAMES]
    sized = {
        k: head.removeprefix("tolerance").strip("_")
        for k, head in enumerate(heads)
        if head.startswith("tolerance")
    }
    units = heads.index("unit") if "unit" in heads else None
    unsaid = [table.header[k] for k, unit in sized.items() if not unit and units is None]
    if not names or not sized or unsaid:
        lacks = "parameter" if not names else "tolerance_mm or tolerance_deg"
        raise BadInput(
            f"{unsaid[0]!r} says no unit" if unsaid else f"no column is called {lacks}",
            where=table.file,
            allowed="parameter, tolerance_mm, tolerance_deg; or parameter, tolerance, unit; "
            "distribution",
            remedy=f"It has {', '.join(map(shown, table.header[:12]))}",
        )
    how = heads.index("distribution") if "distribution" in heads else None
    for number, row in enumerate(table.rows):
        where = table.where(number)
        said = [(k, row[k]) for k in sized if row[k] not in ("", "-")]
        if not said:
            raise BadInput(f"{row[names[0]]} has no tolerance", where=where, allowed="0 for exact")
        seen: set[str] = set()
        for k, cell in said:
            size = finite(re.sub(r"^(±|\+/-|\+-)\s*", "", cell).replace(",", "."))
            written = _spelt(sized[k] or row[units or 0])
            if size is None or written not in _UNIT:
                raise BadInput(
                    f"the tolerance is {shown(cell)}" + ("" if size is None else f" {written}"),
                    where=f"{where}, column {k + 1}",
                    allowed="a number in mm, um, m, deg, rad or mrad",
                )
            unit, factor = _UNIT[written]
            if unit in seen:
                raise BadInput(
                    f"{row[names[0]]} has two tolerances in {unit}", where=where, allowed="one"
                )
            seen.add(unit)
            rule = Rule(
                row[names[0]],
                size * factor,
                "mm" if unit == "mm" else "deg",
                _distribution(row[how], where) if how is not None else None,
                where,
            )
            yield rule


def _distribution(cell: str, where: str) -> Distribution | None:
    """How a row is drawn; None if it doesn't say."""
    text = cell.strip().lower()
    ways: tuple[Distribution, ...] = ("uniform", "normal", "ends")
    for one in ways:
        if text == one:
            return one
    if text:
        try:
            choice("distribution", text, DISTRIBUTIONS)
        except BadInput as error:
            raise BadInput(error.what, where=where, allowed=error.allowed) from None
    return None
