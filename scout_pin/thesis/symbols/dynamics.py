"""Jacobians, energies, D, V and C (4.1 to 4.4, 4.7)."""

from __future__ import annotations

import re
from functools import cached_property

import numpy as np

from scout_pin.thesis.state import BODIES, coordinate_index
from scout_pin.thesis.symbols.vectors import Vectors
from thesis_pin.equations import lagrangian
from thesis_pin.equations.formula import Node, Symbol
from thesis_pin.equations.values import STEP, Value, matrix, scalar, vector
from thesis_pin.tolerances import GRAVITY


def element(array: np.ndarray, name: str) -> Value | None:
    """A vector ``(N, 1, n)``, or its element called "3"; "j" is all of them along axis 1."""
    if not name:
        return vector(array)
    if name == "j":
        return scalar(array[:, 0, :])
    if not name.isdigit() or not 1 <= int(name) <= array.shape[-1]:
        return None
    return scalar(array[..., int(name) - 1])


def _rows(array: np.ndarray, name: str) -> Value | None:
    """A matrix ``(N, n, n)``, or its row called "3"; "j" is all of them along axis 1."""
    if not name:
        return matrix(array[:, None])
    if name == "j":
        return matrix(array[:, :, None, :])
    if not name.isdigit() or not 1 <= int(name) <= array.shape[-2]:
        return None
    return matrix(array[:, None, int(name) - 1, None, :])


class Dynamics(Vectors):
    """What follows from the bodies' Jacobians and masses."""

    def _special_derivative(self, of: Node, by: Symbol | None) -> Value | None:
        of_L = isinstance(of, Symbol) and of.name == "L" and not of.dots
        if of_L and by is not None and by.dots == 1:
            return self._momentum(by)
        return None

    def _momentum(self, by: Symbol) -> Value:
        """∂L/∂q̇_j = (N q̇)_j, so that its time derivative needs one complex step only."""
        mass = lagrangian.mass_matrix(list(self.bodies.values()))
        momentum = (mass @ self.state.v[..., None])[..., 0]
        if by.sub == "j":
            return scalar(momentum[:, 0, :])
        return scalar(momentum[..., coordinate_index(by.name)])

    def _of_T(self, symbol: Symbol, i: str) -> Value | None:
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
        placement = self.state.frame(last).value
        if first != "0":
            placement = np.linalg.inv(self.state.frame(first).value) @ placement
        return matrix(placement)

    def _of_J(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.sup or symbol.sub not in BODIES:
            return None
        return matrix(self.state.centre(symbol.sub)[1])

    def _of_W(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.sup or symbol.sub not in BODIES:
            return None
        return matrix(self.state.angular(symbol.sub))

    def _of_I(self, symbol: Symbol, i: str) -> Value | None:
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
        return np.asarray(
            GRAVITY * mass * (self.bodies[body].centre * self.state.own("k0")).sum(-1)
        )

    def _of_L(self, symbol: Symbol, i: str) -> Value | None:
        bodies = [symbol.sub] if symbol.sub in BODIES else list(BODIES) if not symbol.sub else []
        if not bodies or symbol.dots or symbol.sup:
            return None
        return scalar(sum(self._kinetic(body) - self._potential(body) for body in bodies))

    def _of_N(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.sup or symbol.sub not in BODIES:
            return None
        return matrix(lagrangian.mass_matrix([self.bodies[symbol.sub]]))

    def _row(self, array: np.ndarray) -> Value:
        """Row j of a matrix ``(N, 1, 18, 18)``, with j along axis 1."""
        return matrix(array[:, 0, :, None, :])

    def _of_D(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub[:-1] not in BODIES or symbol.sub[-1:] != "j" or symbol.dots:
            return None
        return self._row(self.lookup(Symbol("N", symbol.sub[:-1]), {}).array)

    def _of_V(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.sup or symbol.primes > (symbol.sub[-1:] == "j"):
            return None
        if not symbol.bold and symbol.sub in BODIES:
            return scalar(self._potential(symbol.sub))
        body, j = symbol.sub[:-1], symbol.sub[-1:]
        if symbol.bold and symbol.sub in ("1", "2"):
            return vector(self._foot_side(int(symbol.sub), rates=True))
        if body not in BODIES or j != "j":
            return None
        kind = Symbol("N", body)
        if symbol.primes == 0:
            return self._row(self.partial(kind, None, {}).array)
        varied = self.partial(kind, Symbol("q", "j"), {}).array
        return matrix(0.5 * np.einsum("nok,njkl->njl", self.state.v, varied)[..., None, :])

    def _of_C(self, symbol: Symbol, i: str) -> Value | None:
        body, j = symbol.sub[:-1], symbol.sub[-1:]
        unknown = symbol.dots or symbol.sup or symbol.primes != 1
        if body not in BODIES or j != "j" or unknown:
            return None
        weight = -GRAVITY * self.state.parameters.values[f"m_{body}"]
        raised = (self.state.centre(body)[1] * self.state.own("k0")[..., None]).sum(axis=-2)
        return scalar(weight * raised[:, 0])

    @cached_property
    def terms(self) -> lagrangian.Terms:
        """D, V and C of the whole robot, shape ``(N, …)``."""
        time, varied = (
            lagrangian.exact_rates(list(self.moved(along).bodies.values()))
            for along in (None, "q_j")
        )
        bodies = list(self.bodies.values())
        up = self.state.own("k0")
        terms = lagrangian.assemble(bodies, time, varied[:, None], self.state.v, up)
        return lagrangian.Terms(*(x[:, 0] for x in vars(terms).values()))

    def _of_bb_D(self, symbol: Symbol, i: str) -> Value | None:
        return _rows(self.terms.mass, symbol.sub)

    def _of_bb_V(self, symbol: Symbol, i: str) -> Value | None:
        return _rows(self.terms.velocity, symbol.sub)

    def _of_bb_C(self, symbol: Symbol, i: str) -> Value | None:
        return element(self.terms.gravity[:, None], symbol.sub)

    def _foot_side(self, i: int, rates: bool) -> np.ndarray:
        """Right-hand sides of (3.16) and (3.24): what the six joints have to supply."""
        state = self.state
        joints = slice(6 * i, 6 * i + 6)
        jacobian = np.concatenate([state.point(f"7{i}")[1], state.angular(f"7{i}")], axis=-2)[
            ..., joints
        ]
        if rates:
            return np.asarray((jacobian @ state.v[..., joints, None])[..., 0])
        later = self.moved(None).state
        moved = np.concatenate([later.point(f"7{i}")[1], later.angular(f"7{i}")], axis=-2)
        change = np.imag(moved[..., joints]) / STEP
        return np.asarray(
            (jacobian @ state.a[..., joints, None] + change @ state.v[..., joints, None])[..., 0]
        )
