"""Lists of servos and motors as people have them → actuators.

A table (CSV in whatever dialect) with a row a servo, a TOML file with a table
``[servos.NAME]`` each, or parameter files of :mod:`thesis_pin.sizing.bam`. Columns and keys say
their units (:mod:`thesis_pin.sizing.units`); others are carried along.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from pydantic import Field

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.source import read_text
from thesis_pin.model.specification import Strict, read_toml
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.bam import read_identified
from thesis_pin.sizing.cells import Cell
from thesis_pin.sizing.rows import actuators_of, lacking, meanings_of, named, unsaid
from thesis_pin.sizing.units import understood
from thesis_pin.tables.reading import read_table

KIND = "list of servos"


class ServoList(Strict):
    """A list in TOML: a table a servo, its keys as the columns of a table."""

    format: Literal[1] = 1
    servos: dict[str, dict[str, Cell]] = Field(default_factory=dict)
    motors: dict[str, dict[str, Cell]] = Field(default_factory=dict)


@dataclass(frozen=True)
class Catalogue(Brief):
    """Actuators to choose from.

    Attributes:
        actuators: In the order of their files and rows.
        notes: What was taken for granted, and what was left out.
    """

    actuators: tuple[Actuator, ...]
    notes: tuple[str, ...] = ()


def read_catalogue(
    files: str | Path | Sequence[str | Path], *, voltage: float | None = None
) -> Catalogue:
    """Read lists of servos.

    Args:
        files: One or several; see the head of this module.
        voltage: Take those that are for it [V], or for none in particular; None takes all.

    Raises:
        BadInput: A file can't be read, has no stall torque or speed, or a cell is no number.
        SpecificationError: A TOML file has other keys.
    """
    paths = [files] if isinstance(files, str | Path) else list(files)
    found: list[Actuator] = []
    notes: list[str] = []
    for path in paths:
        some, said = _read(path, voltage)
        found += some
        notes += said
    kept = [one for one in found if None in (voltage, one.voltage) or one.voltage == voltage]
    if len(kept) > LIMITS.entries:
        raise BadInput(
            f"there are {len(kept):,} servos",
            where=", ".join(map(str, paths)),
            allowed=f"at most {LIMITS.entries:,}",
        )
    if len(kept) < len(found):
        notes.append(f"{len(found) - len(kept)} are left out: they are for another voltage")
    if not kept:
        volts = sorted({one.voltage for one in found if one.voltage is not None})
        raise BadInput(
            "there is no servo" + (f" for {voltage:g} V" if found and voltage else ""),
            where=", ".join(map(str, paths)),
            allowed="one of " + ", ".join(f"{one:g} V" for one in volts) if volts else "",
        )
    return Catalogue(tuple(_apart(kept)), tuple(dict.fromkeys(notes)))


def _read(path: str | Path, voltage: float | None) -> tuple[list[Actuator], list[str]]:
    where = str(path)
    if where.lower().endswith(".toml"):
        listed = read_toml(KIND, ServoList, path)
        tables = [*listed.servos.items(), *listed.motors.items()]
        found: list[Actuator] = []
        notes: list[str] = []
        for name, entry in tables:
            here = f"{where}: {name}"
            entry = {**entry, "name": name}
            meanings = meanings_of(list(entry), [entry], here)
            notes += unsaid(meanings, [entry], where)
            if lacks := lacking(entry, meanings):
                raise BadInput(f"it has no {lacks}", where=here)
            found += actuators_of(entry, meanings, here)
        return found, notes
    if where.lower().endswith(".json"):
        return [read_identified(read_text(KIND, path), where, voltage)], []
    table = read_table(KIND, path, means=understood)
    table.refuse_repeats(understood)
    cells = [dict(zip(table.header, row, strict=True)) for row in table.rows]
    meanings = meanings_of(table.header, cells, where)
    comma = table.dialect.decimal == ","
    rows: list[dict[str, Cell]] = [
        {key: _pointed(one) if comma and key in meanings else one for key, one in row.items()}
        for row in cells
    ]
    notes = [f"{where}: {one}" for one in table.dialect.notes] + unsaid(meanings, rows, where)
    found = []
    left_out = []
    for number, row in enumerate(rows):
        here = table.where(number)
        if lacks := lacking(row, meanings):
            left_out.append(f"{here}: {named(row, meanings)}: it has no {lacks}")
        found += actuators_of(row, meanings, here)
    if left_out and not found:
        raise BadInput(left_out[0])
    return found, [*notes, *(f"{one}, and is left out" for one in left_out)]


def _pointed(cell: str) -> str:
    """A cell with a decimal point where its number has a comma; words stay as they are."""
    return re.sub(r"^([-+]?\d*),(\d+)(?![\d,.])", r"\1.\2", cell)


def _apart(actuators: Sequence[Actuator]) -> Iterator[Actuator]:
    """The same with names that differ: by their voltage, or by where they stand."""
    count = Counter(one.name for one in actuators)
    volts = Counter((one.name, one.voltage) for one in actuators)
    for one in actuators:
        if count[one.name] == 1:
            yield one
        elif one.voltage is not None and volts[one.name, one.voltage] == 1:
            yield replace(one, name=f"{one.name} at {one.voltage:g} V")
        else:
            raise BadInput(
                f"{one.name!r} is listed {count[one.name]} times",
                where=one.where,
                allowed="each servo once for each voltage",
            )
