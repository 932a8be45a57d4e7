"""Sides of the loops, their elements, rates and accelerations (2.4 to 2.9, appendices C to E)."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable

import numpy as np

from pollard_pin.thesis.state import TRANSFORMS, VARIABLES, State
from pollard_pin.thesis.symbols import accelerations
from pollard_pin.thesis.symbols.loops import between, element, frame, opening, side
from pollard_pin.thesis.symbols.rates import coefficient
from thesis_pin.equations.formula import Symbol
from thesis_pin.equations.symbols import Symbols
from thesis_pin.equations.values import STEP, Value, matrix, scalar, vector

_LAST = np.array([0.0, 0.0, 0.0, 1.0])


class Positions(Symbols):
    """Symbols of chapter 2, whose formulas hold on open states too."""

    def __init__(self, state: State) -> None:
        super().__init__()
        self.state = state
        self._circles: dict[str, accelerations.Circle] = {}

    @functools.cached_property
    def _later(self) -> State:
        """The states one imaginary step of time away."""
        return self.state.step(dict(self.state.rates))

    def _find(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots == 1:
            return self._rate(symbol, i)
        if symbol.dots == 2:
            return self._acceleration(symbol, i)
        if symbol.dots:
            return None
        return both_chains(self.state, symbol.name, i)

    def _rate(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.name in VARIABLES:
            return scalar(self.state.rates[symbol.name])
        moved = both_chains(self._later, symbol.name, i)
        if moved is None:
            return None
        return Value(np.imag(moved.array) / STEP, moved.rank)

    def _acceleration(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.name in VARIABLES:
            return scalar(self.state.accelerations[symbol.name])
        if re.match("[VEG]_", symbol.name):  # themselves derivatives
            return None
        if i not in self._circles:
            self._circles[i] = accelerations.Circle(self.state, i)
        circle = self._circles[i]
        moved = find(circle.state, symbol.name, i)
        if moved is None:
            return None
        return Value(circle.derivative(moved.array, 2, -1 - moved.rank), moved.rank)


def both_chains(state: State, name: str, i: str) -> Value | None:
    """Reference of a symbol; where it is a side chain's and none is named, of both.

    V_44 onwards and E_31 onwards carry no i: their values then have a batch axis more.
    """
    value = find(state, name, i)
    if value is not None or i:
        return value
    pair = [find(state, name, k) for k in "12"]
    if pair[0] is None or pair[1] is None:
        return None
    return Value(np.stack([pair[0].array, pair[1].array]), pair[0].rank)


def find(state: State, name: str, i: str) -> Value | None:
    """Reference of an undotted symbol at states, real or complex; None if there is none."""
    if name == "signo":
        return scalar(state.constants[f"signo{i}"]) if i else None
    if name in state.variables or name in state.constants:
        return scalar(state.number(name))
    if name == "n":
        return vector(_LAST)
    for pattern, answer in ANSWERS:
        match = re.fullmatch(pattern, name)
        if match:
            return answer(state, i, *match.groups())
    return None


def _transform(state: State, _: str, name: str) -> Value | None:
    """T by its printed name: a chain's number stands at the end."""
    if name in TRANSFORMS or name == "T_LD0":
        return matrix(state.transform(name))
    made = frame(state, name)
    if made is not None:
        return matrix(made)
    if f"{name[:-1]}i" in TRANSFORMS:
        return matrix(state.transform(f"{name[:-1]}i", name[-1]))
    return None


def _element(state: State, i: str, letter: str, row: str, column: str) -> Value | None:
    found = element(state, letter, i, int(row), int(column))
    return None if found is None else scalar(found)


def _fourier(state: State, _: str, letter: str, kind: str) -> Value:
    """A, B, C with opening = C + A cos θ + B sin θ."""
    i = "" if kind == "0" else kind
    at = {
        turn: opening(state.with_(**{f"theta_21{i}": np.full(state.shape, turn * np.pi / 2)}), i)
        for turn in (-1, 0, 1, 2)
    }
    values = {"A": at[0] - at[2], "B": at[1] - at[-1], "C": at[0] + at[2]}
    return scalar(values[letter] / 2)


def _coordinate(state: State, _: str, letter: str, i: str | None) -> Value:
    return scalar(side(state, 4 if i else 2, i or "")[..., "XYZ".index(letter)])


def _side(state: State, i: str, k: str) -> Value | None:
    return vector(side(state, int(k), i)) if int(k) < 3 or i else None


def _coefficient(state: State, i: str, name: str) -> Value | None:
    of = accelerations.coefficient if name.startswith("G") else coefficient
    found = of(state, name, i)
    return None if found is None else scalar(found)


def _radius(state: State, i: str, name: str) -> Value | None:
    """r_ab of (2.1) and its like: from origin b to origin a, in the base frame."""
    found = between(state, name, i)
    return None if found is None else vector(found)


_Answer = Callable[..., Value | None]
ANSWERS: tuple[tuple[str, _Answer], ...] = (
    (r"(T_\w+)", _transform),
    (r"([a-f])_([1-4])([1-4])", _element),
    (r"([ABC])_1([012])", _fourier),
    (r"([XYZ])(?:_([12]))?", _coordinate),
    (r"Ec_([1-4])", _side),
    (r"([VEG]_\d+)", _coefficient),
    (r"r_(\d+)(?:\^0)?", _radius),
)
"""Pattern of a symbol's name → what answers it: (state, chain, the pattern's groups)."""
