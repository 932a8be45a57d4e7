"""Loop vectors of which nothing is known but that two and two are equally long.

On closed loops Ec_1 = Ec_2 and Ec_3 = Ec_4, so that a line that says how their lengths are equal
holds with one in the other's place. Here each points anywhere.

Source: Pollard thesis, (2.5) to (2.7), (2.92) to (2.94).
"""

from __future__ import annotations

import re

import numpy as np

from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.values import Value, vector

_STATES, _SEED = 4, 205


class Lengths:
    """Ec_1 as long as Ec_2, Ec_3 as long as Ec_4."""

    columns = 6

    def __init__(self) -> None:
        generator = np.random.default_rng(_SEED)
        drawn = generator.uniform(0.1, 1.0, (2, 2, _STATES, 3))  # all products are positive
        size = generator.uniform(0.5, 2.0, (2, 1, _STATES, 1))
        pairs = size * drawn / np.linalg.norm(drawn, axis=-1, keepdims=True)
        self._vectors = pairs.reshape(4, _STATES, 3)

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """One of the four; nothing else is known here."""
        found = re.fullmatch(r"Ec_([1-4])", symbol.name)
        if not found or symbol.dots:
            raise FormulaError(f"{symbol.name} isn't one of the loops' vectors")
        return vector(self._vectors[int(found[1]) - 1])

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Nothing moves."""
        raise FormulaError("the loops' vectors are still here")
