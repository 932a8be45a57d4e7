"""What checks in code share: formulas evaluated with a few named values.

A number, sign or symbol printed in the thesis is read from its equation, not repeated here.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pollard_pin.model import load
from pollard_pin.thesis.references import References
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation, index_values
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.values import Value, scalar

Check = Callable[[Catalogue, References, Equation], ClaimResult]
"""The equations, what symbols must equal at closed states, the one to judge → its residuals."""

thesis_robot = functools.cache(load)
"""The thesis's robot, loaded once."""


class Given:
    """An environment of a few named values; a dot of a symbol is a "." behind its name."""

    columns = 6

    def __init__(self, **values: float | np.ndarray | Value) -> None:
        self.values = values

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol."""
        name = replace(symbol, kept="").bound(indices).name + "." * symbol.dots
        if name not in self.values:
            raise FormulaError(f"the symbol {name} isn't given")
        value = self.values[name]
        return value if isinstance(value, Value) else scalar(value)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Nothing here moves."""
        raise FormulaError("a derivative of given numbers")


def value_of(catalogue: Catalogue, text: str, given: Given) -> np.ndarray:
    """Value of a printed formula; a side chain's is that of chain 1."""
    node = catalogue.parse(text)
    indices = next(index_values(node))
    return evaluate(node, given, indices).array


def names_in(catalogue: Catalogue, text: str) -> tuple[str, ...]:
    """Names of the symbols of a list: "(b, g)" → ("b", "g").

    Raises:
        FormulaError: A part of the list isn't a symbol.
    """
    parts = text.strip().removeprefix("(").removesuffix(")").split(",")
    symbols = (catalogue.notation.symbol(part) for part in parts)
    return tuple(replace(one, kept="").name + "." * one.dots for one in symbols)
