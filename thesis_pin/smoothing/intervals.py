"""From a number's values on all variants of a motion to the interval it lies in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SPREAD = 3.0
"""Standard deviations of 16 draws on either side; their own error of 18 % included."""


@dataclass(frozen=True)
class Interval:
    """A number with the interval that the samples leave it.

    Attributes:
        value: By the curve itself.
        low, high: Between these.
    """

    value: float
    low: float
    high: float

    @property
    def half_width(self) -> float:
        """Half of the interval."""
        return (self.high - self.low) / 2.0

    def side(self, limit: float) -> int:
        """1 if all of it is above a limit, −1 if below, 0 if it straddles."""
        return int(self.low > limit) - int(self.high < limit)


def least_value(
    value: float,
    rival: float,
    draws: Array,
    shortest: float | None = None,
    longest: float | None = None,
    *,
    slack: float = 0.0,
) -> Interval:
    """Interval of the least value over a motion, such as a margin.

    The least value of a noisy curve is lower than that of the true one, hence the part that
    goes by the draws' mean.

    Args:
        value: Of order 4's curve.
        rival: Of order 3's.
        draws: Of the draws, ``(draws,)``.
        shortest: Of order 4's with contacts as short as the samples allow.
        longest: Of order 4's where it holds for all contacts that the samples allow.
        slack: What rounding of the rest may do.
    """
    wide = _open(value, rival, draws) + max(0.0, value - _middle(value, draws))
    lower = min(value if shortest is None else shortest, value - abs(rival - value))
    upper = max(value, value if longest is None else longest)
    return Interval(value, lower - wide - slack, upper + abs(rival - value) + wide + slack)


def largest_value(
    value: float,
    rival: float,
    draws: Array,
    least: float | None = None,
    most: float | None = None,
    *,
    slack: float = 0.0,
) -> Interval:
    """Interval of the largest value over a motion, such as a peak torque.

    Args:
        value: Of order 4's curve.
        rival: Of order 3's.
        draws: Of the draws, ``(draws,)``.
        least: Of order 4's where it holds for all contacts that the samples allow.
        most: The largest of order 4's over all contacts that the samples allow, and
            with friction that nobody knows.
        slack: What rounding of the rest may do, relative.
    """
    wide = _open(value, rival, draws) + max(0.0, _middle(value, draws) - value)
    lower = min(value if least is None else least, value - abs(rival - value))
    upper = max(value, value if most is None else most)
    wide += slack * abs(value)
    return Interval(value, max(lower - wide, 0.0), upper + abs(rival - value) + wide)


def _open(value: float, rival: float, draws: Array) -> float:
    return SPREAD * float(np.std(draws, ddof=1)) if len(draws) > 1 else abs(value - rival)


def _middle(value: float, draws: Array) -> float:
    """Mean of the draws; the value itself if none could be worked out."""
    return float(np.mean(draws)) if len(draws) else value
