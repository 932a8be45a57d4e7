"""Arrays that carry their derivative along one direction.

A product of transforms is differentiated by the product rule, factor by factor.
Values may be complex, so a complex step through a derivative gives the second
one, exact as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Dual:
    """value + slope·ε with ε² = 0.

    Attributes:
        value: Numbers of any shape.
        slope: Their derivative, same shape or broadcast with it.
    """

    __array_ufunc__ = None  # leaves array @ Dual to this class

    value: np.ndarray
    slope: np.ndarray

    def __matmul__(self, other: Any) -> Dual:
        other = _dual(other)
        return Dual(self.value @ other.value, self.slope @ other.value + self.value @ other.slope)

    def __rmatmul__(self, other: Any) -> Dual:
        return _dual(other) @ self

    def __mul__(self, other: Any) -> Dual:
        other = _dual(other)
        return Dual(self.value * other.value, self.slope * other.value + self.value * other.slope)

    def __sub__(self, other: Any) -> Dual:
        other = _dual(other)
        return Dual(self.value - other.value, self.slope - other.slope)

    def __getitem__(self, key: Any) -> Dual:
        return Dual(self.value[key], self.slope[key])

    def sum(self, axis: int) -> Dual:
        """Sum over an axis."""
        return Dual(self.value.sum(axis=axis), self.slope.sum(axis=axis))


def _dual(x: Any) -> Dual:
    return x if isinstance(x, Dual) else Dual(x, np.zeros_like(x))
