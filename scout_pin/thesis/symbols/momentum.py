"""Momentum of the whole robot and its zero-moment point (6.2)."""

from __future__ import annotations

import numpy as np

from scout_pin.thesis.state import BODIES
from scout_pin.thesis.symbols.dynamics import Dynamics
from scout_pin.thesis.symbols.motion import component
from thesis_pin.equations.dual import vee
from thesis_pin.equations.formula import Symbol
from thesis_pin.equations.values import STEP, Value, scalar, vector
from thesis_pin.tolerances import GRAVITY

_FLOOR = 0.01  # m, a floor that isn't at the origin's height


class Momentum(Dynamics):
    """𝒫, ℒ, p_ZMP."""

    def _of_cal_P(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.sub not in ("", "x", "y", "z"):
            return None
        total = sum(
            self.state.parameters.values[f"m_{body}"][..., None]
            * self._moving(self.state.centre(body), 1)
            for body in BODIES
        )
        return component(np.asarray(total), symbol.sub)

    def _of_cal_L(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.sub not in ("", "x", "y", "z"):
            return None
        total: np.ndarray | float = 0.0
        for body in BODIES:
            where, rate = (self._moving(self.state.centre(body), k) for k in (0, 1))
            mass = self.state.parameters.values[f"m_{body}"][..., None]
            omega = vee(self._rate(self.state.frame(body)))
            spin = (self.state.inertia(body) @ omega[..., None])[..., 0]
            total = total + np.cross(where, mass * rate) + spin
        return component(np.asarray(total), symbol.sub)

    def _floor_wrench(self) -> tuple[np.ndarray, np.ndarray]:
        """Force and moment about O that the floor exerts in all, shape ``(N, J, 3)`` each."""
        later = self.moved(None)
        force: np.ndarray | float = 0.0
        moment: np.ndarray | float = 0.0
        for body in BODIES:
            mass = self.state.parameters.values[f"m_{body}"][..., None]
            where = self.state.centre(body)[0]
            fast = np.imag(later._moving(later.state.centre(body), 1)) / STEP
            omega = vee(later._rate(later.state.frame(body)))
            turn = np.imag((later.state.inertia(body) @ omega[..., None])[..., 0]) / STEP
            inertial = mass * (fast + np.array([0.0, 0.0, GRAVITY]))
            force = force + inertial
            moment = moment + np.cross(where, inertial) + turn
        return np.asarray(force), np.asarray(moment)

    def _of_ZMP(self, symbol: Symbol, i: str) -> Value | None:
        """The point of a floor where its wrench has no tilting moment, by components."""
        if symbol.sub == "z":
            return scalar(_FLOOR)
        if symbol.sub not in ("x", "y"):
            return None
        force, moment = self._floor_wrench()
        if symbol.sub == "x":
            return scalar((_FLOOR * force[..., 0] - moment[..., 1]) / force[..., 2])
        return scalar((_FLOOR * force[..., 1] + moment[..., 0]) / force[..., 2])

    def _of_p(self, symbol: Symbol, i: str) -> Value | None:
        """The same point as a vector: k × (the moment about where O's vertical meets the floor)."""
        if symbol.name != "p_ZMP" or symbol.dots:
            return None
        force, moment = self._floor_wrench()
        up = np.array([0.0, 0.0, 1.0])
        there = moment - np.cross(_FLOOR * up, force)
        return vector(_FLOOR * up + np.cross(up, there) / (force @ up)[..., None])
