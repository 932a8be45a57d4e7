"""Ranges of values as flags take them: one value, from and to, with a step, or a list."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown

if TYPE_CHECKING:  # help has to be quick
    import numpy as np
    from numpy.typing import NDArray

MOST = 1_000_000
"""Values of a range."""

_DIGITS = 12  # to which values are rounded: 0.3 + 5 · 0.05 is 0.55
_SLACK = 1e-6  # of a step, by which rounding may miss the end


@dataclass(frozen=True)
class Range:
    """What a flag's range says.

    Attributes:
        numbers: One value; from and to; or a list.
        step: Between from and to; None to divide them evenly.
        listed: Whether the numbers are the values themselves.
    """

    numbers: tuple[float, ...]
    step: float | None = None
    listed: bool = False

    def values(self, points: int) -> NDArray[np.float64]:
        """Its values, ascending, shape ``(n,)``.

        Args:
            points: How many, where only from and to are given.
        """
        import numpy as np

        if self.listed or len(self.numbers) == 1:
            return np.array(self.numbers)
        low, high = self.numbers
        if self.step is None:
            return np.round(np.linspace(low, high, points), _DIGITS)
        count = math.floor((high - low) / self.step + _SLACK) + 1
        return np.round(low + self.step * np.arange(count), _DIGITS)


def add_range(words: Words, flag: str, metavar: str, help: str) -> None:
    """Add a flag that takes a :class:`Range`.

    Args:
        words: Where to add it.
        flag: With its dashes.
        metavar: What help calls it.
        help: What it says.
    """
    words.add_argument(flag, type=_range(flag), metavar=metavar, help=help)


def _range(flag: str) -> Callable[[str], Range]:
    def read(text: str) -> Range:
        try:
            return parsed(text)
        except BadInput as error:
            raise argparse.ArgumentTypeError(
                f"{flag} is {shown(text)}; allowed: {error.allowed}"
            ) from None

    return read


def parsed(text: str) -> Range:
    """A range from its text: ``0.4``, ``0.3:0.6``, ``0.3:0.6:0.05`` or ``0.3,0.4,0.6``.

    Raises:
        BadInput: It is none.
    """
    listed = "," in text
    try:
        numbers = tuple(float(part) for part in text.split("," if listed else ":"))
    except ValueError:
        numbers = ()
    if not numbers or not all(map(math.isfinite, numbers)):
        raise BadInput(
            f"{shown(text)} is no range",
            allowed="a finite number, FROM:TO, FROM:TO:STEP, or numbers with commas",
        )
    if listed or len(numbers) == 1:
        if any(b <= a for a, b in pairwise(numbers)):
            raise BadInput(f"{shown(text)} descends", allowed="ascending numbers")
        return Range(numbers, listed=listed)
    low, high, *step = numbers
    if not low < high or len(step) > 1:
        raise BadInput(
            f"{shown(text)} is no range", allowed="FROM:TO or FROM:TO:STEP, FROM below TO"
        )
    if step and not 0.0 < step[0] <= (high - low) * (1.0 + _SLACK):
        raise BadInput(
            f"{shown(text)} has no step",
            allowed="FROM:TO:STEP with a positive STEP of at most TO − FROM (for a number of "
            "values give FROM:TO and --points)",
        )
    if step and (high - low) / step[0] >= MOST:
        raise BadInput(f"{shown(text)} has too many values", allowed=f"at most {MOST:,} values")
    return Range((low, high), step[0] if step else None)
