"""Numbers as flags take them: read, held against what is allowed, with their defaults said."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Sequence

from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import MOST, shown


def add_number(
    words: Words,
    flag: str,
    metavar: str | tuple[str, ...],
    help: str,
    *,
    positive: bool = False,
    within: tuple[float, float] | None = None,
    unit: str = "",
    nargs: str | None = None,
    default: float | Sequence[float] | None = None,
    required: bool = False,
) -> None:
    """Add a flag that takes a finite number, or several.

    Args:
        words: Where to add it.
        flag: With its dashes.
        metavar: What help calls the number, as a rule its unit; a name each where it takes several.
        help: What it says, without a default that is a number.
        positive: See :func:`number`.
        within: The same.
        unit: The same.
        nargs: How many it takes, where that is open.
        default: The value, or the values, where it isn't given; help says it.
        required: Whether it has to be given.
    """
    read = number(flag, positive=positive, within=within, unit=unit)
    words.add_argument(
        flag,
        type=read,
        metavar=metavar,
        help=help + _default(default),
        nargs=len(metavar) if isinstance(metavar, tuple) else nargs,
        default=default,
        required=required,
    )


def add_count(
    words: Words,
    flag: str,
    help: str,
    *,
    least: int,
    most: int = MOST,
    default: int | None = None,
    metavar: str = "N",
) -> None:
    """Add a flag that takes a whole number from ``least`` to ``most``; see :func:`add_number`."""
    words.add_argument(
        flag,
        type=count(flag, least, most),
        metavar=metavar,
        help=help + _default(default),
        default=default,
    )


def _default(value: float | Sequence[float] | None) -> str:
    if value is None:
        return ""
    values = value if isinstance(value, Sequence) else [value]
    return f" (default: {' '.join(f'{one:g}' for one in values)})"


def number(
    name: str, *, positive: bool = False, within: tuple[float, float] | None = None, unit: str = ""
) -> Callable[[str], float]:
    """An argparse type: a finite number, optionally positive, or between two bounds.

    Args:
        name: The flag.
        positive: Whether it is above zero.
        within: Least and greatest value.
        unit: What it counts, for messages.
    """
    low, high = within or (-math.inf, math.inf)
    allowed = "a positive number" if positive else "a finite number"
    if within is not None:
        allowed = f"{low:g} to {high:g} {unit}".rstrip()

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and low <= value <= high) or (positive and value <= 0):
            raise argparse.ArgumentTypeError(f"{name} is {shown(text)}; allowed: {allowed}")
        return value

    return read


def count(name: str, least: int, most: int = MOST) -> Callable[[str], int]:
    """An argparse type: a whole number from ``least`` to ``most``."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = least - 1
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(
                f"{name} is {shown(text)}; allowed: a whole number of at least {least}"
                + (f", at most {most}" if value > most else "")
            )
        return value

    return read


_LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "um": 1e-6, "µm": 1e-6}


def length(text: str) -> float:
    """An argparse type: a positive length with its unit, as ``1mm``; in metres."""
    number = text.rstrip("mcuµ ")
    unit = text[len(number) :].strip()
    try:
        value = float(number) * _LENGTHS.get(unit, math.nan)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(
            f"it is {shown(text)}; allowed: a positive length with its unit, 1mm, 0.5 mm or 0.001m"
        )
    return value


def quantity(flag: str, text: str) -> float:
    """A number among the words of a flag.

    Raises:
        BadInput: It is none, or not finite.
    """
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise BadInput(f"{flag} has {shown(text)}", allowed="a finite number")
    return value


def wrench(text: str) -> tuple[str, tuple[float, ...]]:
    """An argparse type: ``FRAME=fx,fy,fz``, three more numbers for a moment."""
    frame, _, values = text.rpartition("=")
    numbers = []
    for value in values.split(","):
        try:
            numbers.append(float(value))
        except ValueError:
            numbers.append(math.nan)
    if not frame or len(numbers) not in (3, 6) or not all(map(math.isfinite, numbers)):
        raise argparse.ArgumentTypeError(
            f"--external is {shown(text)}; allowed: FRAME=fx,fy,fz or FRAME=fx,fy,fz,mx,my,mz [N], "
            "[N·m]"
        )
    return frame, (*numbers, 0.0, 0.0, 0.0)[:6]


def slope(text: str) -> tuple[float, float]:
    """An argparse type: a floor's slope, and the heading in which it rises [°]."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = [math.nan]
    if len(numbers) > 2 or not all(map(math.isfinite, numbers)) or not 0 <= numbers[0] < 89:
        raise argparse.ArgumentTypeError(
            f"--slope is {shown(text)}; allowed: DEG or DEG,HEADING, DEG from 0 to below 89 [°]"
        )
    return numbers[0], (*numbers, 0.0)[1]
