"""Nested data as TOML that reads back to the last bit."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_WIDE = 96


def toml(data: Mapping[str, object], notes: Sequence[str] = ()) -> str:
    """Data as TOML; what is None is left out.

    Args:
        data: Nested mappings and lists of numbers, texts and truths.
        notes: What stands at its top as comments.

    Raises:
        BadInput: Something in it has no form in TOML.
    """
    lines = [f"# {line}" for note in notes for line in _wrapped(note)]
    return "\n".join([*lines, *[""] * bool(lines), *_table(data, ())]) + "\n"


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap("".join(c if c.isprintable() else " " for c in text), _WIDE) or [""]


def _table(data: Mapping[str, object], path: tuple[str, ...]) -> Iterator[str]:
    """Lines of a table: its values, then its tables."""
    inner = {key: value for key, value in data.items() if _is_table(value) or _are_tables(value)}
    for key, value in data.items():
        if key not in inner and value is not None:
            yield f"{_name(key)} = {_value(value)}"
    for key, value in inner.items():
        here = (*path, _name(key))
        for one in [value] if isinstance(value, Mapping) else value:  # type: ignore[attr-defined]
            yield ""
            yield f"[{'.'.join(here)}]" if one is value else f"[[{'.'.join(here)}]]"
            yield from _table(one, here)


def _is_table(value: object) -> bool:
    return isinstance(value, Mapping)


def _are_tables(value: object) -> bool:
    return isinstance(value, list | tuple) and bool(value) and all(map(_is_table, value))


def _value(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, Mapping):
        inside = (f"{_name(key)} = {_value(one)}" for key, one in value.items() if one is not None)
        return f"{{{', '.join(inside)}}}"
    raise BadInput(f"{shown(value)} has no form in TOML")


def _name(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _text(value: str) -> str:
    """A basic string; JSON's escapes are TOML's."""
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
