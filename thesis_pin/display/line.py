"""Values in a few letters: names, numbers, shapes of arrays; never an address."""

from __future__ import annotations

import functools
import re
from pathlib import Path

import numpy as np

PART = 60
"""Letters that a value may have."""

PLAIN = (str, int, float, complex, bool, type(None), np.number, np.bool_)
"""Kinds of values that are told as they are."""


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
    if isinstance(value, PLAIN):
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
    if (shown := getattr(value, "_shown", None)) is not None:  # its class is Brief
        first, name = next(shown(), ("", ""))
        return f"{kind} {brief(name, room)}" if first == "name" and name else kind
    text = repr(value)
    short = len(text) <= room and not re.search(r" at 0x|\n", text)
    return text if short and text.startswith(f"{kind}(") else kind


def _is_plain(value: object) -> bool:
    if isinstance(value, dict):
        return all(isinstance(one, PLAIN) for one in (*value, *value.values()))
    return isinstance(value, tuple | list | set | frozenset) and all(
        isinstance(one, PLAIN) for one in value
    )
