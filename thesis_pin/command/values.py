"""Numbers as flags take them: checked where they are read."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

from thesis_pin.numeric.checks import MOST, shown


def number(name: str, *, positive: bool = False) -> Callable[[str], float]:
    """An argparse type: a finite number, optionally positive."""
    allowed = "a positive number" if positive else "a finite number"

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or (positive and value <= 0):
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
