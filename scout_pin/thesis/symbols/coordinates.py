"""Coordinates, their rates, constants, and what differs in Scout's derivatives (4.1, 4.2)."""

from __future__ import annotations

from dataclasses import replace
from typing import Self

import numpy as np

from scout_pin.thesis.state import BODIES, COORDINATES, State, coordinate_index
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.frames import rows
from thesis_pin.equations.symbols import Symbols
from thesis_pin.equations.values import ZERO, Value, scalar, vector
from thesis_pin.tolerances import GRAVITY

# Arguments in the definitions of functions, as in T_z1(x): any number will do.
DUMMIES = {"x": 0.3, "y": -0.7, "z": 1.1, "theta_x": 0.4, "theta_y": -0.9, "theta_z": 1.3}
DUMMIES |= {"alpha": 0.5, "beta": -1.2, "gamma": 0.8}


class Coordinates(Symbols):
    """Coordinates and constants at a batch of states, and derivatives of any formula."""

    columns = 18

    def __init__(self, state: State) -> None:
        super().__init__()
        self.state = state
        self._beside: dict[tuple[str | None, bool], list[Coordinates]] = {}

    def _find(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.name in DUMMIES and symbol.dots < 2:
            return scalar(DUMMIES[symbol.name] * (-2.0 if symbol.dots else 1.0))
        return super()._find(symbol, i)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative of a formula by a coordinate, a rate or time."""
        special = self._special_derivative(of, by)
        if special is not None:
            return special
        if isinstance(of, Symbol) and of.name == "q" and by is not None:
            return self._unit(by) if of.dots == by.dots else ZERO
        if by is not None and by.dots > 1:
            raise FormulaError("differentiates by an acceleration")
        if by is not None and by.name == "q":
            columns = self.partial(of, Symbol("q", "j", dots=by.dots), indices)
            swapped = np.swapaxes(columns.array, 1, -1)[:, None]
            return Value(swapped, 2, rows(columns.frames))
        if self.state.perturbed:
            along, rates = None if by is None else by.name, bool(by and by.dots)
            return self._difference(of, along, rates, indices)
        return super().partial(of, by, indices)

    def _special_derivative(self, of: Node, by: Symbol | None) -> Value | None:
        """A derivative that is known without a step."""
        return None

    def _difference(
        self, of: Node, along: str | None, rates: bool, indices: dict[str, str]
    ) -> Value:
        """A derivative inside a derivative, which only misprints need: central difference."""
        if (along, rates) not in self._beside:
            self._beside[along, rates] = [
                type(self)(self.state.step(along, rates, size)) for size in (1e-6, -1e-6)
            ]
        ends = [evaluate(of, end, indices) for end in self._beside[along, rates]]
        if ends[0].rank == -1:
            return ZERO
        return replace(ends[0], array=(ends[0].array - ends[1].array) / 2e-6)

    def _unit(self, by: Symbol) -> Value:
        """∂q/∂q_j: the unit vectors, with j along axis 1."""
        if by.sub == "j":
            return vector(np.eye(18)[None])
        return vector(np.eye(18)[coordinate_index(by.name)][None, None])

    def _stepped(self, along: str | None, rates: bool) -> Self:
        return type(self)(self.state.step(along, rates))

    def _coordinate(self, name: str, dots: int) -> Value | None:
        if dots > 2 or name not in COORDINATES:
            return None
        series = (self.state.q, self.state.v, self.state.a)[dots]
        return scalar(series[..., COORDINATES.index(name)])

    def _constant(self, name: str) -> Value | None:
        found = self.state.parameters.values.get(name)
        return None if found is None else Value(found, found.ndim - 2)

    def _of_q(self, symbol: Symbol, i: str) -> Value | None:
        s = self.state
        series = (s.q, s.v, s.a)[symbol.dots] if symbol.dots < 3 else None
        if series is None or symbol.sup:
            return None
        if not symbol.sub:
            return vector(series)
        if symbol.sub == "j":
            return scalar(series if series.shape[1] == 1 else np.einsum("njj->nj", series))
        return scalar(series[..., coordinate_index(f"q_{symbol.sub}")])

    def _of_beta(self, symbol: Symbol, i: str) -> Value | None:
        return ZERO if symbol.dots else self._constant(symbol.name)

    def _of_m(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots:
            return None
        if symbol.sub == "T":
            return scalar(sum(self.state.parameters.values[f"m_{body}"] for body in BODIES))
        return self._constant(symbol.name)

    def _of_b1(self, symbol: Symbol, i: str) -> Value | None:
        return ZERO if symbol.dots else self._constant(symbol.name)

    _of_b2 = _of_b1

    def _of_g(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub or symbol.sup or symbol.dots:
            return None
        if not symbol.bold:
            return scalar(GRAVITY)
        return vector(-GRAVITY * np.atleast_2d(self.state.own("k0"))[..., None, :])
