"""Formulas as functions of a state: values, products, exact derivatives.

A formula is evaluated in an :class:`Environment`, which knows what each symbol
is at a batch of states. Values are scalars, vectors or matrices behind any
number of batch axes. Derivatives are taken by the complex step, so they are
exact to rounding and cost no subtraction.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Protocol, TypeGuard, runtime_checkable

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
    if isinstance(node, Symbol):
        return environment.lookup(node.bound(indices), indices)
    rule = _RULES.get(type(node))
    if rule is None:
        raise FormulaError(f"can't evaluate {node!r}")
    return rule(node, environment, indices)


def _number(node: nt.Number, environment: Environment, indices: dict[str, str]) -> Value:
    return ZERO if node.value == 0 else scalar(node.value)


def _sum(node: nt.Sum, environment: Environment, indices: dict[str, str]) -> Value:
    total = ZERO
    for sign, term in node.terms:
        total = add(total, _signed(sign, evaluate(term, environment, indices), indices))
    return total


def _product(node: nt.Product, environment: Environment, indices: dict[str, str]) -> Value:
    total = evaluate(node.factors[0], environment, indices)
    for factor in node.factors[1:]:
        total = multiply(total, evaluate(factor, environment, indices))
    return total


def _cross(node: nt.Cross, environment: Environment, indices: dict[str, str]) -> Value:
    first, second = (evaluate(side, environment, indices) for side in (node.left, node.right))
    numbers = first.rank == second.rank == 0
    return multiply(first, second) if numbers else cross(first, second)


def _dot(node: nt.Dot, environment: Environment, indices: dict[str, str]) -> Value:
    first, second = (evaluate(side, environment, indices) for side in (node.left, node.right))
    return multiply(transpose(first) if first.rank == 1 else first, second)


def _quotient(node: nt.Quotient, environment: Environment, indices: dict[str, str]) -> Value:
    above, below = (evaluate(part, environment, indices) for part in (node.above, node.below))
    return multiply(above, power(below, -1))


def _power(node: nt.Power, environment: Environment, indices: dict[str, str]) -> Value:
    base, exponent = evaluate(node.base, environment, indices), node.exponent
    return power(base, int(indices[exponent]) if exponent in indices else exponent)


def _transposed(node: nt.Transpose, environment: Environment, indices: dict[str, str]) -> Value:
    return transpose(evaluate(node.of, environment, indices))


def _slope(node: nt.Derivative, environment: Environment, indices: dict[str, str]) -> Value:
    return _derivative(node.of, node.by, environment, indices)


def _series(node: nt.Series, environment: Environment, indices: dict[str, str]) -> Value:
    total = ZERO
    for k in range(node.first, node.last + 1):
        total = add(total, evaluate(node.body, environment, {**indices, node.index: str(k)}))
    return total


def _matrix(node: nt.Matrix, environment: Environment, indices: dict[str, str]) -> Value:
    rows = [[evaluate(cell, environment, indices) for cell in row] for row in node.rows]
    return blocks(rows, environment.columns)


def _norm(node: nt.Norm, environment: Environment, indices: dict[str, str]) -> Value:
    length = evaluate(node.of, environment, indices)
    if node.single and length.rank == len("ij"):
        return _call(nt.Call("det", node.of), environment, indices)
    if node.single and length.rank <= 0:
        return scalar(np.sqrt(length.array * length.array))  # also of a complex step
    return scalar(np.sqrt((length.array * length.array).sum(axis=-1)))


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


# Whether a class has a protocol's methods takes Python a while to find out.
_provides = functools.cache(issubclass)


def _is_framed(environment: Environment) -> TypeGuard[Framed]:
    return _provides(type(environment), Framed)


def _is_skewed(environment: Environment) -> TypeGuard[Skewed]:
    return _provides(type(environment), Skewed)


def _turned(
    rotation: np.ndarray, node: nt.Call, environment: Environment, indices: dict[str, str]
) -> Value:
    """A printed rotation, or its slope, with its frames and about the joint's axis."""
    asked = node.function[-1], node.argument, indices
    frames = environment.turning(*asked) if _is_framed(environment) else ANY
    bent = environment.skew(*asked) if _is_skewed(environment) else None
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


_RULES: dict[type[Node], Callable[..., Value]] = {
    nt.Number: _number,
    nt.Sum: _sum,
    nt.Product: _product,
    nt.Cross: _cross,
    nt.Dot: _dot,
    nt.Quotient: _quotient,
    nt.Power: _power,
    nt.Transpose: _transposed,
    nt.Call: _call,
    nt.Derivative: _slope,
    nt.Series: _series,
    nt.Matrix: _matrix,
    nt.Norm: _norm,
}
"""What gives the value of each kind of formula."""
