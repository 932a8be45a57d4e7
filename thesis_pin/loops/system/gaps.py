"""How far loops are open, by loop and in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.system.equations import Equations
from thesis_pin.loops.system.rows import Loop

Array = NDArray[np.float64]


def describe_gap(equations: Equations, gap: Array) -> str:
    """The widest open loop of a configuration, in words."""
    worst, words = -1.0, "by nothing"
    for loop, rows in zip(equations.loops, equations.rows, strict=True):
        metres, radians = split_gap(loop, gap[rows]).tolist()
        if max(metres, radians) > worst:
            worst = max(metres, radians)
            one, two = loop.frames
            words = f"{one!r} and {two!r} are {metres:.2e} m and {radians:.2e} rad apart"
    for number, coupling in enumerate(equations.couplings):
        size = abs(float(gap[equations.size - len(equations.couplings) + number]))
        if size > worst:
            worst, words = size, f"coupling {coupling.name!r} is off by {size:.2e}"
    return words


def split_gap(loop: Loop, gap: Array) -> Array:
    """Distance [m] and angle [rad] of one loop's equations: ``(..., size)`` → ``(..., 2)``."""
    metres = 1 if loop.length is not None else sum(loop.rows[:3])
    squares = gap**2
    parts = squares[..., :metres].sum(axis=-1), squares[..., metres:].sum(axis=-1)
    return np.asarray(np.sqrt(np.stack(parts, axis=-1)))
