"""Actuation, virtual work and the constraints of the feet (4.5, 4.6)."""

from __future__ import annotations

import numpy as np

from scout_pin.thesis.state import BODIES, coordinate_index
from scout_pin.thesis.symbols.dynamics import element
from scout_pin.thesis.symbols.momentum import Momentum
from thesis_pin.equations.formula import Symbol
from thesis_pin.equations.values import Value, matrix, scalar, vector


def matrix_entry(digits: str) -> tuple[int, int] | None:
    """Row and column, from 0, of an entry of A_τ called "410" (4, 10) or "1310" (13, 10).

    Only rows 4 to 18 and columns 1 to 12 are printed, which makes the names unique.
    """
    for width in (1, 2):
        row, column = digits[:width], digits[width:]
        if not (row + column).isdigit() or not column or column[0] == "0":
            continue
        if 4 <= int(row) <= 18 and int(column) <= 12:
            return int(row) - 1, int(column) - 1
    return None


_PLAIN = frozenset(
    {
        *("bb:D", "bb:V", "bb:C", "A", "ZMP"),
        *(f"delta:{x}" for x in ("q", "theta", "phi", "psi", "x", "y", "z", "W")),
    }
)
"""Letters that the thesis writes without dots, primes and frames: with one they are others."""
_PRIMED = frozenset({"V", "C"})


class Forces(Momentum):
    """A_τ, δW, Q, τ, φ, Φ, λ, Γ."""

    def _answer(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.base in _PLAIN and (symbol.dots or symbol.sup):
            return None
        if symbol.primes and symbol.base not in _PRIMED:
            return None
        return super()._answer(symbol, i)

    def _of_tau(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup == "0" and symbol.sub in BODIES[1:] and not symbol.dots:
            joint = 6 * (int(symbol.sub[1]) - 1) + int(symbol.sub[0])
            axis = self.state.frame(symbol.sub).axis(5 + joint)
            return vector(self.state.tau[..., joint - 1, None] * axis)
        if symbol.dots or symbol.sup:
            return None
        if not symbol.sub:
            return vector(self.state.tau)
        return scalar(self.state.tau[..., coordinate_index(f"theta_{symbol.sub}") - 6])

    def _of_A(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots:
            return None
        if symbol.bold and symbol.sub in ("1", "2"):
            return vector(self._foot_side(int(symbol.sub), rates=False))
        full = np.vstack([np.zeros((6, 12)), np.eye(12)])
        if symbol.sub == "tau":
            return matrix(full[None, None])
        entry = matrix_entry(symbol.sub)
        return None if entry is None else scalar(full[None, None, entry[0], entry[1]])

    def _of_delta_q(self, symbol: Symbol, i: str) -> Value | None:
        if not symbol.sub:
            return vector(self.state.virtual)
        if symbol.sub == "j":
            return None
        return scalar(self.state.virtual[..., coordinate_index(f"q_{symbol.sub}")])

    def _of_delta_theta(self, symbol: Symbol, i: str) -> Value | None:
        name = f"{symbol.base.removeprefix('delta:')}_{symbol.sub}"
        return scalar(self.state.virtual[..., coordinate_index(name)])

    _of_delta_phi = _of_delta_psi = _of_delta_theta
    _of_delta_x = _of_delta_y = _of_delta_z = _of_delta_theta

    def _of_delta_Q(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup != "0" or symbol.sub not in BODIES or symbol.dots:
            return None
        turned = self.state.angular(symbol.sub) @ self.state.virtual[..., None]
        return vector(turned[..., 0])

    def _of_delta_W(self, symbol: Symbol, i: str) -> Value | None:
        return scalar((self.state.tau * self.state.virtual[..., 6:]).sum(-1))

    def _of_Q(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup or symbol.dots:
            return None
        torso = np.zeros((*self.state.tau.shape[:-1], 6))
        return element(np.concatenate([torso, self.state.tau], axis=-1), symbol.sub)

    def _of_l(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub not in ("1", "2") or symbol.sup != "0" or symbol.dots:
            return None
        length = self.state.parameters.values[f"b{symbol.sub}_y"][..., None]
        return vector(length * self.state.turned(f"7{symbol.sub}", f"j14{symbol.sub}"))

    def constraint(self, number: int, interval: int) -> np.ndarray:
        """φ_number of interval T_interval, as (4.15), (4.19), (4.21) say in words.

        1 to 3: components k, j (less the length), i of l; 4 and 5: components j and
        k of the axis of joint 5; 6: component k of link 6's k axis. The right foot
        in T_3, and from 7 on in T_2.
        """
        right = interval == 3 or number > 6
        i, which = (2 if right else 1), (number - 1) % 6 + 1
        if which <= 3:
            axis = self.state.own({1: "k0", 2: "j0", 3: "i0"}[which])
            vector_l = self._of_l(Symbol("l", str(i), "0"), "")
            assert vector_l
            offset = self.state.parameters.values[f"b{i}_y"] if which == 2 else 0.0
            return np.asarray((vector_l.array * axis).sum(axis=-1) - offset)
        if which <= 5:
            turning = self._axis(f"k8{i}")
            assert turning is not None
            return np.asarray((turning * self.state.own({4: "j0", 5: "k0"}[which])).sum(axis=-1))
        upright = self.state.turned(f"6{i}", f"k11{i}")
        return np.asarray((upright * self.state.own("k0")).sum(axis=-1))

    def _of_varphi(self, symbol: Symbol, i: str) -> Value | None:
        limits = {"1": 6, "2": 12, "3": 6}
        if symbol.dots or symbol.sup not in limits or not symbol.sub.isdigit():
            return None
        if not 1 <= int(symbol.sub) <= limits[symbol.sup]:
            return None
        return scalar(self.constraint(int(symbol.sub), int(symbol.sup)))

    def stance_jacobian(self, interval: int) -> np.ndarray:
        """∂(pose of the stance feet)/∂q, shape ``(N, J, 6 or 12, 18)``.

        Linear, then angular rows of each foot, left first.
        """
        rows = []
        for i in {1: (1,), 2: (1, 2), 3: (2,)}[interval]:
            rows += [self.state.point(f"7{i}")[1], self.state.angular(f"7{i}")]
        return np.concatenate(rows, axis=-2)

    def _of_Phi(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub not in ("1", "2", "3") or symbol.sup != "0" or symbol.dots:
            return None
        interval = int(symbol.sub)
        rows = [self.constraint(k, interval) for k in range(1, 13 if interval == 2 else 7)]
        return vector(np.stack(np.broadcast_arrays(*rows), axis=-1))

    def _of_lambda(self, symbol: Symbol, i: str) -> Value | None:
        """λ_k^0 with all its elements, or element n of it, which is λ_n^k."""
        interval = symbol.sub if symbol.sup == "0" else symbol.sup
        if symbol.dots or interval not in ("1", "2", "3"):
            return None
        multipliers = self.state.multipliers[..., : 12 if interval == "2" else 6]
        return vector(multipliers) if symbol.sup == "0" else element(multipliers, symbol.sub)

    def _of_Gamma(self, symbol: Symbol, i: str) -> Value | None:
        """Γ_k with all its elements, or element n of it, which is Γ_n^k."""
        interval = symbol.sup or symbol.sub
        if symbol.dots or interval not in ("1", "2", "3"):
            return None
        force = self.constraint_force(interval)
        return element(force, symbol.sub) if symbol.sup else vector(force)

    def constraint_force(self, interval: str) -> np.ndarray:
        """Gradient of λ·Φ: the generalized force that does the constraint's virtual work."""
        phi = self.partial(Symbol("Phi", interval, "0"), Symbol("q", "j"), {}).array
        weight = self.lookup(Symbol("lambda", interval, "0"), {}).array
        return np.asarray((phi * weight).sum(-1)[:, None, :])
