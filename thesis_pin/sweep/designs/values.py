"""Values as they are written: ``0.3,0.5``, ``0.06:0.09:10``, ``80%:120%:5``, ``@file.csv``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.source import read_any_text
from thesis_pin.sweep.designs.keys import Value

MOST_VALUES = 1_000_000
"""Values that one key may take."""

_DIGITS = 12
"""Of values between two ends: 0.33, not 0.32999999999999996."""

_WHOLE_RANGE = 2  # FROM:TO, which draws take their values from


@dataclass(frozen=True)
class Values(Brief):
    """What a key is to be.

    Attributes:
        each: The values in their order; of a range without a number of steps, its two ends.
        relative: Whether they are shares of what the key is in the file.
        open: Whether ``each`` are the ends of a range that draws take any number of.
    """

    each: tuple[Value, ...]
    relative: bool = False
    open: bool = False

    def at(self, share: float) -> Value:
        """The value at a share of the way through, 0 to below 1."""
        if self.open:
            low, high = (float(end) for end in self.each)
            return low + share * (high - low)
        return self.each[min(int(share * len(self.each)), len(self.each) - 1)]


def read_values(text: str, where: str) -> Values:
    """Values of one key from text.

    Args:
        text: A list with commas, ``FROM:TO:COUNT``, ``FROM:TO``, or ``@FILE`` with one a line;
            numbers with ``%`` are shares of what the key is.
        where: The key, for messages.

    Raises:
        BadInput: It is none of them.
    """
    text = text.strip()
    if text.startswith("@"):
        return listed_values(_lines(text[1:]), where)
    parts = text.split(":")
    if len(parts) > 1:
        return _range(text, parts, where)
    return listed_values(text.split(","), where)


def _lines(file: str) -> list[str]:
    """The values of a file, one a line; what stands behind # isn't one."""
    text, _ = read_any_text("list of values", Path(file), LIMITS.toml_bytes)
    lines = [line.split("#", 1)[0].strip().rstrip(",;") for line in text.split("\n")]
    found = [line for line in lines if line]
    if not found:
        raise BadInput("the list of values is empty", where=file, allowed="one value a line")
    return found


def _range(text: str, parts: list[str], where: str) -> Values:
    relative = {part.strip().endswith("%") for part in parts[:2]}
    ends = [_number(part) for part in parts[:2]]
    count = int(parts[2]) if len(parts) > _WHOLE_RANGE and parts[2].strip().isdecimal() else 0
    good = len(parts) == _WHOLE_RANGE or (len(parts) == _WHOLE_RANGE + 1 and count > 1)
    if not good or None in ends or len(relative) > 1 or count > MOST_VALUES:
        raise BadInput(
            f"{text!r} is no range",
            where=where,
            allowed="FROM:TO:COUNT with a count of at least 2, as 0.06:0.09:10, or 80%:120%:5",
        )
    low, high = (float(end) for end in ends if end is not None)
    if len(parts) == _WHOLE_RANGE:
        return Values((low, high), relative.pop(), open=True)
    between = [float(f"{value:.{_DIGITS}g}") for value in np.linspace(low, high, count)[1:-1]]
    return Values((low, *between, high), relative.pop())


def listed_values(parts: Sequence[str], where: str) -> Values:
    """Values of one key, a word each.

    Args:
        parts: The words.
        where: The key, for messages.

    Raises:
        BadInput: One is empty, or some are shares and some aren't.
    """
    words = [part.strip() for part in parts]
    if not all(words) or len(words) > MOST_VALUES:
        raise BadInput(
            f"{','.join(parts)[:200]!r} has an empty value", where=where, allowed="0.3,0.5,0.8"
        )
    shares = [word.endswith("%") and _number(word) is not None for word in words]
    if any(shares) and not all(shares):
        raise BadInput(
            "some values are shares and some aren't", where=where, allowed="all with %, or none"
        )
    return Values(tuple(read_value(word) for word in words), relative=any(shares))


def read_value(word: str) -> Value:
    """A number where the word is one, true or false, or the word itself without its quotes."""
    number = _number(word)
    if number is not None:
        return number
    if word in ("true", "false"):
        return word == "true"
    if len(word) > 1 and word[0] == word[-1] and word[0] in "\"'":
        return word[1:-1]
    return word


def _number(word: str) -> float | None:
    word = word.strip()
    share = word.endswith("%")
    try:
        value = float(word.removesuffix("%"))
    except ValueError:
        return None
    if not math.isfinite(value):
        return None
    return value / 100 if share else value
