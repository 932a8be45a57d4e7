"""Frames, points, their velocities and derivatives on closed states (3.2 to 3.5)."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from pollard_pin.thesis.state import CHAIN_0, JOINTS, POSE, State, own_name
from pollard_pin.thesis.symbols import frames
from pollard_pin.thesis.symbols.bodies import BODIES, centre, origin, own_frame, turned
from pollard_pin.thesis.symbols.loops import PATHS, between, placement
from pollard_pin.thesis.symbols.positions import Positions
from pollard_pin.thesis.symbols.rates import derivative, explicit_rates, joint_rates, moving
from thesis_pin.equations.dual import dual
from thesis_pin.equations.formula import Node, Symbol
from thesis_pin.equations.frames import Frames
from thesis_pin.equations.values import ZERO, Value, imaginary, matrix, scalar, vector

SIDE_I = ("theta_21i", "theta_65i", "theta_76i")
"""Angles of a side chain without its ball joint: β (3.137)."""

_SPINS = {
    **{"21": ("2", "theta_21"), "43": ("4", "theta_43"), "54": ("5", "theta_54")},
    **{"1615": ("16", "theta_1615"), "1716": ("17", "theta_1716"), "1817": ("18", "theta_1817")},
    **{"21i": ("2i", "theta_21i"), "65i": ("6i", "theta_65i"), "76i": ("7i", "theta_76i")},
}
"""Relative angular velocities: frame that turns, angle."""

_COORDINATES = {f"q_{k}": name for k, name in enumerate(POSE, start=1)}
_PRIMES = {"J": 3, "V": 1, "C": 1, "D": 1, "bb:V": 1}
"""Letters that the thesis writes with primes, and how many at most."""
_GENERIC = "2"
"""The body that stands for "a body" in (3.2), (3.3)."""


@dataclass(frozen=True)
class Drive:
    """What moves the mechanism.

    Attributes:
        acceleration: q̈, shape ``(n, 6)``.
        torque: Of the three base motors [N·m], shape ``(n, 3)``.
        virtual: Virtual displacement δq, shape ``(n, 6)``.
    """

    acceleration: np.ndarray
    torque: np.ndarray
    virtual: np.ndarray


class MotionSymbols(Positions):
    """Symbols of 3.2 and 3.4 at closed states, and derivatives of any formula."""

    def __init__(self, state: State, drive: Drive, *, explicit: bool = False) -> None:
        super().__init__(state)
        self.drive, self.explicit = drive, explicit

    # -- derivatives -----------------------------------------------------------

    def _find(self, symbol: Symbol, i: str) -> Value | None:
        numbered = re.fullmatch(r"(\w+)\(([12])\)", symbol.sub)
        if numbered:  # k_{2(1)}: what k_2i is on chain 1
            symbol, i = replace(symbol, sub=f"{numbered[1]}i", kept="i"), numbered[2]
        value = self._answer(symbol, i)
        value = super()._find(symbol, i) if value is None else value
        return self._differentiated(symbol, i) if value is None else value

    def _answer(self, symbol: Symbol, i: str) -> Value | None:
        """What the method for a symbol's letter says; most know nothing of dots and primes."""
        dotted = symbol.dots and symbol.base != "q"
        primed = symbol.primes > _PRIMES.get(symbol.base, 0)
        return None if dotted or primed else super()._answer(symbol, i)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative of a formula by a coordinate, an angle, a rate or time."""
        of = of.bound(indices) if isinstance(of, Symbol) else of
        if isinstance(of, Symbol) and of.name == "q" and by is not None and by.base == "q":
            unit = np.eye(6)[:, None] if by.sub == "j" else np.eye(6)[int(by.sub) - 1]
            return vector(unit) if of.dots == by.dots else ZERO
        if isinstance(of, Symbol) and of.base == "k" and of.primes == 1 and by is not None:
            return imaginary(self.moved("pose").lookup(replace(of, primes=0), indices))
        by = (
            replace(by, base=_COORDINATES[by.name], sub="")
            if by and by.name in _COORDINATES
            else by
        )
        return super().partial(of, by, indices)

    def _stepped(self, along: str | None, rates: bool) -> Self:
        """The same symbols one imaginary step away.

        Along "q_j" with the loops closed, j on the first axis; "pose" for the same with
        all angles held; one angle or coordinate alone; None for time.
        """
        follows = along in (None, "q_j")
        state = self._state(along, rates)
        return type(self)(moving(state) if follows else state, self.drive, explicit=not follows)

    def _state(self, along: str | None, rates: bool) -> State:
        state = self.state
        unit = dict(zip(POSE, np.eye(6)[:, :, None], strict=True))
        if along is None:
            moved = state.step(state.rates)
            gained = dict(zip(POSE, np.moveaxis(self.drive.acceleration, -1, 0), strict=True))
            return moved.step(gained, rates=True)
        if rates:
            return state.step(unit if along == "q_j" else {along: 1.0}, rates=True)
        if along == "q_j":
            turning = {name: np.moveaxis(row, -1, 0) for name, row in self.rows.items()}
            return state.step({**unit, **turning})
        return state.step(unit if along == "pose" else {along: 1.0})

    @cached_property
    def rows(self) -> dict[str, np.ndarray]:
        """Joint rates over the pose's, ``(..., n, 6)`` each."""
        return explicit_rates(self.state) if self.explicit else joint_rates(self.state)

    def _along_rates(self, of: Callable[[State], object]) -> np.ndarray:
        """Derivative along the rates of all joints."""
        return derivative(of, self.state, {name: self.state.rates[name] for name in JOINTS})

    # -- frames ----------------------------------------------------------------

    def turning(self, axis: str, argument: Node, indices: dict[str, str]) -> Frames:
        """Frames of a rotation by an angle of the mechanism or the pose."""
        return frames.of_rotation(axis, argument, indices)

    def _frames(self, symbol: Symbol, value: Value, i: str) -> Frames:
        return frames.of_symbol(symbol, value.tail, i)

    # -- geometry --------------------------------------------------------------

    @staticmethod
    def _frame(name: str) -> tuple[str, str] | None:
        """Frame and chain: "16" → ("16", ""); "21" → ("2i", "1"); "2i" stays."""
        if name in PATHS:
            return name, ""
        if name[-1:] in ("1", "2") and f"{name[:-1]}i" in PATHS:
            return f"{name[:-1]}i", name[-1]
        return None

    def _of_R(self, symbol: Symbol, i: str) -> Value | None:
        frame = self._frame(symbol.sub)
        if frame is None or symbol.dots or symbol.sup != "0":
            return None
        return matrix(turned(self.state, *frame))

    def _position(self, sub: str, i: str) -> Callable[[State], object] | None:
        """The vector r_sub as a function of states."""
        body = sub.removeprefix("G") or _GENERIC
        if sub.startswith("G") and body in BODIES:
            return lambda s: centre(s, body)
        body = body.removesuffix("'")
        if sub.startswith("G") and body in BODIES:
            frame = own_frame(body)
            return lambda s: centre(s, body) - origin(s, *frame)
        sub = sub if i else sub.removesuffix("i")  # r_14,5i is the same for every chain
        if between(self.state, sub, i) is None:
            return None
        return lambda s: between(s, sub, i)

    def _of_r(self, symbol: Symbol, i: str) -> Value | None:
        of = self._position(symbol.sub, i)
        if of is None or symbol.dots:
            return None
        if symbol.sup == "0" or (symbol.sub == "G" and not symbol.sup):
            return vector(np.asarray(of(self.state)))
        frame = self._frame(symbol.sup)
        if frame is None:
            return None
        back = np.swapaxes(turned(self.state, *frame), -1, -2)
        return vector((back @ np.asarray(of(self.state))[..., None])[..., 0])

    def _of_v(self, symbol: Symbol, i: str) -> Value | None:
        of = self._position(symbol.sub or "G", i)
        if of is None or symbol.dots or symbol.sup not in ("0", ""):
            return None
        return vector(self._along_rates(of))

    def _of_omega(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.sup not in ("0", ""):
            return None
        sub = symbol.sub or own_frame(_GENERIC)[0]
        if sub not in _SPINS and sub not in PATHS and sub[-1:] in ("1", "2"):
            sub, i = f"{sub[:-1]}i", sub[-1]  # ω_212: ω_21i with i = 2
        if sub in _SPINS:
            frame, angle = _SPINS[sub]
            along = {own_name(angle, i): self.state.rates[own_name(angle, i)]}
        elif sub in PATHS:
            frame = sub
            along = {name: self.state.rates[name] for name in JOINTS}
        else:
            return None
        moved = dual(placement(self.state.towards({None: along}), PATHS[frame], i))
        return vector(moved.axis(None))

    def _axis(self, symbol: Symbol, i: str) -> Value | None:
        column = "ijk".index(symbol.base)
        if frames.own_axis(symbol, i):
            return vector(np.eye(3)[column])
        frame = (symbol.sub, i) if symbol.sub in PATHS else self._frame(symbol.sub)
        if frame is None or symbol.dots or symbol.sup != "0":
            return None
        return vector(turned(self.state, *frame)[..., column])

    _of_i = _of_j = _of_k = _axis

    def _length(self, symbol: Symbol, i: str) -> Value | None:
        """Lengths whose index differs from chapter 2's, and components of r_G'."""
        centred = re.fullmatch(r"G(\d[12]?)'?", symbol.sub)
        if centred and centred[1] in BODIES and not symbol.dots:
            local = self.state.constants[f"centre {centred[1]}"]
            return scalar(local[..., "xyz".index(symbol.base)])
        names = {"145": "x_65", "1514": "x_1514"}
        own = symbol.sub.removesuffix(i or "i")
        if symbol.base == "x" and own in names and not symbol.dots:
            return scalar(self.state.number(names[own]))
        return None

    _of_x = _of_y = _of_z = _length

    def _angles(self, symbol: Symbol, i: str) -> Value | None:
        """θ = (θ21, θ43, θ54) and β = (θ21i, θ65i, θ76i) as vectors (3.79, 3.137)."""
        if not symbol.bold or symbol.sub or symbol.dots:
            return None
        names = CHAIN_0[:3] if symbol.base == "theta" else SIDE_I
        if symbol.base == "beta" and not i:
            return None
        return vector(np.stack([self.state.number(name, i) for name in names], axis=-1))

    _of_theta = _of_beta = _angles
