"""Jacobians of the loop equations (appendix A)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from pollard_pin.thesis.state import CHAIN_0, POSE, Matrices, State, own_name
from pollard_pin.thesis.symbols.bodies import origin
from pollard_pin.thesis.symbols.motion import SIDE_I, MotionSymbols
from pollard_pin.thesis.symbols.rates import derivative
from thesis_pin.equations.formula import Symbol
from thesis_pin.equations.values import Value, matrix, vector

_ARM = CHAIN_0[:3]
_ROTATIONS = ("theta", "psi", "phi")


def _wrist(state: State, i: str) -> Matrices:
    return origin(state, "15")


def _wrist_of_tip(state: State, i: str) -> Matrices:
    """The wrist's place from the pose: the tip less the nozzle."""
    return state.transform("T_LD0")[..., :3, 3]


def _rod_end(state: State, i: str) -> Matrices:
    return origin(state, "8i", i)


def _ball(state: State, i: str) -> Matrices:
    return origin(state, "11i", i)


_Point = Callable[[State, str], Matrices]
_COLUMNS: dict[str, tuple[_Point, Sequence[str]]] = {
    "ABC": (_wrist, _ARM),
    "DEF": (_wrist_of_tip, _ROTATIONS),
    "GHI": (_rod_end, SIDE_I),
    "JKL": (_ball, _ARM),
}
_MATRICES: dict[str, tuple[_Point, Sequence[str]]] = {
    "theta": (_wrist, _ARM),
    "q": (_wrist_of_tip, POSE),
    "beta": (_rod_end, SIDE_I),
    **dict.fromkeys("123", (_ball, _ARM)),
}
"""By subscript; k, being an index elsewhere, arrives as each of its values."""


class AppendixA(MotionSymbols):
    """All symbols of appendix A at closed states."""

    def _slope(self, point: _Point, angle: str, i: str) -> np.ndarray:
        return derivative(lambda s: point(s, i), self.state, {own_name(angle, i): 1.0})

    def _of_r(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.name in ("r_p", "r_p^0"):
            return vector(origin(self.state, "p"))
        letter = symbol.sub[:-1] if i and symbol.sub == symbol.sub[:1] + i else ""
        for letters, (point, angles) in _COLUMNS.items():
            if letter and letter in letters:
                return vector(self._slope(point, angles[letters.index(letter)], i))
        return super()._of_r(symbol, i)

    def _of_J(self, symbol: Symbol, i: str) -> Value | None:
        known = _MATRICES.get(symbol.sub.removesuffix("i"))
        if known is None or not i or symbol.primes:
            return None
        point, angles = known
        columns = [self._slope(point, angle, i) for angle in angles]
        return matrix(np.stack(np.broadcast_arrays(*columns), axis=-1))

    def _of_I(self, symbol: Symbol, i: str) -> Value | None:
        return matrix(np.eye(3)) if symbol.sub == "3times3" else None
