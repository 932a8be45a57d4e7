"""What each symbol of chapter 3's dynamics must equal: energies, D, V, C, virtual work.

From the bodies' Jacobians (:mod:`pollard_pin.thesis.symbols.bodies`) follow, by definition
and not by the thesis's derivations, M, N, L and the rows of D, V, C; Q is what
the equation of motion leaves, and the accelerations are those that the three
base motors alone produce, so that Q = J_τᵀ τ as 3.6 supposes.

Source: Pollard thesis, 3.1, 3.3, 3.5 – 3.7.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from pollard_pin.thesis.state import POSE
from pollard_pin.thesis.symbols.bodies import BODIES, bodies, inertia, own_frame
from pollard_pin.thesis.symbols.k import KSymbols
from thesis_pin.equations import lagrangian
from thesis_pin.equations.formula import Node, Symbol
from thesis_pin.equations.values import ZERO, Value, matrix, scalar, vector
from thesis_pin.tolerances import GRAVITY

MOTORS = ("theta_21", "theta_211", "theta_212")
"""Angles the three base motors turn (3.146)."""


class Dynamics(KSymbols):
    """All symbols of chapter 3 at closed states.

    Attributes:
        gravity: Acceleration of bodies left to themselves [m/s²].
    """

    gravity = np.array([0.0, 0.0, -GRAVITY])

    @cached_property
    def bodies(self) -> dict[str, lagrangian.Body]:
        """Bodies with their Jacobians by the pose."""
        return bodies(self.state)

    @cached_property
    def pose_rates(self) -> np.ndarray:
        """q̇, shape ``(..., n, 6)``."""
        parts = [self.state.rates[name] for name in POSE]
        return np.stack(np.broadcast_arrays(*parts), axis=-1)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """As its parent does; ∂L/∂q̇ is the momentum, without a step."""
        of = of.bound(indices) if isinstance(of, Symbol) else of
        once = by is not None and by.base == "q" and by.dots == 1
        if isinstance(of, Symbol) and of.base == "L" and once and not of.dots:
            mass = lagrangian.mass_matrix(self._chosen(of, indices.get("i", "")))
            momentum = (mass @ self.pose_rates[..., None])[..., 0]
            return scalar(np.moveaxis(momentum, -1, 0))
        return super().partial(of, by, indices)

    # -- bodies -------------------------------------------------------------------

    def _body(self, sub: str, i: str) -> str | None:
        """Body "3" or, on chain i, "1i" → "11"."""
        name = sub.replace("i", i) if i else sub
        return name if name in BODIES and (len(name) == 1 or sub.endswith("i")) else None

    def _chosen(self, symbol: Symbol, i: str) -> list[lagrangian.Body]:
        """The body of L_1, L_1i …, all of them for L."""
        if not symbol.sub:
            return list(self.bodies.values())
        body = self._body(symbol.sub, i)
        return [self.bodies[body]] if body else []

    def _of_m(self, symbol: Symbol, i: str) -> Value | None:
        body = self._body(symbol.sub or "2", i)
        return scalar(self.state.constants[f"mass {body}"]) if body and not symbol.dots else None

    def _of_I(self, symbol: Symbol, i: str) -> Value | None:
        plain = not (symbol.sub or symbol.sup or symbol.dots)
        return matrix(inertia(self.state, "2")) if plain else None

    def _of_J(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub == "tau" and not (symbol.primes or symbol.sup):
            rows = [self.rows[name] for name in MOTORS]
            return matrix(np.stack(np.broadcast_arrays(*rows), axis=-2))
        body = self._body(symbol.sub, i)
        if body and not (symbol.primes or symbol.dots):
            frame, _ = own_frame(body)
            if symbol.sup == "0" or not symbol.sup:
                return matrix(inertia(self.state, body))
            own = symbol.sup in (frame, "2i" if frame == "3i" else frame)
            return matrix(self.state.constants[f"inertia {body}"]) if own else None
        return self._derivative_matrix(symbol, i)

    def _of_M(self, symbol: Symbol, i: str) -> Value | None:
        chain, digits = symbol.sub.endswith("i"), symbol.sub.removesuffix("i")
        if symbol.sub == "i":  # the moment of motor i in (3.146)
            return self._motor_torque(int(i))
        if symbol.dots or not digits.isdigit():
            return None
        body = self._body(f"{(int(digits) + 1) // 2}" + "i" * chain, i)
        if body is None:
            return None
        of = self.bodies[body]
        return matrix(of.linear if int(digits) % 2 else of.angular)

    def _of_N(self, symbol: Symbol, i: str) -> Value | None:
        body = self._body(symbol.sub, i)
        if body is None or symbol.dots:
            return None
        return matrix(lagrangian.mass_matrix([self.bodies[body]]))

    # -- energies -----------------------------------------------------------------

    def _of_K(self, symbol: Symbol, i: str) -> Value | None:
        return self._energy(symbol, i, kinetic=1, potential=0)

    def _of_U(self, symbol: Symbol, i: str) -> Value | None:
        return self._energy(symbol, i, kinetic=0, potential=1)

    def _of_L(self, symbol: Symbol, i: str) -> Value | None:
        return self._energy(symbol, i, kinetic=1, potential=-1)

    def _energy(self, symbol: Symbol, i: str, kinetic: int, potential: int) -> Value | None:
        if not symbol.sub and symbol.base != "L":
            symbol = Symbol(symbol.base, "2")  # "a body"
        chosen = self._chosen(symbol, i)
        if symbol.dots or not chosen:
            return None
        total = sum(
            kinetic * lagrangian.kinetic_energy(body, self.pose_rates)
            - potential * body.mass * (body.centre * self.gravity).sum(axis=-1)
            for body in chosen
        )
        return scalar(np.asarray(total))

    def _of_g(self, symbol: Symbol, i: str) -> Value | None:
        plain = not (symbol.sub or symbol.sup or symbol.dots)
        return vector(self.gravity) if plain else None

    # -- equations of motion --------------------------------------------------------

    def _rows_of(self, array: np.ndarray) -> Value:
        """Rows of a matrix ``(n, 6, 6)``, with j first: ``(6, n, 1, 6)``."""
        return matrix(np.moveaxis(array, -2, 0)[..., None, :])

    def _mass(self, symbol: Symbol, i: str) -> Symbol | None:
        """N of the body in 𝔻_1j, 𝕍_1ij …"""
        body = symbol.sub.removesuffix("j")
        known = symbol.sub.endswith("j") and self._body(body, i)
        return Symbol("N", body, kept="i") if known and not symbol.dots else None

    def _of_bb_D(self, symbol: Symbol, i: str) -> Value | None:
        mass = self._mass(symbol, i)
        return self._rows_of(self.lookup(mass, {"i": i}).array) if mass else None

    def _of_bb_V(self, symbol: Symbol, i: str) -> Value | None:
        mass = self._mass(symbol, i)
        if mass is None:
            return None
        if symbol.primes == 0:
            return self._rows_of(self.partial(mass, None, {"i": i}).array)
        varied = self.partial(mass, Symbol("q", "j"), {"i": i}).array
        return matrix(0.5 * np.einsum("nk,jnkl->jnl", self.pose_rates, varied)[..., None, :])

    def _of_bb_C(self, symbol: Symbol, i: str) -> Value | None:
        body = self._body(symbol.sub.removesuffix("j"), i)
        if body is None or not symbol.sub.endswith("j") or symbol.dots or symbol.primes:
            return None
        of = self.bodies[body]
        pull = np.einsum("k,...kj->j...", self.gravity, of.linear)
        return scalar(of.mass * pull)

    @cached_property
    def terms(self) -> lagrangian.Terms:
        """D, V and C of the whole robot."""
        time, varied = (
            lagrangian.exact_rates(list(self.moved(along).bodies.values()))
            for along in (None, "q_j")
        )
        bodies = list(self.bodies.values())
        return lagrangian.assemble(bodies, time, np.moveaxis(varied, 0, -3), self.pose_rates)

    @cached_property
    def generalized_force(self) -> np.ndarray:
        """Q = D q̈ + V q̇ + C, shape ``(n, 6)``."""
        terms, a = self.terms, self.drive.acceleration
        moving = terms.mass @ a[..., None] + terms.velocity @ self.pose_rates[..., None]
        return np.asarray(moving[..., 0] + terms.gravity)

    def _whole(self, symbol: Symbol, array: np.ndarray) -> Value | None:
        """Row j of D, V or C of (3.153); stacked and transposed where it has a prime."""
        if symbol.dots or symbol.sub != "j" or symbol.sup:
            return None
        if array.ndim == 2:
            return vector(array) if symbol.primes else scalar(np.moveaxis(array, -1, 0))
        if symbol.primes:
            return matrix(np.swapaxes(array, -1, -2))
        return self._rows_of(array)

    def _of_D(self, symbol: Symbol, i: str) -> Value | None:
        return self._whole(symbol, self.terms.mass) if symbol.sub == "j" else None

    def _of_V(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub == "j":
            return self._whole(symbol, self.terms.velocity)
        return super()._of_V(symbol, i)

    def _of_C(self, symbol: Symbol, i: str) -> Value | None:
        return self._whole(symbol, self.terms.gravity) if symbol.sub == "j" else None

    def _of_q(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots == 0:
            parts = [self.state.variables[name] for name in POSE]
            series = np.stack(np.broadcast_arrays(*parts), axis=-1)
        elif symbol.dots > 2:
            return None
        else:
            series = self.pose_rates if symbol.dots == 1 else self.drive.acceleration
        return self._entry(series, symbol.sub)

    @staticmethod
    def _entry(series: np.ndarray, sub: str) -> Value | None:
        """A vector ``(n, 6)``, its entry 1 … 6, or all entries with j first."""
        if not sub:
            return vector(series)
        if sub == "j":
            return scalar(np.moveaxis(series, -1, 0))
        return scalar(series[..., int(sub) - 1]) if sub in "123456" else None

    # -- virtual work ----------------------------------------------------------------

    def _of_Q(self, symbol: Symbol, i: str) -> Value | None:
        return None if symbol.dots else self._entry(self.generalized_force, symbol.sub)

    def _motor_torque(self, motor: int) -> Value:
        axis = np.eye(3)[1 if motor == 1 else 2]
        return vector(self.drive.torque[..., motor - 1, None] * axis)

    def _of_tau(self, symbol: Symbol, i: str) -> Value | None:
        if not symbol.sub:
            return vector(self.drive.torque)
        if symbol.dots or symbol.sub not in ("1", "2", "3"):
            return None
        if symbol.bold:
            return self._motor_torque(int(symbol.sub))
        return scalar(self.drive.torque[..., int(symbol.sub) - 1])

    def _of_F(self, symbol: Symbol, i: str) -> Value | None:
        return ZERO  # motors exert no forces

    _of_delta_R = _of_F

    def _turn(self, name: str) -> np.ndarray:
        return np.asarray((self.rows[name] * self.drive.virtual).sum(axis=-1))

    def _of_delta_q(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots:
            return None
        return self._entry(self.drive.virtual, symbol.sub)

    def _of_delta_theta(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots:
            return None
        if symbol.sub:
            name = f"theta_{symbol.sub}"
            return scalar(self._turn(name)) if name in self.rows else None
        return scalar(self.drive.virtual[..., POSE.index(symbol.base.removeprefix("delta:"))])

    _of_delta_x = _of_delta_y = _of_delta_z = _of_delta_theta
    _of_delta_psi = _of_delta_phi = _of_delta_theta

    def _of_delta_Q(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots:
            return None
        if symbol.sub not in ("1", "2", "3"):
            return None
        motor = int(symbol.sub)
        axis = np.eye(3)[1 if motor == 1 else 2]
        return vector(self._turn(MOTORS[motor - 1])[..., None] * axis)

    def _of_delta_W(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots:
            return None
        turns = np.stack([self._turn(name) for name in MOTORS], axis=-1)
        return scalar((turns * self.drive.torque).sum(axis=-1))
