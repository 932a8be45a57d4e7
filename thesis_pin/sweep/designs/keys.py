"""Keys of nested data: written with dots and stars, found, read and set."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from typing import TypeAlias

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.model.limits import Key

Value: TypeAlias = float | int | str | bool
"""What a key may be set to."""

MOST_KEYS = 10_000
"""Keys that one pattern may stand for."""

_PART = re.compile(r"""(?:"([^"]*)"|'([^']*)'|([^.\s"']+))\s*(?:\.\s*|$)""")


def split(pattern: str) -> tuple[str, ...]:
    """Parts of a dotted key, which may be in quotes: ``servos."a.b".size`` has three.

    Raises:
        BadInput: It isn't one.
    """
    text, parts, at = pattern.strip(), [], 0
    while at < len(text):
        match = _PART.match(text, at)
        if match is None:
            break
        parts.append(next(part for part in match.groups() if part is not None))
        at = match.end()
    if at < len(text) or not parts or text.endswith("."):
        raise BadInput(
            f"{pattern!r} is no key",
            allowed="names and numbers with dots, as legs.left.x_3; values are in its unit, "
            "which isn't named",
        )
    return tuple(parts)


def matching(data: object, pattern: str) -> list[Key]:
    """Keys of single values that a pattern stands for; ``*`` and ``?`` are wild within a part.

    Args:
        data: Nested mappings and lists.
        pattern: Dotted; parts of lists are their numbers, from 0.

    Raises:
        UnknownName: There is none; lists those that resemble it.
        BadInput: It stands for tables or lists, or for too many keys.
    """
    parts = split(pattern)
    found = list(_found(data, parts, ()))
    if not found:
        every = [dotted(key) for key in leaves(data)]
        raise UnknownName(
            "key", pattern, _nearest(pattern, every), remedy="* stands for any part of a key"
        )
    if inner := [key for key in found if isinstance(value_at(data, key), Mapping | list | tuple)]:
        below = [dotted(key) for key in leaves(value_at(data, inner[0]))]
        raise BadInput(
            f"{dotted(inner[0])} is no single value",
            where=pattern,
            allowed=", ".join(f"{pattern}.{one}" for one in below[:8]) or "a key with a value",
        )
    if len(found) > MOST_KEYS:
        raise BadInput(f"{pattern!r} stands for {len(found):,} keys", allowed=f"{MOST_KEYS:,}")
    return found


def _found(data: object, parts: Sequence[str], before: Key) -> Iterator[Key]:
    if not parts:
        yield before
        return
    for name, one in _items(data):
        if fnmatchcase(str(name), parts[0]):
            yield from _found(one, parts[1:], (*before, name))


def _items(data: object) -> Iterator[tuple[str | int, object]]:
    if isinstance(data, Mapping):
        yield from ((str(name), one) for name, one in data.items())
    elif isinstance(data, list | tuple):
        yield from enumerate(data)


def leaves(data: object, before: Key = ()) -> Iterator[Key]:
    """Keys of all single values."""
    if not isinstance(data, Mapping | list | tuple):
        yield before
    for name, one in _items(data):
        yield from leaves(one, (*before, name))


def value_at(data: object, key: Key) -> object:
    """What stands at a key."""
    for part in key:
        data = data[part]  # type: ignore[index]
    return data


def changed(data: object, values: Mapping[Key, Value]) -> object:
    """The same data with other values; what doesn't change is shared."""
    for key, value in values.items():
        data = _set(data, key, value)
    return data


def _set(data: object, key: Key, value: Value) -> object:
    if not key:
        return value
    inner = _set(data[key[0]], key[1:], value)  # type: ignore[index]
    if isinstance(data, Mapping):
        return {**data, key[0]: inner}
    assert isinstance(data, list | tuple)
    return [inner if k == key[0] else one for k, one in enumerate(data)]


def dotted(key: Key) -> str:
    """A key as it is written; names with dots or stars in quotes."""
    return ".".join(
        f'"{part}"' if isinstance(part, str) and re.search(r"[.*?\[\]\s'=,]", part) else str(part)
        for part in key
    )


def _nearest(pattern: str, every: Sequence[str]) -> list[str]:
    """Keys from the one most like a pattern on; of numbered ones the first stands for all."""
    from difflib import SequenceMatcher

    last = pattern.rsplit(".", 1)[-1]
    single = list(dict.fromkeys(re.sub(r"\.\d+(?=\.|$)", ".*", one) for one in every))

    def likeness(one: str) -> float:
        whole = SequenceMatcher(None, pattern, one).ratio()
        return whole + SequenceMatcher(None, last, one.rsplit(".", 1)[-1]).ratio()

    return sorted(single, key=likeness, reverse=True)[:8]
