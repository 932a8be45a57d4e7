"""Data that plainly fit a schema, told without pydantic.

Most files are right. What fits the annotations word for word needs none of pydantic's messages,
whose import takes half as long as Pinocchio's; where there is any doubt, pydantic decides.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from math import isfinite
from types import NoneType, UnionType
from typing import Annotated, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from thesis_pin.model.strict import After, Held, Strict

Kind = TypeVar("Kind", bound=Strict)


class Doubt(Exception):
    """Data don't plainly fit; nothing is said of whether they do."""


def plainly(schema: type[Kind], data: object) -> Kind:
    """The object that data stand for.

    Args:
        schema: Its class.
        data: Nested dicts with tuples for lists, as :func:`thesis_pin.model.limits.bounded`
            gives them.

    Raises:
        Doubt: It takes pydantic to say whether they do.
    """
    if type(data) is not dict:
        raise Doubt
    hints, left = _hints(schema), dict(data)
    values = {name: _fitted(hints[name], left.pop(name)) for name in hints if name in left}
    if left:
        raise Doubt  # unknown keys
    for name in hints.keys() - values.keys():
        default = getattr(schema, name, _ABSENT)
        if default is _ABSENT or hasattr(default, "default_factory"):
            raise Doubt
    return schema.made(**values)


_ABSENT = object()
_HINTS: dict[type[Strict], Mapping[str, object]] = {}


def _hints(schema: type[Strict]) -> Mapping[str, object]:
    """The annotations of a class's fields, names resolved."""
    if schema not in _HINTS:
        found = get_type_hints(schema, include_extras=True)
        _HINTS[schema] = {name: found[name] for name in schema.field_names()}
    return _HINTS[schema]


def _fitted(hint: object, value: object) -> object:
    if hint is float:
        return _float(value)
    if hint in (str, int, bool, NoneType):
        if type(value) is hint:
            return value
        raise Doubt
    if isinstance(hint, type) and issubclass(hint, Strict):
        return plainly(hint, value)
    kind, parts = get_origin(hint), get_args(hint)
    if kind in _READERS:
        return _READERS[kind](parts, value)
    raise Doubt


def _float(value: object) -> float:
    if type(value) is int and abs(value) < 2**53:
        return float(value)
    if type(value) is float and isfinite(value):
        return value
    raise Doubt


def _annotated(parts: tuple[object, ...], value: object) -> object:
    found = _fitted(parts[0], value)
    for mark in parts[1:]:
        if isinstance(mark, After):
            try:
                found = mark.check(found)
            except ValueError:
                raise Doubt from None
        elif not isinstance(mark, Held) or not all(
            name in _BOUNDS and _BOUNDS[name](found, bound) for name, bound in mark.bounds.items()
        ):
            raise Doubt
    return found


def _matches(value: str, pattern: str) -> bool:
    # Where Python's and pydantic's expressions can't differ.
    return value.isascii() and value.isprintable() and re.search(pattern, value) is not None


_BOUNDS: dict[str, Callable[..., bool]] = {
    "gt": lambda value, bound: value > bound,
    "ge": lambda value, bound: value >= bound,
    "min_length": lambda value, bound: len(value) >= bound,
    "max_length": lambda value, bound: len(value) <= bound,
    "pattern": _matches,
}


def _literal(parts: tuple[object, ...], value: object) -> object:
    if any(type(value) is type(part) and value == part for part in parts):
        return value
    raise Doubt


def _one_of(parts: tuple[object, ...], value: object) -> object:
    found = []
    for part in parts:
        try:
            found.append(_fitted(part, value))
        except Doubt:
            continue
    if len(found) != 1:
        raise Doubt
    return found[0]


def _tuple(parts: tuple[object, ...], value: object) -> object:
    if type(value) is not tuple:
        raise Doubt
    if len(parts) == 2 and parts[1] is ...:
        parts = (parts[0],) * len(value)
    if len(parts) != len(value):
        raise Doubt
    return tuple(_fitted(part, one) for part, one in zip(parts, value, strict=True))


def _dict(parts: tuple[object, ...], value: object) -> object:
    if type(value) is not dict:
        raise Doubt
    return {_fitted(parts[0], key): _fitted(parts[1], one) for key, one in value.items()}


_READERS: dict[object, Callable[[tuple[object, ...], object], object]] = {
    Annotated: _annotated,
    Literal: _literal,
    Union: _one_of,
    UnionType: _one_of,
    tuple: _tuple,
    dict: _dict,
}
"""How what an annotation is made of is read."""
