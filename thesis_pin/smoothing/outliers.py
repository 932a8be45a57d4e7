"""Single samples that don't belong to their neighbours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from thesis_pin.smoothing.noise import Array
from thesis_pin.smoothing.windows import medians

_PATTERN = np.array([1.0, -4.0, 6.0, -4.0, 1.0])
_TIMES = 9.0  # what the fourth difference must exceed the usual one by
_ALIKE = 0.8  # how near neighbours must be to the pattern, relative to the error
_QUANTA = 4.0
_AROUND = 25  # samples that say what is usual here


@dataclass(frozen=True)
class Outlier:
    """A sample that is off.

    Attributes:
        sample: Its number.
        error: By how much.
    """

    sample: int
    error: float


def outliers(values: Array, quantum: float, least: float = 0.0) -> list[Outlier]:
    """Samples whose error alone makes the pattern 1, −4, 6, −4, 1 in fourth differences.

    Args:
        values: Samples at about equal steps, shape ``(n,)``.
        quantum: Smallest step that their text resolves.
        least: Errors below this aren't looked for.
    """
    if len(values) < 12:
        return []
    high = np.diff(values, 4)
    size = np.abs(high)
    everywhere = max(1.4826 * float(np.median(size)), float(np.sqrt(70.0 / 12.0)) * quantum)
    large = np.flatnonzero(size > _TIMES * everywhere)
    found: list[Outlier] = []
    for k in large[size[large] > _TIMES * medians(size, _AROUND, large)]:
        error = high[k] / 6.0
        places = np.arange(k - 2, k + 3)
        inside = (places >= 0) & (places < len(high))
        off = np.abs(high[places[inside]] - error * _PATTERN[inside])
        if abs(error) > max(_QUANTA * quantum, least) and (off <= _ALIKE * abs(error)).all():
            found.append(Outlier(int(k) + 2, float(error)))
    return found
