"""Checks of arguments that aren't arrays; for arrays see :mod:`thesis_pin.numeric.arrays`.

Each returns the argument or raises one error that says what it is, what was
allowed and how to mend it, where Python or NumPy would fail somewhere inside.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Sequence
from numbers import Integral, Real
from typing import Any, TypeVar

from thesis_pin.errors import BadInput, UnknownName

Kind = TypeVar("Kind")


class _Brief(reprlib.Repr):
    """Prints no more of a value than a message could show, however large the value is."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlist = self.maxtuple = self.maxdict = 30
        self.maxstring = self.maxlong = self.maxother = 200


_BRIEF = _Brief()

MOST = 100_000_000
"""Largest number of samples or steps that can be asked for; more is a slip of the pen."""


def choice(kind: str, value: object, known: Sequence[str]) -> str:
    """One of some names.

    Args:
        kind: What the name is of, for messages ("side", "timing").
        value: What was given.
        known: The names that exist.

    Raises:
        UnknownName: It is none of them, or no text at all.
    """
    if not isinstance(value, str) or value not in known:
        raise UnknownName(kind, value, known)
    return value


def instance(name: str, value: object, kind: type[Kind], made_by: str) -> Kind:
    """An object of one of our classes.

    Args:
        name: Name of the argument, for messages.
        value: What was given.
        kind: The class.
        made_by: What makes one, for messages.

    Raises:
        BadInput: It is something else.
    """
    if not isinstance(value, kind):
        raise BadInput(
            f"{name} is {shown(value)}", allowed=f"a {kind.__name__}", remedy=f"{made_by} makes one"
        )
    return value


def real(
    name: str,
    value: object,
    *,
    low: float = -math.inf,
    high: float = math.inf,
    unit: str = "",
    error: type[BadInput] = BadInput,
) -> float:
    """A finite number between two bounds.

    Args:
        name: Name of the argument, for messages.
        value: What was given.
        low: Least value allowed.
        high: Largest value allowed.
        unit: Unit, for messages.
        error: Class of the error.

    Raises:
        BadInput: It isn't one number, isn't finite or lies outside.
    """
    number = _number(value)
    if number is None or not math.isfinite(number) or not low <= number <= high:
        ends = [f"at least {low:g}"] * (low > -math.inf) + [f"at most {high:g}"] * (high < math.inf)
        bounds = f" of {' and '.join(ends)}" if ends else ""
        allowed = f"a finite number{bounds}" + (f" [{unit}]" if unit else "")
        raise error(f"{name} is {shown(value)}", allowed=allowed)
    return number


def whole(name: str, value: object, least: int, *, error: type[BadInput] = BadInput) -> int:
    """A whole number of at least ``least`` and at most :data:`MOST`.

    Raises:
        BadInput: It is no whole number (2.0 isn't one either), too small or too large.
    """
    if (
        isinstance(value, bool)
        or not isinstance(value, Integral)
        or not least <= int(value) <= MOST
    ):
        raise error(
            f"{name} is {shown(value)}",
            allowed=f"a whole number of at least {least}, at most {MOST:,}",
        )
    return int(value)


def function(name: str, value: object, form: str) -> None:
    """Refuse what can't be called.

    Args:
        name: Name of the argument, for messages.
        value: What was given.
        form: How it will be called, for messages.

    Raises:
        BadInput: It can't be called.
    """
    if not callable(value):
        raise BadInput(f"{name} is {shown(value)}", allowed=f"a function, {form}")


def element(index: object, shape: tuple[int, ...], what: str) -> tuple[int, ...]:
    """Which element of a stack, as a tuple of indices that exist.

    Args:
        index: A whole number or a tuple of them; negative ones count from the end.
        shape: Shape of the stack.
        what: What its axes are, for messages ("poses", "poses, then branches").

    Raises:
        BadInput: It doesn't pick one element.
    """
    given = index if isinstance(index, tuple) else (index,)
    if len(given) == len(shape) and all(
        isinstance(k, Integral) and not isinstance(k, bool) and -size <= int(k) < size
        for k, size in zip(given, shape, strict=True)
    ):
        return tuple(int(k) for k in given)
    if not shape:
        raise BadInput(f"index {shown(index)} into a single result", allowed="no index, or ()")
    raise BadInput(
        f"index {shown(index)} doesn't pick one element of a stack of shape {shape} ({what})",
        allowed="a tuple of one whole number an axis"
        if len(shape) > 1
        else f"a whole number from 0 to {shape[0] - 1}",
    )


def shown(value: object) -> str:
    """A value in a few characters, for messages."""
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape:
        return f"an array of shape {shape}"
    if isinstance(value, str | Real | type(None)):
        return brief(value)
    return f"a {type(value).__name__}"


def brief(value: object) -> str:
    """What Python prints of a value, cut after 60 characters."""
    try:
        text = _BRIEF.repr(value)
    except ValueError:  # a whole number of more than 4300 digits
        return f"a {type(value).__name__} too long to print"
    return text if len(text) <= 60 else text[:57] + "..."


def _number(value: Any) -> float | None:
    """One number: a Python one, NumPy's or an array of a single element without axes."""
    if isinstance(value, bool) or getattr(value, "shape", ()) != ():
        return None
    if isinstance(value, Real) or getattr(getattr(value, "dtype", None), "kind", "-") in "iuf":
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            return None
    return None
