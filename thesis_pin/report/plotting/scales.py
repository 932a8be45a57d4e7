"""Axes of plots: which range they show, and the round values that are marked on them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

MARGIN = 0.05
"""Of the range, left free beyond either end."""

MOST = 9
"""Steps between the marked values, at most."""

_SAME = 1e-12
"""Of values: what they differ by is roundings."""

_NOTHING = 1e-300
"""A size that leaves no room for parts of it."""

_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
_ROUND = 1e-6  # of a step: so near to whole digits it has them
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_LARGE, _SMALL = 6, -5
"""Powers of ten from which on a factor beside the axis spares the labels their zeros."""

_FAR = 1e5
"""Steps from zero on which what labels have in common stands beside the axis, once."""

_PLAIN = 15
"""Digits before the point of what is said without a power of ten, at most."""


@dataclass(frozen=True)
class Ticks:
    """Marked values of an axis.

    Attributes:
        values: Ascending.
        labels: What stands beside each.
        factor: By what all labels are to be multiplied, and what then is to be added to them;
            empty for nothing.
    """

    values: tuple[float, ...]
    labels: tuple[str, ...]
    factor: str = ""


def shown(values: Iterable[NDArray[np.float64] | float]) -> tuple[float, float]:
    """The range of an axis that shows some values, with a margin; NaN and infinity are none.

    Args:
        values: Arrays and single values, the former of any length.
    """
    low, high = math.inf, -math.inf
    for value in values:
        some = np.atleast_1d(value)
        some = some[np.isfinite(some)]
        if some.size:
            low, high = min(low, float(some.min())), max(high, float(some.max()))
    if not low <= high:
        low, high = 0.0, 1.0
    size = max(abs(low), abs(high))
    if high - low <= max(_SAME * size, _NOTHING):  # values that are all the same
        around = MARGIN * (size if size > _NOTHING else 1.0)
        low, high = low - around, high + around
    margin = MARGIN * (high - low)
    return low - margin, high + margin


def ticks(low: float, high: float, most: int) -> Ticks:
    """Round values of a range.

    Args:
        low: Where it begins.
        high: Where it ends.
        most: Steps between them, at most.
    """
    from matplotlib.ticker import MaxNLocator

    found = MaxNLocator(max(1, min(most, MOST)), steps=_STEPS).tick_values(low, high)
    step = float(found[1] - found[0]) if len(found) > 1 else high - low
    slack = 1e-9 * (high - low)
    values = [float(v) for v in found if low - slack <= v <= high + slack]
    base, added = _base(values, step)
    beside = [v - base for v in values]
    size = max((abs(v) for v in beside), default=0.0)
    power = math.floor(math.log10(size)) if size else 0
    power = power if power >= _LARGE or power <= _SMALL else 0
    digits = _digits(step / 10.0**power)
    labels = (f"{v / 10.0**power + 0.0:z.{digits}f}".replace("-", "−") for v in beside)
    return Ticks(tuple(values), tuple(labels), f"{_ten(power)} {added}".strip())


def _base(values: Sequence[float], step: float) -> tuple[float, str]:
    """What values far from zero have in common, a round number, and how it is written."""
    size = max((abs(v) for v in values), default=0.0)
    if size < _FAR * step:
        return 0.0, ""
    least = math.ceil(math.log10(step) - _ROUND) + 1  # the power of ten of its last digit
    first, last = (value / 10.0**least for value in (values[0], values[-1]))
    above = math.ceil(first - _ROUND)
    units = above if above <= last else math.floor(first)
    if not units:
        return 0.0, ""
    power = math.floor(math.log10(size))
    power = 0 if _SMALL < power < _PLAIN else power
    digits = max(0, power - least)
    said = f"{abs(units) * 10.0 ** (least - power):.{digits}f}"
    said = said.rstrip("0").rstrip(".") if digits else said
    return units * 10.0**least, f"{'−' if units < 0 else '+'}{said}{_ten(power)}"


def _ten(power: int) -> str:
    return f"×10{str(power).translate(_SUPERSCRIPT)}" if power else ""


def _digits(step: float) -> int:
    """How many digits behind the point tell multiples of a round step apart, and say them."""
    digits = max(0, -math.floor(math.log10(step) + 1e-9))  # of 0.99…, which is 1, none
    whole = step * 10.0**digits
    return digits if abs(whole - round(whole)) < _ROUND * whole else digits + 1  # 2.5
