"""Piecewise polynomials: SciPy's ``PPoly`` without the import of SciPy."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from math import perm
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.numeric.elementwise import Samples
from thesis_pin.numeric.sparing import Part, nothing, plus, times

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

_FEW = 32
"""Samples a piece from which it is worth while to go from piece to piece."""


class Piecewise:
    """A piecewise polynomial, evaluated to the bit as ``scipy.interpolate.PPoly`` does.

    Importing SciPy's takes twice as long as importing Pinocchio; :attr:`ppoly` is one, and
    whatever else a ``PPoly`` has, as ``roots`` or ``antiderivative``, is taken from there.

    Attributes:
        c: Coefficients, highest power of the distance from a piece's start first, shape
            ``(order, pieces, ...)``.
        x: Where pieces begin and end, ascending, shape ``(pieces + 1,)``.
    """

    def __init__(self, c: ArrayLike, x: ArrayLike) -> None:
        self.c = np.ascontiguousarray(c, dtype=float)
        self.x = np.ascontiguousarray(x, dtype=float)

    def __call__(self, t: ArrayLike, nu: int = 0) -> np.ndarray:
        """Values, or derivatives of order ``nu``; at an inner knot the piece on its right holds.

        Args:
            t: Where, of any shape; outside, the outermost pieces go on.
            nu: Order of the derivative.

        Returns:
            Shape of ``t``, then that of one coefficient.
        """
        given = np.asarray(t, dtype=float)
        where, (order, pieces, *shape) = given.ravel(), self.c.shape
        if pieces == 1:
            piece: Samples = slice(None)
        else:
            piece = np.clip(np.searchsorted(self.x, where, side="right") - 1, 0, pieces - 1)
        offset = where - self.x[:-1][piece]
        offset = offset.reshape(-1, *[1] * len(shape))
        result, power = np.zeros((len(where), *shape)), np.ones(offset.shape)
        for k in range(nu, order):  # from the constant upwards, as SciPy adds up
            result += self.c[order - 1 - k][piece] * power * float(perm(k, nu))
            power *= offset
        result[np.isnan(where)] = np.nan
        return result.reshape((*given.shape, *shape))

    def derivative(self, nu: int = 1) -> Piecewise:
        """The derivative of order ``nu`` as a piecewise polynomial."""
        order = len(self.c)
        if order <= nu:
            return Piecewise(np.zeros((1, *self.c.shape[1:])), self.x)
        factors = np.array([float(perm(k, nu)) for k in range(order - 1, nu - 1, -1)])
        factors = factors.reshape(-1, *[1] * (self.c.ndim - 1))
        return Piecewise(self.c[: order - nu] * factors, self.x)

    @cached_property
    def ppoly(self) -> PPoly:
        """The same for SciPy's tools."""
        from scipy.interpolate import PPoly

        return PPoly(self.c, self.x)

    def __getattr__(self, name: str) -> object:
        if name.startswith("_"):  # copying and pickling look for such names in what is half made
            raise AttributeError(name)
        return getattr(self.ppoly, name)


def jet(curve: Piecewise | PPoly, t: np.ndarray) -> tuple[Part, Part, Part]:
    """Values, rates and accelerations together, by Horner's scheme.

    Args:
        curve: Single values only, no vectors.
        t: Where, shape ``(n,)``, n ≥ 1.

    Returns:
        Each an array ``(n,)``, or a float where it is the same everywhere.
    """
    pieces = curve.c.shape[1]
    if len(t) == 1:
        here = float(t[0])
        piece = min(max(bisect_right(curve.x, here) - 1, 0), pieces - 1)
        return _horner(curve.c[:, piece].tolist(), here - float(curve.x[piece]))
    if pieces == 1:
        return _horner(curve.c[:, 0].tolist(), t - curve.x[0])
    if len(t) < _FEW * pieces or (t[1:] < t[:-1]).any():
        piece = np.clip(np.searchsorted(curve.x, t, side="right") - 1, 0, pieces - 1)
        return _horner(list(curve.c[:, piece]), t - curve.x[piece])
    # Numbers for coefficients: with an array of them it would take twice as long.
    ends = [0, *np.searchsorted(t, curve.x[1:-1]).tolist(), len(t)]
    steps = [(k, slice(*ends)) for k, ends in enumerate(pairwise(ends)) if ends[0] < ends[1]]
    jets = [_horner(curve.c[:, k].tolist(), t[some] - curve.x[k]) for k, some in steps]
    found = [_joined(values, steps, len(t)) for values in zip(*jets, strict=True)]
    return found[0], found[1], found[2]


def _horner(coefficients: list[Part], offset: Part) -> tuple[Part, Part, Part]:
    """A polynomial, highest power first, with its first two derivatives."""
    value: Part = 0.0
    rate: Part = 0.0
    second: Part = 0.0
    powers = len(coefficients) - 1
    first = next((k for k in range(powers) if not nothing(coefficients[k])), powers)
    for coefficient in coefficients[first:]:
        second = plus(times(second, offset), rate)
        rate = plus(times(rate, offset), value)
        value = plus(times(value, offset), coefficient)
    return value, rate, times(2.0, second)


def _joined(values: Sequence[Part], steps: Sequence[tuple[int, slice]], count: int) -> Part:
    """What holds from step to step as one array, or as one float if it is the same everywhere."""
    first = values[0]
    if all(isinstance(value, float) and value == first for value in values):
        return first
    whole = np.empty(count)
    for (_, some), value in zip(steps, values, strict=True):
        whole[some] = value
    return whole
