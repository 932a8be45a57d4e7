"""Piecewise polynomials: SciPy's ``PPoly`` without the import of SciPy."""

from __future__ import annotations

from functools import cached_property
from math import perm
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

if TYPE_CHECKING:
    from scipy.interpolate import PPoly


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
        times = np.asarray(t, dtype=float)
        where, (order, pieces, *shape) = times.ravel(), self.c.shape
        if pieces == 1:
            offset, coefficients = where - self.x[0], self.c
        else:
            piece = np.clip(np.searchsorted(self.x, where, side="right") - 1, 0, pieces - 1)
            offset, coefficients = where - self.x[piece], self.c[:, piece]
        offset = offset.reshape(-1, *[1] * len(shape))
        result, power = np.zeros((len(where), *shape)), np.ones(offset.shape)
        for k in range(nu, order):  # from the constant upwards, as SciPy adds up
            result += coefficients[order - 1 - k] * power * float(perm(k, nu))
            power *= offset
        result[np.isnan(where)] = np.nan
        return result.reshape((*times.shape, *shape))

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
