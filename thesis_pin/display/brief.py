"""Objects in a line: names, numbers, shapes of arrays; no thousands of numbers, no addresses."""

from __future__ import annotations

import dataclasses
import functools
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # consoles don't need it
    from thesis_pin.display.cell import Cell

ROOM = 200
"""Letters that an object's line may have."""
PART = 60
"""Letters that one of its values may have."""

_PLAIN = (str, int, float, complex, bool, type(None), np.number, np.bool_)


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


def brief(value: object, room: int = PART) -> str:
    """A value in a few letters: arrays by their shapes, objects by class and name.

    Args:
        value: Anything.
        room: Letters it may have; a class's and a shape's are never cut.
    """
    if isinstance(value, np.ndarray) and value.ndim:
        return f"array {'×'.join(map(str, value.shape))}"
    if isinstance(value, np.ndarray | np.generic):
        value = value.item()
    if isinstance(value, float):
        return min(repr(value), f"{value:.6g}", key=len)
    if isinstance(value, str | Path):
        text = str(value)
        return repr(text if len(text) <= room else f"{text[: room - 2]} …")
    if isinstance(value, _PLAIN):
        return repr(value)
    if isinstance(value, tuple | list | dict | set | frozenset):
        if _is_plain(value) and len(text := repr(value)) <= room:
            return text
        return f"{type(value).__name__} of {len(value)}"
    if isinstance(value, functools.partial):
        return brief(value.func, room)
    if callable(value) and not isinstance(value, type):
        return f"function {getattr(value, '__qualname__', type(value).__name__)}"
    if isinstance(value, type):
        return value.__name__
    return named(value, room)


def named(value: object, room: int = PART) -> str:
    """An object's class, and its name if it has one."""
    kind = type(value).__name__
    if isinstance(value, Brief):
        first, name = next(value._shown(), ("", ""))
        return f"{kind} {brief(name, room)}" if first == "name" and name else kind
    text = repr(value)
    short = len(text) <= room and not re.search(r" at 0x|\n", text)
    return text if short and text.startswith(f"{kind}(") else kind


def _is_plain(value: object) -> bool:
    if isinstance(value, dict):
        return all(isinstance(one, _PLAIN) for one in (*value, *value.values()))
    return isinstance(value, tuple | list | set | frozenset) and all(
        isinstance(one, _PLAIN) for one in value
    )


def _length(one: object, parts: list[str]) -> int:
    return len(type(one).__name__) + 2 + sum(len(part) + 2 for part in parts)


def _defaults(one: object) -> dict[str, object]:
    return {field.name: field.default for field in _fields(one)}


def _fields(one: object) -> tuple[dataclasses.Field[object], ...]:
    return dataclasses.fields(one) if dataclasses.is_dataclass(one) else ()


def _alike(value: object, usual: object) -> bool:
    return isinstance(value, (*_PLAIN, tuple)) and type(value) is type(usual) and value == usual
