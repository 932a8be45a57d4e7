"""Formulas as functions of a state: values, products, exact derivatives.

A formula is evaluated in an :class:`Environment`, which knows what each symbol
is at a batch of states. Values are scalars, vectors or matrices behind any
number of batch axes. Derivatives are taken by the complex step, so they are
exact to rounding and cost no subtraction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from thesis_pin import notation as nt
from thesis_pin.notation import FormulaError, Node, Symbol
from thesis_pin.rotations import rotation, rotation_derivative, transform

STEP = 1e-30
"""Complex step: small enough that its square vanishes, so derivatives are exact."""


@dataclass(frozen=True)
class Value:
    """A scalar, vector or matrix at a batch of states.

    Attributes:
        array: Numbers of shape ``(*batch, *tail)``.
        rank: Number of tail axes: 0, 1 or 2; −1 for a zero of any shape.
    """

    array: np.ndarray
    rank: int

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


class Environment(Protocol):
    """What a formula's symbols are.

    Attributes:
        columns: Number of generalized coordinates: a row of vectors that ends in
            0 is filled up to so many columns.
    """

    columns: int

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol whose indices are bound.

        Raises:
            FormulaError: The symbol isn't defined.
        """

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative by a coordinate, or by time if ``by`` is None."""


class Movable(Environment, Protocol):
    """An environment whose states can take a complex step."""

    def moved(self, along: str | None, rates: bool) -> Movable:
        """The same environment one imaginary step along a coordinate, its rate, or time."""


def imaginary(value: Value) -> Value:
    """The derivative that a complex step left in a value."""
    return ZERO if value.rank == -1 else Value(np.imag(value.array) / STEP, value.rank)


def evaluate(node: Node, environment: Environment, indices: dict[str, str]) -> Value:
    """Value of a formula.

    Args:
        node: The formula.
        environment: What its symbols are.
        indices: Values of index letters, for instance ``{"i": "1"}``.

    Raises:
        FormulaError: A symbol isn't defined, or the shapes don't fit.
    """

    def of(part: Node) -> Value:
        return evaluate(part, environment, indices)

    match node:
        case nt.Number(value):
            return ZERO if value == 0 else scalar(value)
        case Symbol():
            return environment.lookup(node.bound(indices), indices)
        case nt.Sum(terms):
            total = ZERO
            for sign, term in terms:
                total = add(total, _signed(sign, of(term), indices))
            return total
        case nt.Product(factors):
            total = of(factors[0])
            for factor in factors[1:]:
                total = multiply(total, of(factor))
            return total
        case nt.Cross(left, right):
            return cross(of(left), of(right))
        case nt.Dot(left, right):
            first, second = of(left), of(right)
            return multiply(transpose(first) if first.rank == 1 else first, second)
        case nt.Quotient(above, below):
            return multiply(of(above), power(of(below), -1))
        case nt.Power(base, exponent):
            return power(of(base), int(indices[exponent]) if exponent in indices else exponent)
        case nt.Transpose(inner):
            return transpose(of(inner))
        case nt.Call():
            return _call(node, environment, indices)
        case nt.Derivative(inner, by):
            return _derivative(inner, by, environment, indices)
        case nt.Series(index, first, last, body):
            total = ZERO
            for k in range(first, last + 1):
                total = add(total, evaluate(body, environment, {**indices, index: str(k)}))
            return total
        case nt.Matrix(rows):
            return blocks([[of(cell) for cell in row] for row in rows], environment.columns)
        case nt.Norm(inner):
            value = of(inner)
            return scalar(np.sqrt((value.array * value.array).sum(axis=-1)))
    raise FormulaError(f"can't evaluate {node!r}")


def _signed(sign: str, value: Value, indices: dict[str, str]) -> Value:
    if sign in ("\\pm", "\\mp"):
        upper = indices.get("±", "+") == "+"
        sign = "+" if upper == (sign == "\\pm") else "-"
    return value if sign == "+" else Value(-value.array, value.rank)


def add(first: Value, second: Value) -> Value:
    """Sum of two values of one shape."""
    if first.rank == -1 or second.rank == -1:
        return second if first.rank == -1 else first
    if first.rank != second.rank or first.tail != second.tail:
        raise FormulaError(f"adds {first.describe()} and {second.describe()}")
    return Value(first.array + second.array, first.rank)


def multiply(first: Value, second: Value) -> Value:
    """Product of two factors side by side."""
    if first.rank == -1 or second.rank == -1:
        return ZERO
    if first.rank == 0:
        return Value(_spread(first.array, second.rank) * second.array, second.rank)
    if second.rank == 0:
        return Value(first.array * _spread(second.array, first.rank), first.rank)
    a, b = first.array, second.array
    if first.rank == 1:
        if second.rank == 2 and second.tail[0] == 1:
            return matrix(a[..., :, None] * b)
        raise FormulaError(f"multiplies {first.describe()} by {second.describe()}")
    if first.tail[1] != second.tail[0]:
        raise FormulaError(f"multiplies {first.describe()} by {second.describe()}")
    if second.rank == 1:
        result = np.matmul(a, b[..., None])[..., 0]
        return scalar(result[..., 0]) if first.tail[0] == 1 else vector(result)
    return matrix(np.matmul(a, b))


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
    parts = [a[..., k - 2] * b[..., k - 1] - a[..., k - 1] * b[..., k - 2] for k in range(3)]
    return vector(np.stack(parts, axis=-1))


def transpose(value: Value) -> Value:
    """Transpose; a vector becomes a row and a row a vector. Never conjugates."""
    if value.rank <= 0:
        return value
    if value.rank == 1:
        return matrix(value.array[..., None, :])
    if value.tail[0] == 1:
        return vector(value.array[..., 0, :])
    return matrix(np.swapaxes(value.array, -1, -2))


def power(value: Value, exponent: int | str) -> Value:
    """Integer power of a scalar, inverse of a matrix."""
    if isinstance(exponent, str):
        raise FormulaError(f"the exponent {exponent} has no value")
    if value.rank == 0:
        return scalar(value.array ** float(exponent))
    if value.rank == 2 and exponent == -1:
        return matrix(np.linalg.inv(value.array))
    raise FormulaError(f"raises {value.describe()} to the power {exponent}")


def blocks(rows: list[list[Value]], columns: int) -> Value:
    """Matrix from its cells: numbers, or vectors as columns.

    A row of vectors that ends in 0 and is too short stands for one whose last 0
    fills the missing columns: the notation the Scout thesis uses for J_B.
    """
    cells = [cell for row in rows for cell in row]
    if len({len(row) for row in rows}) > 1:
        raise FormulaError("a matrix whose rows differ in length")
    if all(cell.rank <= 0 for cell in cells):
        batch = np.broadcast_shapes(*(cell.array.shape for cell in cells))
        spread = [[np.broadcast_to(cell.array, batch) for cell in row] for row in rows]
        array = np.stack([np.stack(row, axis=-1) for row in spread], axis=-2)
        return vector(array[..., 0]) if len(rows[0]) == 1 < len(rows) else matrix(array)
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
    return matrix(np.concatenate(lines, axis=-2))


_ROTATIONS = {"R_x": "x", "R_y": "y", "R_z": "z", "T_z4": "x", "T_z5": "y", "T_z6": "z"}
_TRANSLATIONS = {"T_z1": 0, "T_z2": 1, "T_z3": 2}
_SPINS = {"Omega_x": "x", "Omega_y": "y", "Omega_z": "z"}
_ELEMENTARY = {
    "cos": np.cos,
    "sin": np.sin,
    "tan": np.tan,
    "sec": lambda x: 1 / np.cos(x),
    "csc": lambda x: 1 / np.sin(x),
    "cot": lambda x: 1 / np.tan(x),
    "arctan": np.arctan,
    "sqrt": np.sqrt,
}
FUNCTIONS = frozenset({*_ROTATIONS, *_TRANSLATIONS, *_SPINS})
"""Symbols that both theses use as functions of the bracket after them."""


def _call(node: nt.Call, environment: Environment, indices: dict[str, str]) -> Value:
    if node.dots:
        undotted = nt.Call(node.function, node.argument, node.dots - 1)
        return environment.partial(undotted, None, indices)
    argument = evaluate(node.argument, environment, indices)
    if argument.rank > 0:
        raise FormulaError(f"takes {node.function} of {argument.describe()}")
    x, name = argument.array, node.function
    if name in _ELEMENTARY:
        return scalar(_ELEMENTARY[name](x))
    if name in _ROTATIONS:
        turned = rotation(_ROTATIONS[name], x)
        return matrix(turned if name[0] == "R" else transform(turned, np.zeros(3)))
    if name in _TRANSLATIONS:
        shift = np.zeros((*x.shape, 3), dtype=x.dtype)
        shift[..., _TRANSLATIONS[name]] = x
        return matrix(transform(np.eye(3), shift))
    if name in _SPINS:
        spin = rotation_derivative(_SPINS[name], np.zeros(()))
        return matrix(spin * _spread(x, 2))
    raise FormulaError(f"unknown function {name!r}")


def _derivative(
    of: Node, by: Node | None, environment: Environment, indices: dict[str, str]
) -> Value:
    if isinstance(of, nt.Call) and of.argument == by and of.function in _ROTATIONS:
        angle = evaluate(of.argument, environment, indices)
        return matrix(rotation_derivative(_ROTATIONS[of.function], angle.array))
    if isinstance(of, nt.Transpose):
        return transpose(_derivative(of.of, by, environment, indices))
    if by is None or isinstance(by, Symbol):
        return environment.partial(of, by.bound(indices) if by else None, indices)
    raise FormulaError("differentiates by something that isn't the argument of the function")
