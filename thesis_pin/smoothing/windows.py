"""Windows that slide along samples, mirrored at both ends: ``scipy.ndimage`` without its import."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.numeric.elementwise import blocks

Array = NDArray[np.float64]


def greatest(values: Array, width: int) -> Array:
    """The greatest value of the window around each sample.

    Args:
        values: Shape ``(n,)``, n ≥ 1.
        width: Samples of a window; of an even number one more lies before.

    Returns:
        Shape ``(n,)``.
    """
    found, reach = _mirrored(values, width), 1
    while reach < width:  # windows of twice the width from two that touch or overlap
        step = min(reach, width - reach)
        found, reach = np.maximum(found[:-step], found[step:]), reach + step
    return found


def medians(values: Array, width: int, some: NDArray[np.intp]) -> Array:
    """The median of the window around some samples.

    Args:
        values: Shape ``(n,)``, n ≥ 1.
        width: Samples of a window, an odd number.
        some: Numbers of samples, shape ``(k,)``.

    Returns:
        Shape ``(k,)``.
    """
    windows = np.lib.stride_tricks.sliding_window_view(_mirrored(values, width), width)
    found = np.empty(len(some))
    for part in blocks(len(some)):
        found[part] = np.median(windows[some[part]], axis=1)
    return found


def _mirrored(values: Array, width: int) -> Array:
    return np.pad(values, (width // 2, (width - 1) // 2), mode="symmetric")
