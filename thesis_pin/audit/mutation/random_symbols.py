"""Symbols that are nothing but random numbers of their shapes, each free of all others.

Two formulas that are equal here are equal whatever their symbols mean.
"""

from __future__ import annotations

import functools
import zlib
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from thesis_pin.audit.judging.residuals import TROUBLES
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations import formula as nt
from thesis_pin.equations.evaluation import Environment, evaluate
from thesis_pin.equations.formula import Node, Symbol
from thesis_pin.equations.values import ZERO, Value, add, blocks, cross, multiply, transpose

_STATES = 3


class RandomSymbols:
    """An environment in which a symbol, or a derivative, is random but of its own shape.

    Args:
        references: What the shapes are taken from.
    """

    def __init__(self, references: Environment) -> None:
        self.columns, self._references = references.columns, references
        self._values: dict[tuple[object, ...], Value] = {}

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """A random value of the symbol's shape."""
        key = (symbol.name, symbol.dots, symbol.bold, indices.get("i", ""))
        if key not in self._values:
            self._values[key] = _like(self._references.lookup(symbol, indices), key)
        return self._values[key]

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """A derivative by the rules for sums and products; of a symbol, random of its shape."""
        if by is not None and not by.sub and by.base == "q":
            return self._atom(of, by, indices)  # by all coordinates: of another shape

        def d(part: Node) -> Value:
            return self.partial(part, by, indices)

        def value(part: Node) -> Value:
            return evaluate(part, self, indices)

        match of:
            case nt.Number():
                return ZERO
            case nt.Sum(terms) if all(sign in "+-" for sign, _ in terms):
                return _total(_signed(sign, d(term)) for sign, term in terms)
            case nt.Product(factors):
                return _total(
                    functools.reduce(
                        multiply, [(d if k == n else value)(f) for n, f in enumerate(factors)]
                    )
                    for k in range(len(factors))
                )
            case nt.Cross(left, right):
                return add(cross(d(left), value(right)), cross(value(left), d(right)))
            case nt.Transpose(inner):
                return transpose(d(inner))
            case nt.Matrix(rows):
                return blocks([[d(cell) for cell in row] for row in rows], self.columns)
        return self._atom(of, by, indices)

    def _atom(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        bound = of.bound(indices) if isinstance(of, Symbol) else of
        key = ("∂", bound, by, tuple(sorted(indices.items())))
        if key not in self._values:
            shape = evaluate(of, self._references, indices)
            value = self._references.partial(of, by, indices)
            if self._never_moves(of, by, value, indices):
                self._values[key] = ZERO
            else:
                self._values[key] = _like(value if value.rank >= 0 else shape, key)
        return self._values[key]

    def _never_moves(
        self, of: Node, by: Symbol | None, value: Value, indices: dict[str, str]
    ) -> bool:
        """Whether a derivative is zero by what its symbol is, and not for this robot's shape.

        A constant doesn't move by anything, coordinates not by each other, and a velocity
        depends on a rate if that joint, or another of its kind, comes before it on the way.
        """
        if value.array.any():
            return False
        by_one = by is not None and (by.base == "q" or self._is_coordinate(by))
        if by_one and isinstance(of, Symbol) and self._is_coordinate(of):
            return True
        if by is not None and by.dots:
            return True
        try:
            others = [self._references.partial(of, one, indices) for one in (None, _EACH)]
        except TROUBLES:
            return False
        return not any(other.array.any() for other in others)

    def _is_coordinate(self, symbol: Symbol) -> bool:
        """Whether a symbol, or what it is the rate of, can be differentiated by."""
        plain = replace(symbol, dots=0)
        try:
            own = self._references.partial(plain, plain, {})
        except TROUBLES:
            return False
        return own.rank == 0 and bool(np.all(own.array == 1.0))


_EACH = Symbol("q", "j")
"""Every coordinate at once."""


def _signed(sign: str, value: Value) -> Value:
    return value if sign == "+" else replace(value, array=-value.array)


def _total(values: Iterable[Value]) -> Value:
    return functools.reduce(add, values, ZERO)


def _like(value: Value, key: tuple[object, ...]) -> Value:
    """Random numbers in the shape and frames of a value.

    Entries that are one number at all states, as those of an axis in its own frame or
    the last row of a transform, are part of what the symbol is; a value that is zero
    at all states is free.
    """
    generator = np.random.default_rng(zlib.crc32(repr(key).encode()))
    array = generator.uniform(0.5, 2.0, (_STATES, *value.tail))
    array *= generator.choice([-1.0, 1.0], array.shape)
    if value.rank > 0 and value.array.any():
        states = value.array.reshape(-1, *value.tail)
        fixed = np.ptp(np.real(states), axis=0) < HOLDS
        array = np.where(fixed, np.real(states[0]), array)
    return Value(array, max(value.rank, 0), value.frames)
