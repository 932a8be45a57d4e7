"""Objects in a line: names, numbers, shapes of arrays; no thousands of numbers, no addresses."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import TYPE_CHECKING

from thesis_pin.display.line import PLAIN, brief

if TYPE_CHECKING:  # consoles don't need it
    from thesis_pin.display.cell import Cell

ROOM = 200
"""Letters that an object's line may have."""


class Brief:
    """Shows itself in a line of at most :data:`ROOM` letters, and as a short table in notebooks.

    What counts are the fields of a dataclass; other classes override :meth:`_shown`, and those with
    an answer :meth:`_cell`.
    """

    __slots__ = ()

    def __init_subclass__(cls, **options: object) -> None:
        """Keep ``@dataclass`` from writing a ``__repr__`` of its own: it does if there is none."""
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):
            type.__setattr__(cls, "__repr__", Brief.__repr__)

    def __repr__(self) -> str:
        """Its class and values; what is the default first gives way where they are too many."""
        shown = list(self._shown())
        parts = [f"{name}={brief(value)}" for name, value in shown]
        if _length(self, parts) > ROOM:
            usual = _defaults(self)
            parts = [
                part
                for part, (name, value) in zip(parts, shown, strict=True)
                if name not in usual or not _alike(value, usual[name])
            ]
        while _length(self, parts) > ROOM:
            parts = [*parts[: -2 if parts[-1] == "…" else -1], "…"]
        return f"{type(self).__name__}({', '.join(parts)})"

    def _repr_html_(self) -> str:
        from thesis_pin.display.cell import html

        return html(self._cell())

    def _shown(self) -> Iterator[tuple[str, object]]:
        """Names and values that count."""
        for field in _fields(self):
            if field.repr:
                yield field.name, getattr(self, field.name)

    def _cell(self) -> Cell:
        """What a notebook shows."""
        from thesis_pin.display.cell import values_cell

        return values_cell(self, self._shown())


def _length(one: object, parts: list[str]) -> int:
    return len(type(one).__name__) + 2 + sum(len(part) + 2 for part in parts)


def _defaults(one: object) -> dict[str, object]:
    return {field.name: field.default for field in _fields(one)}


def _fields(one: object) -> tuple[dataclasses.Field[object], ...]:
    return dataclasses.fields(one) if dataclasses.is_dataclass(one) else ()


def _alike(value: object, usual: object) -> bool:
    return isinstance(value, (*PLAIN, tuple)) and type(value) is type(usual) and value == usual
