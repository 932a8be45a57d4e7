"""Sums and products of numbers and arrays that leave out what is exactly zero or one.

Planned motions are constant in most coordinates. Where a constant stays a float, not an
array, whatever it is multiplied with costs nothing: turning three bodies of a gait takes a fifth
of the time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from thesis_pin.numeric import elementwise

Part: TypeAlias = Any
"""A float, or an array of samples."""

Triple: TypeAlias = Sequence[Part]
"""Three components of a vector."""


def times(a: Part, b: Part) -> Part:
    """a b."""
    if isinstance(a, float):
        if a == 0.0:
            return 0.0
        if a == 1.0:
            return b
    if isinstance(b, float):
        if b == 0.0:
            return 0.0
        if b == 1.0:
            return a
    return a * b


def nothing(*parts: Part) -> bool:
    """Whether all of some numbers are exactly zero."""
    return all(isinstance(part, float) and part == 0.0 for part in parts)


def plus(a: Part, b: Part) -> Part:
    """a + b."""
    if isinstance(a, float) and a == 0.0:
        return b
    return a if isinstance(b, float) and b == 0.0 else a + b


def minus(a: Part, b: Part) -> Part:
    """a − b."""
    if isinstance(b, float) and b == 0.0:
        return a
    return -b if isinstance(a, float) and a == 0.0 else a - b


def cosine_sine(angle: Part) -> tuple[Part, Part]:
    """Cosine and sine of an angle [rad]."""
    if isinstance(angle, float):
        return math.cos(angle), math.sin(angle)
    return elementwise.cosine_sine(angle)


def cross(a: Triple, b: Triple) -> Triple:
    """a × b."""
    return (
        minus(times(a[1], b[2]), times(a[2], b[1])),
        minus(times(a[2], b[0]), times(a[0], b[2])),
        minus(times(a[0], b[1]), times(a[1], b[0])),
    )


def spread(parts: Sequence[Part], shape: tuple[int, ...]) -> np.ndarray:
    """Parts one after the other in one array, each over samples of a shape: ``(parts, ...)``."""
    whole = np.empty((len(parts), *shape))
    if all(isinstance(part, float) for part in parts):
        whole.T[...] = parts
    else:
        for row, part in enumerate(parts):
            whole[row] = part
    return whole
