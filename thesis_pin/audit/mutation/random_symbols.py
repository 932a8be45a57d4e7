"""Symbols that are nothing but random numbers of their shapes, each free of all others.

Two formulas that are equal here are equal whatever their symbols mean.
"""

from __future__ import annotations

import zlib

import numpy as np

from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.evaluation import Environment, evaluate
from thesis_pin.equations.formula import Node, Symbol
from thesis_pin.equations.values import Value

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
        """A random value of the derivative's shape: of what is derived and by what."""
        bound = of.bound(indices) if isinstance(of, Symbol) else of
        key = ("∂", bound, by, tuple(sorted(indices.items())))
        if key not in self._values:
            shape = evaluate(of, self._references, indices)
            value = self._references.partial(of, by, indices)
            self._values[key] = _like(value if value.rank >= 0 else shape, key)
        return self._values[key]


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
