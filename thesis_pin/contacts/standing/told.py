"""Who bears load when, as columns of a motion's table say."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.tables.meaning import Meaning, chosen
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.units import PLAIN

Flags = NDArray[np.bool_]


def headings_of(names: Sequence[str]) -> list[str]:
    """What columns of feet's contacts are called: ``contact_NAME`` or ``NAME_contact``."""
    return [heading for name in names for heading in (f"contact_{name}", f"{name}_contact")]


def told_contacts(file: str | Path, names: Sequence[str]) -> Flags | None:
    """Which feet bear load at each row of a table, booleans ``(n, feet)``.

    Args:
        file: The motion's table.
        names: Of the feet.

    Returns:
        None if no column says it.

    Raises:
        BadInput: Some feet have a column and others haven't, or a cell is neither 0 nor 1, and
            some cell of its column neither ``true`` nor ``false``.
    """
    table = read_table("motion", file)
    known = {
        heading: [Meaning(name, PLAIN[0], f"contact of {name}")]
        for name in names
        for heading in headings_of([name])
    }
    columns, _ = chosen(table, known, headings_of(names), lenient=True)
    if not columns:
        return None
    if missing := [name for name in names if name not in columns]:
        raise BadInput(
            f"some feet have a column of contacts, and {', '.join(missing)} none",
            where=table.file,
            allowed="a column for each foot, or for none",
            remedy=f"Add contact_{missing[0]}",
        )
    found = np.zeros((len(table), len(names)), dtype=bool)
    for k, name in enumerate(names):
        words = [text.casefold() for text in table.texts(columns[name][0])]
        if set(words) <= {"true", "false"}:
            found[:, k] = [word == "true" for word in words]
            continue
        values = table.column(*columns[name], f"contact_{name}").values
        odd = ~np.isin(values, (0.0, 1.0))
        if odd.any():
            row = int(np.argmax(odd))
            raise BadInput(
                f"contact of {name} is {values[row]:g}", where=table.where(row), allowed="0 or 1"
            )
        found[:, k] = values > 0
    return found
