"""What a column of a table resolves, from how it is written and what it holds."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LINES = 2_000
"""Lines that are looked at for the number of digits."""

_LARGEST = 5
"""Largest values that have to agree before their digits count rather than all cells'."""

_STEPS = 4
"""Steps between values that show a counter: a column with one bad sample has only one."""


def quantum(cells: Sequence[str], values: Array) -> float:
    """Smallest step that a column's samples resolve, in the unit they are written in.

    The last digit that its largest values are written to: a program that writes six
    significant digits gives small values more decimals, which say nothing of the others. Or
    the step of a counter: the least difference of its values, if all differences are
    multiples of it and neighbours often share a value. Never less than what a double resolves.

    Args:
        cells: The samples as written, with decimal points.
        values: The same as numbers, shape ``(n,)``.

    Returns:
        The step; 0.0 where a value that never changes says nothing of it, as 0, 0.0 or 0.03
        do and 0.030 doesn't, or where there is no row.
    """
    if not cells:
        return 0.0
    every = max(1, len(cells) // _LINES)
    looked, sizes = cells[::every], np.abs(values[::every])
    places = np.array([Decimal(cell).as_tuple().exponent for cell in looked], dtype=int)
    large = (sizes > 0) & (10 * sizes >= sizes.max(initial=0.0))
    fewest = (places[large] if large.sum() >= _LARGEST else places).min(initial=0)
    finest = float(np.spacing(np.abs(values).max(initial=0.0)))
    digit = max(float(f"1e{fewest}"), finest)
    if not np.ptp(values) > 0:
        fixed = places.min(initial=0) < -1 and all(cell.endswith("0") for cell in looked)
        return digit if fixed else 0.0
    steps = np.diff(np.unique(values))
    if len(steps) < _STEPS or not (np.diff(values) == 0).any():
        return digit
    least = float(steps.min())
    multiples = steps / least
    if multiples.max() < 1e6 and (np.abs(multiples - np.round(multiples)) < 1e-2).all():
        return max(digit, least)
    return digit
