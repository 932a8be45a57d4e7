"""Scalars, vectors and matrices behind batch axes, and their arithmetic."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from thesis_pin.equations import frames as fr
from thesis_pin.equations.formula import FormulaError, FrameError
from thesis_pin.equations.frames import ANY, Frames
from thesis_pin.numeric.turns import TURN

_STACKED = 3
"""Axes of an array of matrices, at least."""

STEP = 1e-30
"""Complex step: small enough that its square vanishes, so derivatives are exact."""


@dataclass(frozen=True)
class Value:
    """A scalar, vector or matrix at a batch of states.

    Attributes:
        array: Numbers of shape ``(*batch, *tail)``.
        rank: Number of tail axes: 0, 1 or 2; −1 for a zero of any shape.
        frames: What a vector is seen from, a rotation turns between; see
            :mod:`thesis_pin.equations.frames`.
        turns: Whether it is an angle known up to whole turns: an atan2, or a sum with one.
    """

    array: np.ndarray
    rank: int
    frames: Frames = ANY
    turns: bool = False

    @property
    def tail(self) -> tuple[int, ...]:
        """Shape without the batch axes."""
        return self.array.shape[self.array.ndim - self.rank :] if self.rank > 0 else ()

    def describe(self) -> str:
        """In words, for messages."""
        if self.rank <= 0:
            return "a scalar" if self.rank == 0 else "zero"
        if self.rank == 1:
            return f"a vector of {self.tail[0]}"
        return f"a {self.tail[0]}×{self.tail[1]} matrix"

    def seen(self) -> str:
        """In words, with its frames."""
        return self.describe() + fr.described(self.frames)

    def within(self, frames: Frames) -> Value:
        """The same numbers, seen from a frame or turning between two."""
        if frames is self.frames:
            return self
        return Value(self.array, self.rank, frames, self.turns)


ZERO = Value(np.zeros(()), -1)


def scalar(array: np.ndarray | float) -> Value:
    """A scalar value."""
    return Value(np.asarray(array), 0)


def vector(array: np.ndarray) -> Value:
    """A vector value, shape ``(*batch, n)``."""
    return Value(array, 1)


def matrix(array: np.ndarray) -> Value:
    """A matrix value, shape ``(*batch, m, n)``."""
    return Value(array, 2)


def imaginary(value: Value) -> Value:
    """The derivative that a complex step left in a value."""
    if value.rank == -1:
        return ZERO
    return Value(np.imag(value.array) / STEP, value.rank, value.frames)


def arctan2(y: np.ndarray, x: np.ndarray) -> np.ndarray:
    """atan2 that carries a complex step; NaN where both are zero."""
    up, right = np.real(y), np.real(x)
    square = right**2 + up**2
    angle = np.where(square > 0, np.arctan2(up, right), np.nan)
    if not (np.iscomplexobj(y) or np.iscomplexobj(x)):
        return angle
    return np.asarray(angle + 1j * ((right * np.imag(y) - up * np.imag(x)) / square))


def apart(first: Value, second: Value) -> np.ndarray:
    """``first - second`` in numbers; of angles known up to whole turns, without these."""
    gap = first.array - second.array
    if first.turns or second.turns:
        gap = gap - TURN * np.round(np.real(gap) / TURN)
    return np.asarray(gap)


def add(first: Value, second: Value) -> Value:
    """Sum of two values of one shape."""
    if first.rank == -1 or second.rank == -1:
        return second if first.rank == -1 else first
    if first.rank != second.rank or (first.rank and first.tail != second.tail):
        raise FormulaError(f"adds {first.describe()} and {second.describe()}")
    frames = fr.same(first.frames, second.frames)
    if not frames:
        raise FrameError(f"adds {second.seen()} to {first.seen()}")
    turns = first.turns or second.turns
    return Value(first.array + second.array, first.rank, frames, turns)


def multiply(first: Value, second: Value) -> Value:
    """Product of two factors side by side."""
    if first.rank == -1 or second.rank == -1:
        return ZERO
    if first.rank == 0:
        turns = second.turns and _whole(first)
        array = _spread(first.array, second.rank) * second.array
        return Value(array, second.rank, second.frames, turns)
    if second.rank == 0:
        turns = first.turns and _whole(second)
        array = first.array * _spread(second.array, first.rank)
        return Value(array, first.rank, first.frames, turns)
    a, b = first.array, second.array
    if first.rank == 1:
        if second.rank == 2 and second.tail[0] == 1:
            return Value(a[..., :, None] * b, 2, _joined(first, second))
        raise FormulaError(f"multiplies {first.describe()} by {second.describe()}")
    if first.tail[1] != second.tail[0]:
        raise FormulaError(f"multiplies {first.describe()} by {second.describe()}")
    frames = _joined(first, second)
    if second.rank == 1:
        result = _matmul(a, b[..., None])[..., 0]
        return scalar(result[..., 0]) if first.tail[0] == 1 else Value(result, 1, frames)
    return Value(_matmul(a, b), 2, frames)


def _matmul(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """a @ b; where the second is one for all of the last batch axis, of one tall matrix."""
    if min(a.ndim, b.ndim) < _STACKED or b.shape[-3] != 1 or a.shape[-3] == 1:
        return np.asarray(np.matmul(a, b))
    tall = a.reshape(*a.shape[:-3], -1, a.shape[-1])
    result = np.matmul(tall, b[..., 0, :, :])
    return np.asarray(result.reshape(*result.shape[:-2], *a.shape[-3:-1], b.shape[-1]))


def _whole(value: Value) -> bool:
    """Whether a value is one whole number at all states."""
    return value.array.ndim == 0 and float(value.array.real).is_integer()


def _joined(first: Value, second: Value) -> Frames:
    frames = fr.joined(first.frames, second.frames)
    if frames:
        return frames
    raise FrameError(f"multiplies {first.seen()} by {second.seen()}")


def _spread(array: np.ndarray, rank: int) -> np.ndarray:
    return array[(...,) + (None,) * rank] if rank > 0 else array


def cross(first: Value, second: Value) -> Value:
    """Vector product."""
    if first.rank == -1 or second.rank == -1:
        return ZERO
    if first.rank != 1 or second.rank != 1 or first.tail != (3,) or second.tail != (3,):
        raise FormulaError(
            f"takes the vector product of {first.describe()} and {second.describe()}"
        )
    a, b = first.array, second.array
    frames = fr.same(first.frames, second.frames)
    if not frames:
        raise FrameError(f"takes the vector product of {first.seen()} and {second.seen()}")
    parts = [a[..., k - 2] * b[..., k - 1] - a[..., k - 1] * b[..., k - 2] for k in range(3)]
    return Value(np.stack(parts, axis=-1), 1, frames)


def transpose(value: Value) -> Value:
    """Transpose; a vector becomes a row and a row a vector. Never conjugates."""
    if value.rank <= 0:
        return value
    frames = fr.swapped(value.frames)
    if value.rank == 1:
        return Value(value.array[..., None, :], 2, frames)
    if value.tail[0] == 1:
        return Value(value.array[..., 0, :], 1, frames)
    return Value(np.swapaxes(value.array, -1, -2), 2, frames)


def power(value: Value, exponent: int | str) -> Value:
    """Integer power of a scalar, square of a vector's length, inverse of a matrix."""
    if isinstance(exponent, str):
        raise FormulaError(f"the exponent {exponent} has no value")
    if value.rank == 0:
        return scalar(value.array ** float(exponent))
    if value.rank == 1 and exponent == 2:  # ½ m v², where v is a vector
        return scalar((value.array * value.array).sum(axis=-1))
    if value.rank == 2 and exponent == -1 and value.tail[0] != value.tail[1]:
        raise FormulaError(f"inverts {value.describe()}, which has no inverse")
    if value.rank == 2 and exponent == -1:
        return Value(np.linalg.inv(value.array), 2, fr.swapped(value.frames))
    raise FormulaError(f"raises {value.describe()} to the power {exponent}")


def blocks(rows: list[list[Value]], columns: int) -> Value:
    """Matrix from its cells: numbers, or vectors as columns; a column of both is one vector.

    A row of vectors that ends in 0 and is too short stands for one whose last 0
    fills the missing columns: the notation the Scout thesis uses for J_B.
    """
    cells = [cell for row in rows for cell in row]
    if len({len(row) for row in rows}) > 1:
        raise FormulaError("a matrix whose rows differ in length")
    if all(cell.rank <= 0 for cell in cells):
        arrays = [cell.array for cell in cells]
        batch = np.broadcast_shapes(*{array.shape for array in arrays})
        array = np.empty((*batch, len(rows), len(rows[0])), dtype=np.result_type(*arrays))
        for row, column in np.ndindex(array.shape[-2:]):
            array[..., row, column] = rows[row][column].array
        if len(rows[0]) == 1 < len(rows):
            return Value(array[..., 0], 1, turns=any(cell.turns for cell in cells))
        return matrix(array)
    if len(rows[0]) == 1 < len(rows) and {cell.rank for cell in cells} == {0, 1}:
        return _stacked(cells)
    height = next(cell.tail[0] for cell in cells if cell.rank > 0)
    filled = []
    for row in rows:
        if len(rows) == 1 and len(row) < columns and row[-1].rank == -1:
            row = row + [ZERO] * (columns - len(row))
        filled.append(row)
    batch = np.broadcast_shapes(
        *(cell.array.shape[: cell.array.ndim - cell.rank] for cell in cells if cell.rank > 0)
    )
    lines = []
    for row in filled:
        parts = []
        for cell in row:
            if cell.rank == 0 or (cell.rank > 0 and cell.tail[0] != height):
                raise FormulaError(f"puts {cell.describe()} beside vectors of {height}")
            array = np.zeros((height, 1)) if cell.rank == -1 else cell.array
            array = array[..., None] if cell.rank == 1 else array
            parts.append(np.broadcast_to(array, (*batch, *array.shape[-2:])))
        lines.append(np.concatenate(parts, axis=-1))
    if len({line.shape[-1] for line in lines}) > 1:
        raise FormulaError("puts rows of different length one below the other")
    return Value(np.concatenate(lines, axis=-2), 2, _beside(cells))


def _beside(cells: list[Value]) -> Frames:
    """What vectors beside and below each other are seen from."""
    frames = ANY
    for cell in cells:
        found = fr.same(frames, fr.rows(cell.frames))
        if not found:
            raise FrameError(f"puts {cell.seen()} beside columns{fr.described(frames)}")
        frames = found
    return frames


def _stacked(cells: list[Value]) -> Value:
    """One vector from vectors and numbers below each other."""
    arrays = [cell.array if cell.rank else cell.array[..., None] for cell in cells]
    batch = np.broadcast_shapes(*(array.shape[:-1] for array in arrays))
    spread = [np.broadcast_to(array, (*batch, array.shape[-1])) for array in arrays]
    return vector(np.concatenate(spread, axis=-1))
