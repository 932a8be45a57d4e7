"""What every thesis's references are built on: look-up of symbols, exact derivatives.

A thesis's classes answer a symbol with base letter ``e`` in a method ``_of_e``
("delta:q" in ``_of_delta_q``). A dot or ∂ that no method knows is a complex step.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Self

from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.frames import ANY, Frames
from thesis_pin.equations.values import Value, imaginary


class Symbols:
    """Symbols at a batch of states; an :class:`~thesis_pin.equations.evaluation.Environment`.

    Attributes:
        columns: Number of generalized coordinates that short rows are filled up to.
    """

    columns = 0

    def __init__(self) -> None:
        self._values: dict[tuple[str, int, str], Value] = {}
        self._moved: dict[tuple[str | None, bool], Self] = {}

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol whose indices are bound.

        Raises:
            FormulaError: The symbol isn't defined.
        """
        i = indices.get("i", "")
        key = (symbol.name + "*" * symbol.bold, symbol.dots, i)
        if key not in self._values:
            value = self._find(symbol, i)
            if value is None:
                dots = "˙" * symbol.dots
                raise FormulaError(f"the symbol {symbol.name}{dots} isn't defined anywhere")
            self._values[key] = value.within(self._frames(symbol, value, i))
        return self._values[key]

    def turning(self, axis: str, argument: Node, indices: dict[str, str]) -> Frames:
        """Frames of a rotation by a formula about "x", "y" or "z": ANY if no joint turns so."""
        return ANY

    def _frames(self, symbol: Symbol, value: Value, i: str) -> Frames:
        """What a symbol's value is seen from or turns between."""
        return value.frames

    def _find(self, symbol: Symbol, i: str) -> Value | None:
        """Value of a symbol on leg or chain i; None if it isn't defined."""
        value = self._answer(symbol, i)
        return self._differentiated(symbol, i) if value is None else value

    def _answer(self, symbol: Symbol, i: str) -> Value | None:
        """What the method for a symbol's letter says."""
        method = getattr(self, "_of_" + symbol.base.replace(":", "_"), None)
        value: Value | None = method(symbol, i) if method else None
        return value

    def _differentiated(self, symbol: Symbol, i: str) -> Value | None:
        """A dotted symbol as the time derivative of the one with a dot less."""
        if not symbol.dots:
            return None
        return self.partial(replace(symbol, dots=symbol.dots - 1), None, numbered(i))

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative of a formula by a coordinate or its rate, or by time if ``by`` is None."""
        along = None if by is None else by.name
        refuse_accelerations(by)
        return imaginary(evaluate(of, self.moved(along, bool(by and by.dots)), indices))

    def moved(self, along: str | None, rates: bool = False) -> Self:
        """The same symbols one imaginary step along a coordinate, its rate, or time."""
        key = (along, rates)
        if key not in self._moved:
            self._moved[key] = self._stepped(*key)
        return self._moved[key]

    def _stepped(self, along: str | None, rates: bool) -> Self:
        raise FormulaError("a derivative of a formula has no reference")


def refuse_accelerations(by: Symbol | None) -> None:
    """Nothing here is a function of accelerations: a derivative by one is a slip.

    Raises:
        FormulaError: The symbol has two dots.
    """
    if by is not None and by.dots > 1:
        raise FormulaError(f"differentiates by {by.name} with {by.dots} dots")


def numbered(i: str) -> dict[str, str]:
    """Indices of a formula on leg or chain i, or on none."""
    return {"i": i} if i else {}
