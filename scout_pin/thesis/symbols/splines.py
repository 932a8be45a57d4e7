"""Quadratic splines of appendix C: nodes, coefficients, pieces and their rates."""

from __future__ import annotations

import re
from functools import cached_property
from typing import Self

import numpy as np

from thesis_pin.equations.formula import Symbol
from thesis_pin.equations.symbols import Symbols
from thesis_pin.equations.values import STEP, Value, scalar

PIECES = 5
"""m: enough that its first, second, third and last piece are different ones."""
_SPLINES, _SEED = 12, 90817


class Splines(Symbols):
    """Random splines, each at a random instant of its own.

    Coefficients follow from the slopes at the nodes, one after the other: a parabola's
    mean slope is that of its chord. The system that the thesis solves isn't used.

    Args:
        straight: Whether the first piece is, as (C.5) has it; all else holds either way.
        later: Step that the instant has made, imaginary in a derivative.
    """

    def __init__(self, straight: bool = False, later: complex = 0.0) -> None:
        super().__init__()
        self.straight = straight
        generator = np.random.default_rng(_SEED)
        self.nodes = np.cumsum(generator.uniform(0.5, 2.0, (_SPLINES, PIECES + 1)), axis=1)
        self.values = generator.uniform(-2.0, 2.0, (_SPLINES, PIECES + 1))
        self.t = generator.uniform(self.nodes[:, 0], self.nodes[:, -1]) + later
        self.slopes = generator.uniform(-1.0, 1.0, _SPLINES)

    @cached_property
    def coefficients(self) -> np.ndarray:
        """Of t², t, 1; shape ``(splines, pieces, 3)``."""
        slopes = None if self.straight else self.slopes
        return spline_coefficients(self.nodes, self.values, slopes)

    def _stepped(self, along: str | None, rates: bool) -> Self:
        if along is not None:
            return super()._stepped(along, rates)
        return type(self)(self.straight, 1j * STEP)

    def _numbered(self, symbol: Symbol, first: int, last: int) -> int | None:
        """Number that a subscript says ("2", "m-1"), if there is one of that number."""
        found = re.fullmatch(r"(\d+|m)(?:([+-])(\d+))?", symbol.sub)
        if not found or symbol.sup or symbol.bold or symbol.primes:
            return None
        number = PIECES if found[1] == "m" else int(found[1])
        number += int(found[3]) * (1 if found[2] == "+" else -1) if found[2] else 0
        return number if first <= number <= last else None

    def _differentiated(self, symbol: Symbol, i: str) -> Value | None:
        """Only pieces have a rate: nodes, coefficients and the instant itself have none."""
        return super()._differentiated(symbol, i) if symbol.base == "S" else None

    def _of_t(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots:
            return None
        if not symbol.sub:
            return scalar(self.t)
        number = self._numbered(symbol, 0, PIECES)
        return None if number is None else scalar(self.nodes[:, number])

    def _of_f(self, symbol: Symbol, i: str) -> Value | None:
        number = self._numbered(symbol, 0, PIECES)
        return None if number is None or symbol.dots else scalar(self.values[:, number])

    def _of_a(self, symbol: Symbol, i: str) -> Value | None:
        number = self._numbered(symbol, 1, PIECES)
        if number is None or symbol.dots:
            return None
        return scalar(self.coefficients[:, number - 1, "abc".index(symbol.base)])

    _of_b = _of_c = _of_a

    def _of_m(self, symbol: Symbol, i: str) -> Value | None:
        return None if symbol.sub or symbol.sup or symbol.dots else scalar(float(PIECES))

    def _of_S(self, symbol: Symbol, i: str) -> Value | None:
        number = self._numbered(symbol, 1, PIECES)
        if number is None or symbol.dots:
            return None
        a, b, c = np.moveaxis(self.coefficients[:, number - 1], -1, 0)
        return scalar((a * self.t + b) * self.t + c)


def spline_coefficients(
    nodes: np.ndarray, values: np.ndarray, slope: np.ndarray | None = None
) -> np.ndarray:
    """Coefficients of a quadratic spline.

    Args:
        nodes: Where the pieces meet, rising, shape ``(..., m + 1)``.
        values: What the spline is there, of the same shape.
        slope: Its rate at the first node, shape ``(...)``; None for a straight first piece.

    Returns:
        Of t², t, 1; shape ``(..., m, 3)``.

    Source: Scout thesis, appendix C.
    """
    widths = np.diff(nodes)
    chords = np.diff(values) / widths
    slope, found = chords[..., 0] if slope is None else slope, []
    for k in range(widths.shape[-1]):
        a = (chords[..., k] - slope) / widths[..., k]
        b = slope - 2 * a * nodes[..., k]
        found.append(np.stack([a, b, values[..., k] - (a * nodes[..., k] + b) * nodes[..., k]], -1))
        slope = 2 * chords[..., k] - slope
    return np.stack(found, axis=-2)
