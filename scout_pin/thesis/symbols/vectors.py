"""The thesis's own vectors u, s, t and e: columns of Jacobians and their rates."""

from __future__ import annotations

import re

import numpy as np

from scout_pin.thesis.state import COORDINATES
from scout_pin.thesis.symbols.geometry import JOINT_AXES
from scout_pin.thesis.symbols.motion import MotionSymbols
from thesis_pin.equations.formula import FormulaError, Symbol
from thesis_pin.equations.values import Value, vector

_FIRST_E = (1, 5, 10, 16, 23, 31, 40)  # number of the first vector e of each link


def e_column(number: int) -> tuple[int, int]:
    """Link n and column c (0: θ_B, 1: φ_B, 2: ψ_B, 3: θ_1i …) of the vector e_number."""
    for link in range(1, 7):
        if _FIRST_E[link - 1] <= number < _FIRST_E[link]:
            return link, number - _FIRST_E[link - 1]
    raise FormulaError(f"there is no vector e_{number}")


class Vectors(MotionSymbols):
    """u (3.12), s and t (3.21, 3.23), e (4.1)."""

    def _which(self, sub: str, i: str) -> tuple[int, int] | None:
        """Coordinate and leg of a vector called by its coordinate ("theta31", "phiB")."""
        name = re.sub(r"^(theta|phi|psi)", r"\1_", sub)
        if name not in COORDINATES:
            return None
        leg = i if sub.endswith("B") else sub[-1]
        return (COORDINATES.index(name), int(leg)) if leg in ("1", "2") else None

    def _of_u(self, symbol: Symbol, i: str) -> Value | None:
        which = self._which(symbol.sub, i)
        if which is None or symbol.sup != "0" or symbol.dots:
            return None
        return vector(self.state.point(f"7{which[1]}")[1][..., which[0]])

    def _of_t(self, symbol: Symbol, i: str) -> Value | None:
        """t = d/dt axis for a joint; for Euler angles (3.23) splits the same sum otherwise."""
        euler = re.fullmatch(r"(theta|phi|psi)(B|1|2)", symbol.sub)
        if symbol.sup != "0" or symbol.dots:
            return None
        if not euler:
            return self._axis_rate(symbol.sub)
        after = {"theta": ("phi", "j"), "phi": ("psi", "k"), "psi": ("theta", "k")}[euler[1]]
        by = "theta" if euler[1] == "psi" else euler[1]
        rate = self.lookup(Symbol(after[0], euler[2], dots=1), {}).array[..., None]
        if euler[2] == "B":
            vary = self.partial(
                Symbol(after[1], {"j": "phiB", "k": "psiB"}[after[1]], "0", bold=True),
                Symbol(by, "B"),
                {},
            ).array
        else:
            vary = self._foot_axis_derivative(int(euler[2]), "xyz".index("yz"[after[1] == "k"]), by)
        return vector(rate * vary)

    def _foot_axis_derivative(self, i: int, column: int, by: str) -> np.ndarray:
        angles = self._foot_angles(i)
        theta, phi = angles[..., 0], angles[..., 1]
        zero = np.zeros_like(theta)
        if column == 1:  # ∂j_φ/∂θ
            parts = [zero, -np.sin(theta), np.cos(theta)]
        elif by == "theta":  # ∂k_ψ/∂θ
            parts = [zero, -np.cos(theta) * np.cos(phi), -np.sin(theta) * np.cos(phi)]
        else:  # ∂k_ψ/∂φ
            parts = [np.cos(phi), np.sin(theta) * np.sin(phi), -np.cos(theta) * np.sin(phi)]
        return np.stack(parts, axis=-1)

    def _axis_rate(self, sub: str) -> Value | None:
        which = self._which(sub, "")
        if which is None:
            return None
        joint = which[0] - 5 - 6 * (which[1] - 1)
        letter, number = next((k[0], k[1:]) for k, n in JOINT_AXES.items() if n == joint)
        return self.partial(Symbol(letter, f"{number}{which[1]}", "0", bold=True), None, {})

    def _of_s(self, symbol: Symbol, i: str) -> Value | None:
        """s = d/dt u for a joint; for the torso t × (p_i − p_B) plus axis × its rate."""
        which = self._which(symbol.sub, i)
        if which is None or symbol.sup != "0" or symbol.dots:
            return None
        if which[0] >= 6:
            return self.partial(Symbol("u", symbol.sub, "0", bold=True), None, {})
        (foot, J), (torso, K) = self.state.point(f"7{which[1]}"), self.state.point("B")
        rate = ((J - K) @ self.state.v[..., None])[..., 0]
        t = self.lookup(Symbol("t", symbol.sub, "0", bold=True), {}).array
        axis = self.state.torso[-1].axis(which[0])
        return vector(np.cross(t, foot - torso) + np.cross(axis, rate))

    def _of_e(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup != "0" or symbol.dots:
            return None
        euler = re.fullmatch(r"(theta|phi|psi)B", symbol.sub)
        if euler:
            k = COORDINATES.index(f"{euler[1]}_B")
            return vector(self.state.centre("B")[1][..., k])
        numbered = re.fullmatch(r"(\d{1,2})([12])", symbol.sub)
        if not numbered:
            return None
        link, column = e_column(int(numbered[1]))
        k = 3 + column if column < 3 else 6 * int(numbered[2]) + column - 3
        return vector(self.state.centre(f"{link}{numbered[2]}")[1][..., k])
