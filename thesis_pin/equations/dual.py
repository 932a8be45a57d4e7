"""Arrays that carry their derivatives along some directions.

A product of transforms is differentiated by the product rule, factor by factor.
Values may be complex, so a complex step through a derivative gives the second
one, exact as well. Both theses' references are differentiated by this alone.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from types import EllipsisType

import numpy as np

from thesis_pin.numeric.rotations import invert

_PLANES = {"Rx": (1, 2), "Ry": (2, 0), "Rz": (0, 1)}
Index = int | tuple[int | slice | EllipsisType | None, ...]
"""What picks entries of an array."""


@dataclass(frozen=True)
class Dual:
    """value + Σ slope·ε with εε' = 0, one ε a direction.

    Attributes:
        value: Numbers of any shape.
        slopes: Derivative along each direction the value changes along, same shape
            or broadcast with it.
    """

    __array_ufunc__ = None  # leaves array @ Dual to this class

    value: np.ndarray
    slopes: Mapping[Hashable, np.ndarray]

    def along(self, direction: Hashable) -> np.ndarray:
        """Derivative along a direction; zeros where the value doesn't change."""
        found = self.slopes.get(direction)
        return np.zeros_like(self.value) if found is None else found

    def __matmul__(self, other: Dual | np.ndarray) -> Dual:
        return _product(np.matmul, self, dual(other))

    def __rmatmul__(self, other: np.ndarray) -> Dual:
        return dual(other) @ self

    def __mul__(self, other: Dual | np.ndarray) -> Dual:
        return _product(np.multiply, self, dual(other))

    def __sub__(self, other: Dual | np.ndarray) -> Dual:
        other = dual(other)
        lost = {k: -s for k, s in other.slopes.items()}
        return Dual(self.value - other.value, _sum(self.slopes, lost))

    def __getitem__(self, key: Index) -> Dual:
        return self._each(lambda x: np.asarray(x[key]))

    def sum(self, axis: int) -> Dual:
        """Sum over an axis."""
        return self._each(lambda x: x.sum(axis=axis))

    def _each(self, of: Callable[[np.ndarray], np.ndarray]) -> Dual:
        """A linear map of the value, and so of every slope."""
        return Dual(of(self.value), {k: of(s) for k, s in self.slopes.items()})

    # -- placements, shape (..., 4, 4) ---------------------------------------------

    def then(
        self, move: str, by: np.ndarray, speeds: Mapping[Hashable, float | np.ndarray]
    ) -> Dual:
        """Multiply by an elementary transform.

        Args:
            move: "x", "y", "z" to translate, "Rx", "Ry", "Rz" to rotate.
            by: Distance [m] or angle [rad], shape ``(...)``.
            speeds: Its derivative along each direction it changes along.
        """
        own = {}
        if speeds:
            slope = times_elementary(self.value, move, by, derivative=True)
            own = {k: slope * np.asarray(speed)[..., None, None] for k, speed in speeds.items()}
        carried = {k: times_elementary(s, move, by) for k, s in self.slopes.items()}
        return Dual(times_elementary(self.value, move, by), _sum(carried, own))

    @property
    def rotation(self) -> np.ndarray:
        """Axes in the world, shape ``(..., 3, 3)``."""
        return self.value[..., :3, :3]

    def axis(self, direction: Hashable) -> np.ndarray:
        """Angular velocity along a direction, shape ``(..., 3)``: the vector of ∂R Rᵀ."""
        return vee(self.along(direction)[..., :3, :3] @ np.swapaxes(self.rotation, -1, -2))


def dual(x: Dual | np.ndarray) -> Dual:
    """An array as one that doesn't change."""
    return x if isinstance(x, Dual) else Dual(x, {})


def _sum(
    first: Mapping[Hashable, np.ndarray], second: Mapping[Hashable, np.ndarray]
) -> dict[Hashable, np.ndarray]:
    return {**first, **{k: first[k] + s if k in first else s for k, s in second.items()}}


def _product(of: Callable[[np.ndarray, np.ndarray], np.ndarray], a: Dual, b: Dual) -> Dual:
    first = {k: of(s, b.value) for k, s in a.slopes.items()}
    return Dual(of(a.value, b.value), _sum(first, {k: of(a.value, s) for k, s in b.slopes.items()}))


def inverse(matrix: Dual | np.ndarray) -> Dual | np.ndarray:
    """Inverse of rigid placements, complex ones included."""
    if not isinstance(matrix, Dual):
        return invert(matrix)
    back = invert(matrix.value)
    return Dual(back, {k: -(back @ s @ back) for k, s in matrix.slopes.items()})


def vee(skew: np.ndarray) -> np.ndarray:
    """Vector of a skew matrix: ``(..., 3, 3)`` → ``(..., 3)``."""
    return np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], axis=-1)


def times_elementary(
    matrix: np.ndarray, move: str, by: np.ndarray, *, derivative: bool = False
) -> np.ndarray:
    """``matrix @ T`` for an elementary transform T, or for its derivative.

    A translation changes the last column and a rotation mixes two, so no product
    of 4×4 matrices is formed.

    Args:
        matrix: Shape ``(..., 4, 4)``.
        move: "x", "y", "z", "Rx", "Ry" or "Rz".
        by: Distance or angle, shape ``(...)``.
        derivative: Take ∂T/∂by instead of T.
    """
    shape = np.broadcast_shapes(matrix.shape[:-2], by.shape)
    result = np.zeros((*shape, 4, 4), dtype=np.result_type(matrix, by))
    if not derivative:
        result[...] = matrix
    if move[0] != "R":
        along = matrix[..., "xyz".index(move)]
        result[..., 3] += along if derivative else along * by[..., None]
        return result
    first, second = _PLANES[move]
    one, other = matrix[..., first], matrix[..., second]
    cosine, sine = np.cos(by)[..., None], np.sin(by)[..., None]
    if derivative:
        cosine, sine = -sine, cosine
    result[..., first] = one * cosine + other * sine
    result[..., second] = other * cosine - one * sine
    return result
