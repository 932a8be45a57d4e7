"""What each symbol of the thesis must equal, computed without its formulas.

Geometry comes from :mod:`scout_pin.thesis.state`: products of elementary
transforms, differentiated factor by factor. From these follow, by definition
and not by the thesis's derivations:

========================  ====================================================
symbol                    reference
========================  ====================================================
i, j, k with frame        column of a frame's rotation, or axis of ∂R/∂q Rᵀ
r, b                      differences of frame origins; centres of mass
v, a, ω, α                their time derivatives; axis of Ṙ Rᵀ and its derivative
u, e, J, W                columns ∂p_i/∂q, ∂b/∂q of Jacobians; axes
x_i, y_i                  Σ Ω̇ r and Σ Ω² r with Ω = Ṙ Rᵀ
D, V, C, N                :mod:`thesis_pin.lagrangian` on those Jacobians
A_τ, δW                   power of the joint torques, τ·θ̇
p_ZMP                     balance of moments of all bodies' inertial forces
========================  ====================================================

A dot not listed is a complex step in time, ∂/∂q_j one along the coordinates.
"""

from __future__ import annotations

import re
from functools import cached_property

import numpy as np

from scout_pin.thesis.state import BODIES, COORDINATES, Frame, State, coordinate_index, vee
from thesis_pin import lagrangian
from thesis_pin.evaluation import (
    STEP,
    ZERO,
    Value,
    evaluate,
    imaginary,
    matrix,
    scalar,
    vector,
)
from thesis_pin.notation import FormulaError, Node, Symbol

GRAVITY = 9.81  # m/s², thesis 4.1
_UNIT = {"i": np.array([1.0, 0, 0]), "j": np.array([0, 1.0, 0]), "k": np.array([0, 0, 1.0])}
# The axes ω is made of (3.10): letter and number of each joint's axis vector.
JOINT_AXES = {"k0": 1, "j2": 2, "k4": 3, "k6": 4, "k8": 5, "i10": 6}
_EULER_AXES = {"itheta": 0, "jphi": 1, "kpsi": 2}
# Arguments in the definitions of functions, as in T_z1(x): any number will do.
DUMMIES = {"x": 0.3, "y": -0.7, "z": 1.1, "theta_x": 0.4, "theta_y": -0.9, "theta_z": 1.3}
DUMMIES |= {"alpha": 0.5, "beta": -1.2, "gamma": 0.8}
_FIRST_E = (1, 5, 10, 16, 23, 31, 40)  # number of the first vector e of each link


def e_column(number: int) -> tuple[int, int]:
    """Link n and column c (0: θ_B, 1: φ_B, 2: ψ_B, 3: θ_1i …) of the vector e_number."""
    for link in range(1, 7):
        if _FIRST_E[link - 1] <= number < _FIRST_E[link]:
            return link, number - _FIRST_E[link - 1]
    raise FormulaError(f"there is no vector e_{number}")


class References:
    """The reference environment: every symbol at a batch of states."""

    columns = 18

    def __init__(self, state: State) -> None:
        self.state = state
        self._values: dict[tuple[str, int, str], Value] = {}
        self._moved: dict[tuple[str | None, bool], References] = {}

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol; see :class:`thesis_pin.evaluation.Environment`."""
        legs = indices.get("i", "") + "/" + indices.get("j", "")
        key = (symbol.name + "*" * symbol.bold, symbol.dots, legs)
        if key not in self._values:
            value = self._find(symbol, indices)
            if value is None:
                dots = "˙" * symbol.dots
                raise FormulaError(f"the symbol {symbol.name}{dots} isn't defined anywhere")
            self._values[key] = value
        return self._values[key]

    def _find(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.name in DUMMIES and not symbol.dots:
            return scalar(DUMMIES[symbol.name])
        if symbol.name in DUMMIES and symbol.dots == 1:
            return scalar(-2.0 * DUMMIES[symbol.name])
        handler = getattr(self, "_of_" + symbol.base.replace(":", "_"), None)
        value = handler(symbol, indices) if handler else None
        if value is None and symbol.dots:
            below = Symbol(
                symbol.base, symbol.sub, symbol.sup, symbol.dots - 1, symbol.primes, symbol.bold
            )
            value = self.partial(below, None, indices)
        return value

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative of a formula by a coordinate, a rate or time."""
        if isinstance(of, Symbol) and of.name == "L" and by is not None and by.dots:
            return self._momentum(by)
        if isinstance(of, Symbol) and of.name == "q" and by is not None:
            return self._unit(by) if of.dots == by.dots else ZERO
        if by is not None and by.name == "q":
            columns = self.partial(of, Symbol("q", "j"), indices)
            return matrix(np.swapaxes(columns.array, 1, -1)[:, None])
        along, rates = None if by is None else by.name, bool(by and by.dots)
        if self.state.perturbed:
            return self._difference(of, along, rates, indices)
        return imaginary(evaluate(of, self.moved(along, rates), indices))

    def _difference(
        self, of: Node, along: str | None, rates: bool, indices: dict[str, str]
    ) -> Value:
        """A derivative inside a derivative, which only misprints need: central difference."""
        ends = [
            evaluate(of, References(self.state.step(along, rates, size)), indices)
            for size in (1e-6, -1e-6)
        ]
        if ends[0].rank == -1:
            return ZERO
        return Value((ends[0].array - ends[1].array) / 2e-6, ends[0].rank)

    def _unit(self, by: Symbol) -> Value:
        """∂q/∂q_j: the unit vectors, with j along axis 1."""
        if by.sub == "j":
            return vector(np.eye(18)[None])
        return vector(np.eye(18)[coordinate_index(by.name)][None, None])

    def moved(self, along: str | None, rates: bool) -> References:
        """The same symbols one imaginary step away."""
        key = (along, rates)
        if key not in self._moved:
            self._moved[key] = References(self.state.step(*key))
        return self._moved[key]

    def _momentum(self, by: Symbol) -> Value:
        """∂L/∂q̇_j = (N q̇)_j, so that its time derivative needs one complex step only."""
        mass = lagrangian.mass_matrix(list(self.bodies.values()))
        momentum = (mass @ self.state.v[..., None])[..., 0]
        if by.sub == "j":
            return scalar(momentum[:, 0, :])
        return scalar(momentum[..., coordinate_index(by.name)])

    # -- coordinates, constants ------------------------------------------------

    def _coordinate(self, name: str, dots: int) -> Value | None:
        if dots > 2 or name not in COORDINATES:
            return None
        series = (self.state.q, self.state.v, self.state.a)[dots]
        return scalar(series[..., COORDINATES.index(name)])

    def _constant(self, name: str) -> Value | None:
        found = self.state.parameters.values.get(name)
        return None if found is None else Value(found, found.ndim - 2)

    def _of_q(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        s = self.state
        series = (s.q, s.v, s.a)[symbol.dots] if symbol.dots < 3 else None
        if series is None or symbol.sup:
            return None
        if not symbol.sub:
            return vector(series)
        if symbol.sub == "j":
            return scalar(series if series.shape[1] == 1 else np.einsum("njj->nj", series))
        return scalar(series[..., coordinate_index(f"q_{symbol.sub}")])

    def _of_theta(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub in ("1", "2") and not symbol.sup:
            return self._foot_angle(symbol.base, int(symbol.sub), symbol.dots)
        return None if symbol.sup else self._coordinate(symbol.name, symbol.dots)

    _of_phi = _of_psi = _of_theta

    def _of_beta(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        return ZERO if symbol.dots else self._constant(symbol.name)

    def _of_m(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots:
            return None
        if symbol.sub == "T":
            return scalar(sum(self.state.parameters.values[f"m_{body}"] for body in BODIES))
        return self._constant(symbol.name)

    def _of_b1(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        return ZERO if symbol.dots else self._constant(symbol.name)

    _of_b2 = _of_b1

    def _of_g(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub or symbol.sup or symbol.dots:
            return None
        return vector(np.array([[[0, 0, -GRAVITY]]])) if symbol.bold else scalar(GRAVITY)

    def _of_ai(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        """Coordinates of vertex a of foot i, in the sole's frame or, with 0, in the world."""
        i = indices.get("i", "")
        if symbol.dots or i not in ("1", "2") or symbol.sub[:1] not in ("x", "y", "z"):
            return None
        local, k = self.state.parameters.values[f"a{i}"], "xyz".index(symbol.sub[0])
        if symbol.sub[1:] == "0":
            return scalar(self.state.point(f"7{i}", local)[0][..., k])
        return None if symbol.sub[1:] else scalar(local[..., k])

    def _of_lambda(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots or symbol.sup != "0" or symbol.sub not in ("1", "2", "3"):
            return None
        return vector(self.state.multipliers[..., : 12 if symbol.sub == "2" else 6])

    def _of_Gamma(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        """Gradient of λ·Φ: the generalized force that does the constraint's virtual work."""
        if symbol.dots or symbol.sub not in ("1", "2", "3"):
            return None
        phi = self.partial(Symbol("Phi", symbol.sub, "0"), Symbol("q", "j"), indices).array
        weight = self.lookup(Symbol("lambda", symbol.sub, "0"), indices).array
        return vector((phi * weight).sum(-1)[:, None, :])

    def _of_tau(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sup == "0" and symbol.sub in BODIES[1:] and not symbol.dots:
            joint = 6 * (int(symbol.sub[1]) - 1) + int(symbol.sub[0])
            axis = self.state.frame(symbol.sub).axis(5 + joint)
            return vector(self.state.tau[..., joint - 1, None] * axis)
        if symbol.dots or symbol.sup:
            return None
        if not symbol.sub:
            return vector(self.state.tau)
        return scalar(self.state.tau[..., coordinate_index(f"theta_{symbol.sub}") - 6])

    def _of_x(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sup == "0":
            return self._acceleration_part(symbol)
        if symbol.sup:
            return None
        if symbol.sub in ("1", "2"):
            where, jacobian = self.state.point(f"7{symbol.sub}")
            k = "xyz".index(symbol.base)
            if symbol.dots == 0:
                return scalar(where[..., k])
            return (
                scalar((jacobian[..., k, :] * self.state.v).sum(-1)) if symbol.dots == 1 else None
            )
        constant = None if symbol.dots else self._constant(symbol.name)
        return self._coordinate(symbol.name, symbol.dots) or constant

    _of_y = _of_z = _of_x

    # -- frames ------------------------------------------------------------------

    def _rate(self, frame: Frame) -> np.ndarray:
        """Ṙ Rᵀ of a frame."""
        rate = sum(
            d[..., :3, :3] * self.state.v[..., k, None, None] for k, d in frame.derivatives.items()
        )
        return rate @ np.swapaxes(frame.rotation, -1, -2)

    def _body(self, sub: str) -> str | None:
        """Link whose frame the thesis numbers so: "B", "31" (link 2, left), "1" (sole)."""
        if sub == "B":
            return "B"
        if sub in ("1", "2"):
            return f"7{sub}"
        match = re.fullmatch(r"(1|3|5|7|9|11|14)([12])", sub)
        if not match:
            return None
        return f"{'7' if match[1] == '14' else (int(match[1]) + 1) // 2}{match[2]}"

    def _of_R(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        body = self._body(symbol.sub)
        if symbol.sup != "0" or symbol.dots or body is None:
            return None
        return matrix(self.state.frame(body).rotation)

    def _of_T(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots or symbol.sup:
            return None
        if not symbol.bold and symbol.sub in BODIES:
            return scalar(self._kinetic(symbol.sub))
        ends = {"0B": ("0", "B"), "B11": ("B", "11"), "B12": ("B", "12")}
        for i in "12":
            ends |= {f"0{i}": ("0", f"7{i}"), f"6{i}{i}": (f"6{i}", f"7{i}")}
            ends |= {f"{n}{i}{n + 1}{i}": (f"{n}{i}", f"{n + 1}{i}") for n in range(1, 6)}
        if symbol.sub not in ends:
            return None
        first, last = ends[symbol.sub]
        placement = self.state.frame(last).placement
        if first != "0":
            placement = np.linalg.inv(self.state.frame(first).placement) @ placement
        return matrix(placement)

    def _of_i(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        letter, sub = symbol.base, symbol.sub
        if symbol.dots and (sub == "0" or not symbol.sup):
            return ZERO
        if symbol.dots:
            return None
        unit = np.broadcast_to(_UNIT[letter], (1, 1, 3))
        if sub == "0" or not symbol.sup:
            return vector(unit)
        if symbol.sup != "0":
            return None
        axis = self._axis(letter + sub)
        if axis is not None:
            return vector(axis)
        body = self._body(sub)
        return None if body is None else vector(self.state.frame(body).rotation @ unit[0, 0])

    _of_j = _of_k = _of_i

    def _axis(self, name: str) -> np.ndarray | None:
        """Axis of a coordinate by its vector's name: "k01", "i102", "jphiB", "kpsi1"."""
        state = self.state
        for start, k in _EULER_AXES.items():
            if name == start + "B":
                return state.torso[-1].axis(3 + k)
            if name in (start + "1", start + "2"):
                return self._foot_axes(int(name[-1]))[..., k]
        joint = JOINT_AXES.get(name[:-1])
        if joint is None or name[-1] not in "12":
            return None
        i = int(name[-1])
        return state.legs[i][joint - 1].axis(5 + 6 * (i - 1) + joint)

    def _foot_angles(self, i: int) -> np.ndarray:
        """θ_i, φ_i, ψ_i with R_i = Rx(θ) Ry(φ) Rz(ψ), shape ``(N, J, 3)``."""
        R = self.state.legs[i][-1].rotation
        upright = np.sqrt(R[..., 0, 0] ** 2 + R[..., 0, 1] ** 2)
        return np.stack(
            [
                _arctan2(-R[..., 1, 2], R[..., 2, 2]),
                _arctan2(R[..., 0, 2], upright),
                _arctan2(-R[..., 0, 1], R[..., 0, 0]),
            ],
            axis=-1,
        )

    def _foot_axes(self, i: int) -> np.ndarray:
        """The axes the foot's Euler angles turn about, as columns."""
        theta, phi = (self._foot_angles(i)[..., k] for k in (0, 1))
        zero, one = np.zeros_like(theta), np.ones_like(theta)
        first = [one, zero, zero]
        second = [zero, np.cos(theta), np.sin(theta)]
        third = [np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta) * np.cos(phi)]
        return np.stack([np.stack(axis, axis=-1) for axis in (first, second, third)], axis=-1)

    def _foot_angle(self, base: str, i: int, dots: int) -> Value | None:
        k = ("theta", "phi", "psi").index(base)
        if dots == 0:
            return scalar(self._foot_angles(i)[..., k])
        if dots > 1:
            return None
        omega = vee(self._rate(self.state.legs[i][-1]))
        return scalar(np.linalg.solve(self._foot_axes(i), omega[..., None])[..., k, 0])

    # -- positions, velocities, accelerations --------------------------------------

    def _segment(self, sub: str) -> tuple[np.ndarray, np.ndarray] | None:
        """The vector r_sub and its Jacobian."""
        state = self.state
        if sub == "B":
            return state.point("B")
        if sub in ("1", "2"):
            return state.point(f"7{sub}")
        centre = re.fullmatch(r"G(B|[1-6][12])", sub)
        if centre:
            (b, J), (p, K) = state.centre(centre[1]), state.point(centre[1])
            return b - p, J - K
        link = re.fullmatch(r"([0-6])([12])", sub)
        if not link:
            return None
        start = "B" if link[1] == "0" else sub
        (end, J), (begin, K) = state.point(f"{int(link[1]) + 1}{link[2]}"), state.point(start)
        return end - begin, J - K

    def _of_r(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        found = self._segment(symbol.sub)
        if found is None or symbol.dots > 1:
            return None
        if symbol.sup == "0":
            return vector(self._moving(found, symbol.dots))
        if symbol.sub.startswith("G") and not symbol.dots and symbol.sup:
            own = symbol.sub[1:]
            same = own if own == "B" else f"{2 * int(own[0]) - 1}{own[1]}"
            return self._constant(symbol.sub) if symbol.sup == same else None
        return None

    def _moving(self, found: tuple[np.ndarray, np.ndarray], dots: int) -> np.ndarray:
        where, jacobian = found
        return where if dots == 0 else (jacobian @ self.state.v[..., None])[..., 0]

    def _of_b(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub in ("1y", "2y") and not symbol.sup:
            return ZERO if symbol.dots else self._constant(f"b{symbol.sub[0]}_y")
        if symbol.sub in ("Tx", "Ty", "Tz") and not symbol.dots:
            centre = self._of_b(Symbol("b", "T", "0"), indices)
            return None if centre is None else _component(centre.array, symbol.sub[-1])
        if symbol.sup != "0" or symbol.dots > 1:
            return None
        if symbol.sub == "T":
            masses = [self.state.parameters.values[f"m_{body}"][..., None] for body in BODIES]
            parts = [self._moving(self.state.centre(body), symbol.dots) for body in BODIES]
            total = sum(m * part for m, part in zip(masses, parts, strict=True))
            return vector(total / sum(masses))
        if symbol.sub not in BODIES:
            return None
        return vector(self._moving(self.state.centre(symbol.sub), symbol.dots))

    def _of_v(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        found = self._segment(symbol.sub) if symbol.sup == "0" and not symbol.dots else None
        return None if found is None else vector(self._moving(found, 1))

    def _of_a(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sup != "0" or symbol.dots:
            return None
        return self.partial(Symbol("v", symbol.sub, "0", bold=True), None, indices)

    def _of_omega(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sup != "0" or symbol.dots:
            return None
        euler = re.fullmatch(r"(theta|phi|psi)(B|1|2)", symbol.sub)
        if euler:
            letter = {"theta": "i", "phi": "j", "psi": "k"}[euler[1]]
            rate = self.lookup(Symbol(euler[1], euler[2], dots=1), indices)
            axis = self._axis(letter + symbol.sub)
            return vector(rate.array[..., None] * axis)
        body = "B" if symbol.sub == "B" else None
        if symbol.sub in ("1", "2"):
            body = f"7{symbol.sub}"
        elif symbol.sub in BODIES:
            body = symbol.sub
        return None if body is None else vector(vee(self._rate(self.state.frame(body))))

    def _of_alpha(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sup != "0" or symbol.dots:
            return None
        return self.partial(Symbol("omega", symbol.sub, "0", bold=True), None, indices)

    def _acceleration_part(self, symbol: Symbol) -> Value | None:
        """x_i = Σ Ω̇ r and y_i = Σ Ω² r; x_1i only with q̈, x_2i the rest of x_i."""
        if symbol.dots or symbol.base == "z":
            return None
        part, i = symbol.sub[:-1], symbol.sub[-1:]
        if i not in ("1", "2") or part not in (("", "1", "2") if symbol.base == "x" else ("",)):
            return None
        if part == "1":
            jacobian = self.state.point(f"7{i}")[1] - self.state.point("B")[1]
            return vector((jacobian @ self.state.a[..., None])[..., 0])
        total: np.ndarray | float = 0.0
        for n in range(7):
            link = "B" if n == 0 else f"{n}{i}"
            segment = self._segment(f"{n}{i}")
            assert segment
            if symbol.base == "x":
                later = self.moved(None, False)
                rate = np.imag(later._rate(later.state.frame(link))) / STEP
            else:
                rate = self._rate(self.state.frame(link))
                rate = rate @ rate
            total = total + (rate @ segment[0][..., None])[..., 0]
        if part == "2":
            first = self._acceleration_part(Symbol("x", f"1{i}", "0"))
            assert first
            total = total - first.array
        return vector(np.asarray(total))

    # -- the thesis's vectors u, s, t, e -------------------------------------------

    def _which(self, sub: str, indices: dict[str, str]) -> tuple[int, int] | None:
        """Coordinate and leg of a vector called by its coordinate ("theta31", "phiB")."""
        name = re.sub(r"^(theta|phi|psi)", r"\1_", sub)
        if name not in COORDINATES:
            return None
        leg = indices.get("i", "") if sub.endswith("B") else sub[-1]
        return (COORDINATES.index(name), int(leg)) if leg in ("1", "2") else None

    def _of_u(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        which = self._which(symbol.sub, indices)
        if which is None or symbol.sup != "0" or symbol.dots:
            return None
        return vector(self.state.point(f"7{which[1]}")[1][..., which[0]])

    def _of_t(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        """t = d/dt axis for a joint; for Euler angles (3.23) splits the same sum otherwise."""
        euler = re.fullmatch(r"(theta|phi|psi)(B|1|2)", symbol.sub)
        if symbol.sup != "0" or symbol.dots:
            return None
        if not euler:
            return self._axis_rate(symbol.sub)
        after = {"theta": ("phi", "j"), "phi": ("psi", "k"), "psi": ("theta", "k")}[euler[1]]
        by = "theta" if euler[1] == "psi" else euler[1]
        rate = self.lookup(Symbol(after[0], euler[2], dots=1), indices).array[..., None]
        if euler[2] == "B":
            vary = self.partial(
                Symbol(after[1], {"j": "phiB", "k": "psiB"}[after[1]], "0", bold=True),
                Symbol(by, "B"),
                indices,
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
        which = self._which(sub, {})
        if which is None:
            return None
        joint = which[0] - 5 - 6 * (which[1] - 1)
        letter, number = next((k[0], k[1:]) for k, n in JOINT_AXES.items() if n == joint)
        return self.partial(Symbol(letter, f"{number}{which[1]}", "0", bold=True), None, {})

    def _of_s(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        """s = d/dt u for a joint; for the torso t × (p_i − p_B) plus axis × its rate."""
        which = self._which(symbol.sub, indices)
        if which is None or symbol.sup != "0" or symbol.dots:
            return None
        if which[0] >= 6:
            return self.partial(Symbol("u", symbol.sub, "0", bold=True), None, indices)
        (foot, J), (torso, K) = self.state.point(f"7{which[1]}"), self.state.point("B")
        rate = ((J - K) @ self.state.v[..., None])[..., 0]
        t = self.lookup(Symbol("t", symbol.sub, "0", bold=True), indices).array
        axis = self.state.torso[-1].axis(which[0])
        return vector(np.cross(t, foot - torso) + np.cross(axis, rate))

    def _of_e(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
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

    # -- Lagrangian ------------------------------------------------------------------

    def _of_J(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots or symbol.sup or symbol.sub not in BODIES:
            return None
        return matrix(self.state.centre(symbol.sub)[1])

    def _of_W(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots or symbol.sup or symbol.sub not in BODIES:
            return None
        return matrix(self.state.angular(symbol.sub))

    def _of_I(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        element = re.fullmatch(r"([xyz])([xyz])(B|[1-6][12])", symbol.sub)
        if element and not symbol.dots:
            tensor = self.state.parameters.values[f"I{element[3]}"]
            return scalar(tensor[..., "xyz".index(element[1]), "xyz".index(element[2])])
        if symbol.dots or symbol.sub not in BODIES:
            return None
        if symbol.sup == "0":
            return matrix(self.state.inertia(symbol.sub))
        own = symbol.sub if symbol.sub == "B" else f"{2 * int(symbol.sub[0]) - 1}{symbol.sub[1]}"
        return self._constant(f"I{symbol.sub}") if symbol.sup == own else None

    @cached_property
    def bodies(self) -> dict[str, lagrangian.Body]:
        """Jacobians and mass properties of all bodies at these states."""
        s = self.state
        return {
            body: lagrangian.Body(
                s.parameters.values[f"m_{body}"],
                s.inertia(body),
                s.centre(body)[1],
                s.angular(body),
                s.centre(body)[0],
            )
            for body in BODIES
        }

    def _kinetic(self, body: str) -> np.ndarray:
        return lagrangian.kinetic_energy(self.bodies[body], self.state.v)

    def _potential(self, body: str) -> np.ndarray:
        mass = self.state.parameters.values[f"m_{body}"]
        return GRAVITY * mass * self.bodies[body].centre[..., 2]

    def _of_L(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        bodies = [symbol.sub] if symbol.sub in BODIES else list(BODIES) if not symbol.sub else []
        if not bodies or symbol.dots or symbol.sup:
            return None
        return scalar(sum(self._kinetic(body) - self._potential(body) for body in bodies))

    def _of_N(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots or symbol.sup or symbol.sub not in BODIES:
            return None
        return matrix(lagrangian.mass_matrix([self.bodies[symbol.sub]]))

    def _row(self, array: np.ndarray) -> Value:
        """Row j of a matrix ``(N, 1, 18, 18)``, with j along axis 1."""
        return matrix(array[:, 0, :, None, :])

    def _of_D(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub[:-1] not in BODIES or symbol.sub[-1:] != "j" or symbol.dots:
            return None
        return self._row(self.lookup(Symbol("N", symbol.sub[:-1]), indices).array)

    def _of_V(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if not symbol.bold and symbol.sub in BODIES:
            return scalar(self._potential(symbol.sub))
        body, j = symbol.sub[:-1], symbol.sub[-1:]
        if symbol.bold and symbol.sub in ("1", "2"):
            return vector(self._foot_side(int(symbol.sub), rates=True))
        if body not in BODIES or j != "j" or symbol.dots:
            return None
        kind = Symbol("N", body)
        if symbol.primes == 0:
            return self._row(self.partial(kind, None, indices).array)
        varied = self.partial(kind, Symbol("q", "j"), indices).array
        return matrix(0.5 * np.einsum("nok,njkl->njl", self.state.v, varied)[..., None, :])

    def _of_C(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        body, j = symbol.sub[:-1], symbol.sub[-1:]
        if body not in BODIES or j != "j" or symbol.primes != 1:
            return None
        weight = -GRAVITY * self.state.parameters.values[f"m_{body}"]
        return scalar(weight * self.state.centre(body)[1][:, 0, 2, :])

    @cached_property
    def terms(self) -> lagrangian.Terms:
        """D, V and C of the whole robot, shape ``(N, …)``."""
        moved = self.moved(None, False), self.moved("q_j", False)
        return lagrangian.assemble(
            list(self.bodies.values()),
            lagrangian.exact_rates(list(moved[0].bodies.values()), STEP),
            lagrangian.exact_rates(list(moved[1].bodies.values()), STEP),
            self.state.v,
            GRAVITY,
        )

    def _of_bb_D(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub == "j":
            return matrix(self.terms.mass[:, :, None, :])
        return None if symbol.sub else matrix(self.terms.mass[:, None])

    def _of_bb_V(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub == "j":
            return matrix(self.terms.velocity[:, :, None, :])
        return None if symbol.sub else matrix(self.terms.velocity[:, None])

    def _of_bb_C(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub == "j":
            return scalar(self.terms.gravity)
        return None if symbol.sub else vector(self.terms.gravity[:, None])

    # -- forces ------------------------------------------------------------------------

    def _of_A(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.bold and symbol.sub in ("1", "2"):
            return vector(self._foot_side(int(symbol.sub), rates=False))
        full = np.vstack([np.zeros((6, 12)), np.eye(12)])
        if symbol.sub == "tau":
            return matrix(full[None, None])
        for row in range(1, 19):
            column = symbol.sub.removeprefix(str(row))
            if column != symbol.sub and column.isdigit() and column[0] != "0":
                # "111" is row 11, column 1; "1310" can only be row 13, column 10.
                other = symbol.sub.removeprefix(str(row)[:1])
                if len(column) == 2 and int(column) > 12 and other:
                    continue
                if int(column) <= 12:
                    return scalar(np.array([[full[row - 1, int(column) - 1]]]))
        return None

    def _foot_side(self, i: int, rates: bool) -> np.ndarray:
        """Right-hand sides of (3.16) and (3.24): what the six joints have to supply."""
        state = self.state
        joints = slice(6 * i, 6 * i + 6)
        jacobian = np.concatenate([state.point(f"7{i}")[1], state.angular(f"7{i}")], axis=-2)[
            ..., joints
        ]
        if rates:
            return (jacobian @ state.v[..., joints, None])[..., 0]
        later = self.moved(None, False).state
        moved = np.concatenate([later.point(f"7{i}")[1], later.angular(f"7{i}")], axis=-2)
        change = np.imag(moved[..., joints]) / STEP
        return (jacobian @ state.a[..., joints, None] + change @ state.v[..., joints, None])[..., 0]

    def _of_delta_q(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if not symbol.sub:
            return vector(self.state.virtual)
        if symbol.sub == "j":
            return None
        return scalar(self.state.virtual[..., coordinate_index(f"q_{symbol.sub}")])

    def _of_delta_theta(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        name = f"{symbol.base.removeprefix('delta:')}_{symbol.sub}"
        return scalar(self.state.virtual[..., coordinate_index(name)])

    _of_delta_phi = _of_delta_psi = _of_delta_theta
    _of_delta_x = _of_delta_y = _of_delta_z = _of_delta_theta

    def _of_delta_Q(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sup != "0" or symbol.sub not in BODIES:
            return None
        turned = self.state.angular(symbol.sub) @ self.state.virtual[..., None]
        return vector(turned[..., 0])

    def _of_delta_W(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        return scalar((self.state.tau * self.state.virtual[..., 6:]).sum(-1))

    def _of_Q(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub or symbol.sup:
            return None
        torso = np.zeros((*self.state.tau.shape[:-1], 6))
        return vector(np.concatenate([torso, self.state.tau], axis=-1))

    def _of_l(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub not in ("1", "2") or symbol.sup != "0" or symbol.dots:
            return None
        length = self.state.parameters.values[f"b{symbol.sub}_y"][..., None]
        return vector(length * self.state.frame(f"7{symbol.sub}").rotation[..., 1])

    def constraint(self, number: int, interval: int) -> np.ndarray:
        """φ_number of interval T_interval, as (4.15), (4.19), (4.21) say in words.

        1 to 3: components k, j (less the length), i of l; 4 and 5: components j and
        k of the axis of joint 5; 6: component k of link 6's k axis. The right foot
        in T_3, and from 7 on in T_2.
        """
        right = interval == 3 or number > 6
        i, which = (2 if right else 1), (number - 1) % 6 + 1
        if which <= 3:
            component = {1: 2, 2: 1, 3: 0}[which]
            vector_l = self._of_l(Symbol("l", str(i), "0"), {})
            assert vector_l
            offset = self.state.parameters.values[f"b{i}_y"] if which == 2 else 0.0
            return np.asarray(vector_l.array[..., component] - offset)
        if which <= 5:
            axis = self._axis(f"k8{i}")
            assert axis is not None
            return axis[..., {4: 1, 5: 2}[which]]
        return self.state.frame(f"6{i}").rotation[..., 2, 2]

    def _of_varphi(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        limits = {"1": 6, "2": 12, "3": 6}
        if symbol.dots or symbol.sup not in limits or not symbol.sub.isdigit():
            return None
        if not 1 <= int(symbol.sub) <= limits[symbol.sup]:
            return None
        return scalar(self.constraint(int(symbol.sub), int(symbol.sup)))

    def stance_jacobian(self, interval: int) -> np.ndarray:
        """∂(pose of the stance feet)/∂q: linear then angular rows of each, ``(N, J, 6 or 12, 18)``."""
        rows = []
        for i in {1: (1,), 2: (1, 2), 3: (2,)}[interval]:
            rows += [self.state.point(f"7{i}")[1], self.state.angular(f"7{i}")]
        return np.concatenate(rows, axis=-2)

    def _of_Phi(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.sub not in ("1", "2", "3"):
            return None
        interval = int(symbol.sub)
        rows = [self.constraint(k, interval) for k in range(1, 13 if interval == 2 else 7)]
        return vector(np.stack(np.broadcast_arrays(*rows), axis=-1))

    # -- momentum and ZMP -----------------------------------------------------------------

    def _of_cal_P(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots or symbol.sub not in ("", "x", "y", "z"):
            return None
        total = sum(
            self.state.parameters.values[f"m_{body}"][..., None]
            * self._moving(self.state.centre(body), 1)
            for body in BODIES
        )
        return _component(np.asarray(total), symbol.sub)

    def _of_cal_L(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.dots or symbol.sub not in ("", "x", "y", "z"):
            return None
        total: np.ndarray | float = 0.0
        for body in BODIES:
            where, rate = (self._moving(self.state.centre(body), k) for k in (0, 1))
            mass = self.state.parameters.values[f"m_{body}"][..., None]
            omega = vee(self._rate(self.state.frame(body)))
            spin = (self.state.inertia(body) @ omega[..., None])[..., 0]
            total = total + np.cross(where, mass * rate) + spin
        return _component(np.asarray(total), symbol.sub)

    def _of_ZMP(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        """The point of a floor at height 0.01 m where the floor's wrench has no tilting moment."""
        height = 0.01
        if symbol.sub == "z":
            return scalar(height)
        later = self.moved(None, False)
        force: np.ndarray | float = 0.0
        moment: np.ndarray | float = 0.0
        for body in BODIES:
            mass = self.state.parameters.values[f"m_{body}"][..., None]
            where = self.state.centre(body)[0]
            fast = np.imag(later._moving(later.state.centre(body), 1)) / STEP
            omega = vee(later._rate(later.state.frame(body)))
            turn = np.imag((later.state.inertia(body) @ omega[..., None])[..., 0]) / STEP
            inertial = mass * (fast + [0, 0, GRAVITY])
            force = force + inertial
            moment = moment + np.cross(where, inertial) + turn
        force, moment = np.asarray(force), np.asarray(moment)
        if symbol.sub == "x":
            return scalar((height * force[..., 0] - moment[..., 1]) / force[..., 2])
        return scalar((height * force[..., 1] + moment[..., 0]) / force[..., 2])


def _component(total: np.ndarray, which: str) -> Value:
    return scalar(total[..., "xyz".index(which)]) if which else vector(total)


def _arctan2(y: np.ndarray, x: np.ndarray) -> np.ndarray:
    """atan2 that carries a complex step."""
    if not (np.iscomplexobj(y) or np.iscomplexobj(x)):
        return np.arctan2(y, x)
    slope = (np.real(x) * np.imag(y) - np.real(y) * np.imag(x)) / (
        np.real(x) ** 2 + np.real(y) ** 2
    )
    return np.arctan2(np.real(y), np.real(x)) + 1j * slope
