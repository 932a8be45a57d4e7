"""Lines that name the elements of a matrix, held with a matrix of which none vanishes.

The last row of a transform is 0, 0, 0, 1, so that a slip in a_41 shows nowhere.

Source: Pollard thesis, (2.26), (2.30), (2.44), (2.110), (2.128).
"""

from __future__ import annotations

import re

import numpy as np

from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.values import Value, matrix, scalar

_NAMED = re.compile(r"\s*\\begin\{bmatrix\}[^&]*\b([a-f])_\{11\} &.*\\end\{bmatrix\}\s*", re.DOTALL)
_LAST = r"0 & 0 & 0 & 1 \end{bmatrix}"
_STATES, _SEED = 4, 226


class Elements:
    """A free matrix and its elements.

    Args:
        whole: What the matrix is called.
        letter: What its elements are.
        transform: Whether its last row is printed as 0, 0, 0, 1.
    """

    columns = 6

    def __init__(self, whole: Symbol, letter: str, *, transform: bool) -> None:
        self.whole, self.letter = whole, letter
        self._matrix = np.random.default_rng(_SEED).uniform(0.5, 2.0, (_STATES, 4, 4))
        if transform:
            self._matrix[:, 3] = 0, 0, 0, 1

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """The matrix or one of its elements; nothing else is known here."""
        if symbol == self.whole.bound(indices):
            return matrix(self._matrix)
        place = re.fullmatch(r"([1-4])([1-4])", symbol.sub)
        if symbol.base != self.letter or not place or symbol.dots or symbol.sup:
            raise FormulaError(f"{symbol.name} isn't an element of {self.whole.name}")
        return scalar(self._matrix[:, int(place[1]) - 1, int(place[2]) - 1])

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Nothing moves."""
        raise FormulaError("elements are numbers here")


def elements(catalogue: Catalogue, equation: Equation) -> Environment | None:
    """Where a line that names a matrix's elements has to hold besides; None for all others."""
    if len(equation.printed) != 1 or equation.claim:
        return None
    found = _NAMED.fullmatch(equation.printed[0])
    left = _symbol(catalogue, equation.left)
    if not found or not left:
        return None
    return Elements(left, found[1], transform=_LAST in equation.printed[0])


def _symbol(catalogue: Catalogue, text: str) -> Symbol | None:
    try:
        return catalogue.notation.symbol(text)
    except FormulaError:
        return None
