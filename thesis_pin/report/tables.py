"""Tables as data: printed by the commands, drawn by the pages."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
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

    @classmethod
    def of(cls, title: str, columns: Mapping[str, Iterable[str]], note: str = "") -> Table:
        """A table of whole columns: heading → cells."""
        return cls(title, list(columns), list(zip(*columns.values(), strict=True)), note)

    def only(self, title: str, columns: Sequence[int]) -> Table:
        """Some of its columns, by number, under another title."""
        rows = [[row[k] for k in columns] for row in self.rows]
        return Table(title, [self.columns[k] for k in columns], rows, self.note, self.prose)


Part: TypeAlias = Table | str
"""What is told to people: a table or a paragraph."""
