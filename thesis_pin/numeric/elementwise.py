"""One formula for single numbers and for arrays.

NumPy takes about a microsecond to begin anything, so for a few poses Python's
floats are several times faster. Code that is handed one of :data:`FLOATS` and
:data:`ARRAYS` works on either.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

FEW = 16
"""Below this many poses floats beat arrays."""

BLOCK = 4096
"""Samples whose intermediates stay in a core's cache."""

LONG = 16 * BLOCK
"""Samples from which what can be worked out again isn't kept: memory counts, not speed."""

# Freed once, eight megabytes make glibc keep that much for the next block of samples; otherwise it
# returns what exceeds 128 kB and gets it back page by page, a third of the time along a motion.
np.empty(2**20)

Number: TypeAlias = float | np.ndarray
"""One number, or an array of them."""

Numbers: TypeAlias = Sequence[Number] | np.ndarray
"""Several of them, for instance the entries of a pose."""

Truth: TypeAlias = bool | np.ndarray
"""One condition, or an array of them."""

Samples: TypeAlias = slice | np.ndarray
"""Some samples of a motion: consecutive ones, indices, or a mask."""


@dataclass(frozen=True, slots=True)
class Elementwise:
    """The functions a closed form needs, for floats or for arrays.

    Attributes:
        cosine_sine: Cosine and sine of an angle.
        sqrt, acos, atan2: As usual.
        clipped: What ought to be a cosine, brought into ±1.
        where: ``where(condition, yes, no)``.
        some: Whether a condition holds for at least one element.
    """

    cosine_sine: Callable[[Number], tuple[Number, Number]]
    sqrt: Callable[[Number], Number]
    acos: Callable[[Number], Number]
    atan2: Callable[[Number, Number], Number]
    where: Callable[[Truth, Number, Number], Number]
    some: Callable[[Truth], bool]
    clipped: Callable[[Number], Number]

    def larger(self, one: Number, other: Number) -> Number:
        """The larger of two."""
        return self.where(one > other, one, other)


def _pick(condition: bool, yes: float, no: float) -> float:
    return yes if condition else no


def _clipped(cosine: float) -> float:
    return 1.0 if cosine > 1.0 else -1.0 if cosine < -1.0 else cosine


def _clipped_all(cosine: np.ndarray) -> np.ndarray:
    return np.asarray(np.minimum(np.maximum(cosine, -1.0), 1.0))


def _cosine_sine(angle: float) -> tuple[float, float]:
    return math.cos(angle), math.sin(angle)


def cosine_sine(angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cosine and sine of angles [rad], shape ``(...)`` each, to 4e-16."""
    # From t = tan(angle / 2): a sixth of the time of NumPy's cosine and sine with AVX-512, whose
    # loops have a tangent only; two thirds without.
    sine = np.tan(0.5 * angle)
    more = sine * sine
    more += 1.0
    more = 2.0 / more  # 2 / (1 + t²) = 1 + cosine
    sine *= more
    more -= 1.0
    return more, sine


# Each of the two takes its own kind only, which their common type can't say.
FLOATS = Elementwise(_cosine_sine, math.sqrt, math.acos, math.atan2, _pick, bool, _clipped)  # type: ignore[arg-type]
_OF_ARRAYS = cosine_sine, np.sqrt, np.arccos, np.arctan2, np.where, np.any, _clipped_all
ARRAYS = Elementwise(*_OF_ARRAYS)  # type: ignore[arg-type]


def blocks(count: int, size: int = BLOCK) -> list[slice]:
    """Slices of at most ``size`` samples that cover ``count``."""
    return [slice(start, min(start + size, count)) for start in range(0, count, size)]


def intervals(count: int, size: int = BLOCK) -> list[slice]:
    """Slices whose neighbours share a sample: each step between two samples lies in one."""
    return [slice(part.start, part.stop + 1) for part in blocks(max(count - 1, 1), size)]


def pieces(count: int) -> list[tuple[Elementwise, int, Samples | int]]:
    """A few samples one by one, as floats; many in blocks: functions, first sample, samples."""
    if count < FEW:
        return [(FLOATS, k, k) for k in range(count)]
    return [(ARRAYS, part.start, part) for part in blocks(count)]


def components(stack: np.ndarray, piece: Samples | int) -> Numbers:
    """A piece of a stack ``(n, k)``, component by component: k floats, or rows ``(k, m)``."""
    part = stack[piece]
    return part.tolist() if part.ndim == 1 else np.ascontiguousarray(part.T)


def put(stack: np.ndarray, piece: Samples | int, numbers: Numbers) -> None:
    """Write components, floats or arrays ``(m,)``, to a piece of a stack ``(n, k)``."""
    stack[piece] = np.asarray(numbers).T
