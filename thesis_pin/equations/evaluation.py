"""Formulas as functions of a state: values, products, exact derivatives.

A formula is evaluated in an :class:`Environment`, which knows what each symbol
is at a batch of states. Values are scalars, vectors or matrices behind any
number of batch axes. Derivatives are taken by the complex step, so they are
exact to rounding and cost no subtraction.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, runtime_checkable

import numpy as np

from thesis_pin.equations import formula as nt
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.frames import ANY, Frames
from thesis_pin.equations.values import (
    ZERO,
    Value,
    add,
    arctan2,
    blocks,
    cross,
    matrix,
    multiply,
    power,
    scalar,
    transpose,
)
from thesis_pin.numeric.rotations import rotation, rotation_derivative, transform


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


@runtime_checkable
class Framed(Protocol):
    """An environment that knows which frames an elementary rotation turns between."""

    def turning(self, axis: str, argument: Node, indices: dict[str, str]) -> Frames:
        """Frames of a rotation by a formula about "x", "y" or "z": ANY if no joint turns so."""


@runtime_checkable
class Skewed(Protocol):
    """An environment whose joints turn about other axes than the print's x, y and z."""

    def skew(self, axis: str, argument: Node, indices: dict[str, str]) -> np.ndarray | None:
        """Rotation of a printed axis into the joint's, ``(3, 3)``; None where they agree."""


class Movable(Environment, Protocol):
    """An environment whose states can take a complex step."""

    def moved(self, along: str | None, rates: bool) -> Movable:
        """The same environment one imaginary step along a coordinate, its rate, or time."""


class Unframed:
    """An environment without its frames: what numbers a formula that mixes them gives."""

    def __init__(self, environment: Environment) -> None:
        self.environment, self.columns = environment, environment.columns

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Numbers of a symbol."""
        return self.environment.lookup(symbol, indices).within(ANY)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Numbers of a derivative."""
        return self.environment.partial(of, by, indices).within(ANY)


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
            first, second = of(left), of(right)
            numbers = first.rank == second.rank == 0
            return multiply(first, second) if numbers else cross(first, second)
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
        case nt.Series(index, lowest, highest, body):
            total = ZERO
            for k in range(lowest, highest + 1):
                total = add(total, evaluate(body, environment, {**indices, index: str(k)}))
            return total
        case nt.Matrix(rows):
            return blocks([[of(cell) for cell in row] for row in rows], environment.columns)
        case nt.Norm(inner, single):
            length = of(inner)
            if single and length.rank == len("ij"):
                return _call(nt.Call("det", inner), environment, indices)
            if single and length.rank <= 0:
                return scalar(np.sqrt(length.array * length.array))  # also of a complex step
            return scalar(np.sqrt((length.array * length.array).sum(axis=-1)))
    raise FormulaError(f"can't evaluate {node!r}")


def _signed(sign: str, value: Value, indices: dict[str, str]) -> Value:
    if sign in ("\\pm", "\\mp"):
        upper = indices.get("±", "+") == "+"
        sign = "+" if upper == (sign == "\\pm") else "-"
    if sign == "+":
        return value
    return Value(-value.array, value.rank, value.frames, value.turns)


_ROTATIONS = {"R_x": "x", "R_y": "y", "R_z": "z", "T_z4": "x", "T_z5": "y", "T_z6": "z"}
_TRANSLATIONS = {"T_z1": 0, "T_z2": 1, "T_z3": 2}
_SPINS = {"Omega_x": "x", "Omega_y": "y", "Omega_z": "z"}
_TURNINGS = {"B_x": "x", "B_y": "y", "B_z": "z"}
"""Derivatives of the rotations by their angles: B_y(θ) = dR_y(θ)/dθ."""


def _cosine(x: np.ndarray) -> np.ndarray:
    """What is a sine or cosine of an angle; NaN else, of which complex numbers would make one."""
    return np.where(np.abs(np.real(x)) <= 1, x, np.nan)


_ELEMENTARY: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "cos": np.cos,
    "sin": np.sin,
    "tan": np.tan,
    "sec": lambda x: 1 / np.cos(x),
    "csc": lambda x: 1 / np.sin(x),
    "cot": lambda x: 1 / np.tan(x),
    "arctan": np.arctan,
    "arcsin": lambda x: np.arcsin(_cosine(x)),
    "arccos": lambda x: np.arccos(_cosine(x)),
    "sqrt": np.sqrt,
}
_OF_MATRICES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "det": np.linalg.det,
    "tr": lambda x: np.trace(x, axis1=-2, axis2=-1),
}
FUNCTIONS = frozenset({*_ROTATIONS, *_TRANSLATIONS, *_SPINS, *_TURNINGS})
"""Symbols that both theses use as functions of the bracket after them."""


def _call(node: nt.Call, environment: Environment, indices: dict[str, str]) -> Value:
    if node.dots:
        undotted = nt.Call(node.function, node.argument, node.dots - 1)
        return environment.partial(undotted, None, indices)
    argument = evaluate(node.argument, environment, indices)
    if node.function in _OF_MATRICES:
        if argument.rank != 2 or argument.tail[0] != argument.tail[1]:
            raise FormulaError(f"takes {node.function} of {argument.describe()}")
        return scalar(_OF_MATRICES[node.function](argument.array))
    if node.function == "atan2" and argument.rank == 1 and isinstance(node.argument, nt.Matrix):
        y, x = (argument.array[..., k] for k in range(2))
        return Value(arctan2(y, x), 0, turns=True)
    if argument.rank > 0:
        raise FormulaError(f"takes {node.function} of {argument.describe()}")
    x, name = argument.array, node.function
    if name in _ELEMENTARY:
        return scalar(_ELEMENTARY[name](x))
    if name in _ROTATIONS:
        turned = rotation(_ROTATIONS[name], x)
        if name[0] == "T":
            return matrix(transform(turned, np.zeros(3)))
        return _turned(turned, node, environment, indices)
    if name in _TURNINGS:
        slope = rotation_derivative(_TURNINGS[name], x)
        return _turned(slope, node, environment, indices)
    if name in _TRANSLATIONS:
        shift = np.zeros((*x.shape, 3), dtype=x.dtype)
        shift[..., _TRANSLATIONS[name]] = x
        return matrix(transform(np.eye(3), shift))
    if name in _SPINS:
        spin = rotation_derivative(_SPINS[name], np.zeros(()))
        return _turned(spin * x[..., None, None], node, environment, indices)
    raise FormulaError(f"unknown function {name!r}")


def _turned(
    rotation: np.ndarray, node: nt.Call, environment: Environment, indices: dict[str, str]
) -> Value:
    """A printed rotation, or its slope, with its frames and about the joint's axis."""
    asked = node.function[-1], node.argument, indices
    frames = environment.turning(*asked) if isinstance(environment, Framed) else ANY
    bent = environment.skew(*asked) if isinstance(environment, Skewed) else None
    return Value(rotation if bent is None else bent @ rotation @ bent.T, 2, frames)


def _derivative(
    of: Node, by: Node | None, environment: Environment, indices: dict[str, str]
) -> Value:
    if isinstance(of, nt.Call) and of.argument == by and of.function in _ROTATIONS:
        angle = evaluate(of.argument, environment, indices)
        slope = rotation_derivative(_ROTATIONS[of.function], angle.array)
        return _turned(slope, of, environment, indices)
    if isinstance(of, nt.Transpose):
        return transpose(_derivative(of.of, by, environment, indices))
    if by is None or isinstance(by, Symbol):
        return environment.partial(of, by.bound(indices) if by else None, indices)
    raise FormulaError("differentiates by something that isn't the argument of the function")
