"""Arrays that carry their derivatives along some directions.

A product of transforms is differentiated by the product rule, factor by factor.
Values may be complex, so a complex step through a derivative gives the second
one, exact as well. Both theses' references are differentiated by this alone.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Hashable, Mapping, Sequence
from types import EllipsisType

import numpy as np

from thesis_pin.numeric.rotations import invert

_PLANES = {"Rx": (1, 2), "Ry": (2, 0), "Rz": (0, 1)}
Index = int | tuple[int | slice | EllipsisType | None, ...]
"""What picks entries of an array."""
Along = Mapping[str, float | np.ndarray]
"""A direction: how fast it goes along each of some others, which are called by names."""
_Directions = tuple[Hashable, ...]


class Dual:
    """value + Σ slope·ε with εε' = 0, one ε a direction.

    All slopes stand in one array, so that an operation takes one call for all of them.

    Args:
        value: Numbers of any shape.
        slopes: Derivative along each direction the value changes along, same shape
            or broadcast with it.

    Attributes:
        value: The same.
        directions: What the value changes along.
        stack: Derivative along each direction, the directions first; then at least as many axes
            as the value has, which broadcast with its own.
    """

    __slots__ = ("directions", "stack", "value")
    __array_ufunc__ = None  # leaves array @ Dual to this class

    value: np.ndarray
    directions: _Directions
    stack: np.ndarray

    def __init__(self, value: np.ndarray, slopes: Mapping[Hashable, np.ndarray]) -> None:
        self._set(value, tuple(slopes), _stacked(list(slopes.values())))

    @classmethod
    def of(cls, value: np.ndarray, directions: _Directions, stack: np.ndarray) -> Dual:
        """From its attributes."""
        made = cls.__new__(cls)
        made._set(value, directions, stack)
        return made

    def _set(self, value: np.ndarray, directions: _Directions, stack: np.ndarray) -> None:
        self.value, self.directions = value, directions
        self.stack = _lifted(stack, value.ndim) if directions else np.zeros((0, *value.shape))

    @property
    def slopes(self) -> dict[Hashable, np.ndarray]:
        """Derivative along each direction."""
        return dict(zip(self.directions, self.stack, strict=True))

    def along(self, direction: Hashable) -> np.ndarray:
        """Derivative along a direction; zeros where the value doesn't change."""
        if direction not in self.directions:
            return np.zeros_like(self.value)
        return np.asarray(self.stack[self.directions.index(direction)])

    def towards(self, along: Mapping[Hashable, Along], rank: int) -> Dual:
        """Along directions that are made of this one's, by the chain rule.

        Args:
            along: New directions, with speeds of shape ``(...)`` along the old ones; what isn't
                named stands still.
            rank: Number of the value's last axes that aren't those of a speed: 0 for numbers,
                1 for vectors, 2 for matrices.
        """
        tail = (..., *(None,) * rank)
        found: dict[Hashable, np.ndarray] = {}
        for direction, speeds in along.items():
            for slope, name in zip(self.stack, self.directions, strict=True):
                if not isinstance(name, str) or name not in speeds:
                    continue
                term = slope * np.asarray(speeds[name])[tail]
                found[direction] = found[direction] + term if direction in found else term
        return Dual(self.value, found)

    def jacobian(self, directions: Sequence[Hashable]) -> np.ndarray:
        """Derivatives along some directions, which are the last axis: zeros where nothing changes.

        Shape ``(..., directions)``.
        """
        slopes = self._whole()
        found = np.zeros((*slopes.shape[1:], len(directions)), dtype=slopes.dtype)
        for slope, direction in zip(slopes, self.directions, strict=True):
            if direction in directions:
                found[..., directions.index(direction)] = slope
        return found

    def __matmul__(self, other: Dual | np.ndarray) -> Dual:
        return _product(np.matmul, self, dual(other))

    def __rmatmul__(self, other: np.ndarray) -> Dual:
        return dual(other) @ self

    def __mul__(self, other: Dual | np.ndarray) -> Dual:
        return _product(np.multiply, self, dual(other))

    def __sub__(self, other: Dual | np.ndarray) -> Dual:
        other = dual(other)
        changes = _sum(self.directions, self.stack, other.directions, -other.stack)
        return Dual.of(self.value - other.value, *changes)

    def __getitem__(self, key: Index) -> Dual:
        parts = key if isinstance(key, tuple) else (key,)
        return Dual.of(self.value[key], self.directions, self._whole()[(slice(None), *parts)])

    def sum(self, axis: int) -> Dual:
        """Sum over an axis."""
        own = axis if axis < 0 else axis + 1
        return Dual.of(self.value.sum(axis=axis), self.directions, self._whole().sum(axis=own))

    def _whole(self) -> np.ndarray:
        """The slopes with the value's axes at full length, so that entries can be picked."""
        if self.stack.shape[1:] == self.value.shape:
            return self.stack
        shape = np.broadcast_shapes(self.stack.shape[1:], self.value.shape)
        return np.broadcast_to(self.stack, (len(self.directions), *shape))

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
        directions, stack = self.directions, self.stack
        if directions:
            stack = times_elementary(_lifted(stack, by.ndim + 2), move, by)
        if speeds:
            slope = times_elementary(self.value, move, by, derivative=True)
            own = [slope * np.asarray(speed)[..., None, None] for speed in speeds.values()]
            directions, stack = _sum(directions, stack, tuple(speeds), _stacked(own))
        return Dual.of(times_elementary(self.value, move, by), directions, stack)

    @property
    def rotation(self) -> np.ndarray:
        """Axes in the world, shape ``(..., 3, 3)``."""
        return self.value[..., :3, :3]

    def axis(self, direction: Hashable) -> np.ndarray:
        """Angular velocity along a direction, shape ``(..., 3)``: the vector of ∂R Rᵀ."""
        return vee(self.along(direction)[..., :3, :3] @ np.swapaxes(self.rotation, -1, -2))

    def axes(self) -> Dual:
        """No rotation, shape ``(..., 3)``, whose slopes are :meth:`axis` along every direction."""
        spins = vee(self._whole()[..., :3, :3] @ np.swapaxes(self.rotation, -1, -2))
        return Dual.of(np.zeros_like(self.value[..., 0, :3]), self.directions, spins)


def dual(x: Dual | np.ndarray) -> Dual:
    """An array as one that doesn't change."""
    return x if isinstance(x, Dual) else Dual(x, {})


def _stacked(slopes: Sequence[np.ndarray]) -> np.ndarray:
    """Slopes that broadcast with each other, one above the other."""
    if len(slopes) == 1:
        return slopes[0][None]
    if any(one.shape != slopes[0].shape for one in slopes):
        slopes = np.broadcast_arrays(*slopes)
    return np.stack(slopes) if slopes else np.zeros(0)


def _lifted(stack: np.ndarray, axes: int) -> np.ndarray:
    """Slopes with at least as many axes as a value has, behind that of the directions."""
    lacking = axes + 1 - stack.ndim
    if lacking <= 0:
        return stack
    return stack.reshape(len(stack), *(1,) * lacking, *stack.shape[1:])


@functools.lru_cache(maxsize=1024)
def _united(first: _Directions, second: _Directions) -> tuple[_Directions, list[int]]:
    """Directions of two, and where those of the second stand among them."""
    every = (*first, *(one for one in second if one not in first))
    return every, [every.index(one) for one in second]


def _sum(
    first: _Directions, slopes: np.ndarray, second: _Directions, more: np.ndarray
) -> tuple[_Directions, np.ndarray]:
    """Directions and slopes of a sum."""
    if not first or not second:
        return (first, slopes) if first else (second, more)
    axes = max(slopes.ndim, more.ndim) - 1
    slopes, more = _lifted(slopes, axes), _lifted(more, axes)
    if first == second:
        return first, slopes + more
    every, places = _united(first, second)
    shape = np.broadcast_shapes(slopes.shape[1:], more.shape[1:])
    total = np.zeros((len(every), *shape), dtype=np.result_type(slopes, more))
    total[: len(first)] = slopes
    total[places] += more
    return every, total


def _product(of: Callable[[np.ndarray, np.ndarray], np.ndarray], a: Dual, b: Dual) -> Dual:
    directions, stack = a.directions, a.stack
    if a.directions:
        stack = of(_lifted(a.stack, b.value.ndim), b.value)
    if b.directions:
        other = of(a.value, _lifted(b.stack, a.value.ndim))
        directions, stack = _sum(directions, stack, b.directions, other)
    return Dual.of(of(a.value, b.value), directions, stack)


def inverse(matrix: Dual | np.ndarray) -> Dual | np.ndarray:
    """Inverse of rigid placements, complex ones included."""
    if not isinstance(matrix, Dual):
        return invert(matrix)
    back = invert(matrix.value)
    return Dual.of(back, matrix.directions, -(back @ matrix.stack @ back))


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
    batch = matrix.shape[:-2]
    shape = batch if batch == by.shape else np.broadcast_shapes(batch, by.shape)
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
