"""Tables as data: printed by the commands, drawn by the pages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True)
class Table:
    """A table; the first column is text, the others are numbers unless ``prose``."""

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""
    prose: bool = False


Part: TypeAlias = Table | str
"""What is told to people: a table or a paragraph."""
