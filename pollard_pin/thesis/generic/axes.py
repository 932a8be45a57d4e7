"""A robot built like this one whose joints turn about axes that point anywhere.

On the mechanism a joint's axis is at right angles to the next, and an offset lies along an axis:
k_4 × (j_2 × r) is j_2 times a component of r that no turn about k_4 changes, so that a slip in
θ54 there shows nowhere. Here every joint's axis has a direction of its own, drawn in the frame
that it turns from; those of θ21 and θ43 alone stay parallel. The loops are open, every joint
depends on every coordinate, and V on all that the thesis lists. A line that says how a vector
changes with an angle holds here as well.

Source: Pollard thesis, 3.3.2, 3.5.2.
"""

from __future__ import annotations

import functools
import zlib
from functools import cached_property
from typing import Self

import numpy as np

from pollard_pin.thesis.state import CHAIN_0, JOINTS, POSE, Matrices, State, own_name, random_state
from pollard_pin.thesis.symbols import frames
from pollard_pin.thesis.symbols.bodies import random_constants, turned
from pollard_pin.thesis.symbols.k import VECTORS, KSymbols
from pollard_pin.thesis.symbols.loops import PATHS
from pollard_pin.thesis.symbols.motion import Drive
from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.values import Value, scalar, vector
from thesis_pin.numeric.rotations import rotation

_STATES, _SEED = 4, 332
_LETTERS = "ijk"
_PARALLEL = {"theta_43": "theta_21"}
"""Joint → the one it is parallel to: ∂j_3/∂q_j = 0 is what the thesis builds on."""


@functools.cache
def bend(angle: str) -> np.ndarray:
    """What turns a printed axis into that of the joint of an angle, ``(3, 3)``."""
    name = _PARALLEL.get(angle, angle)
    drawn = np.random.default_rng(zlib.crc32(name.encode())).uniform(0.4, 1.1, 3)
    return np.asarray(rotation("x", drawn[0]) @ rotation("y", drawn[1]) @ rotation("z", drawn[2]))


class BentState(State):
    """States on such a robot."""

    def after(
        self, placement: Matrices, move: str, by: str, i: str = "", sign: int = 1
    ) -> Matrices:
        """As its parent does, about the joint's own axis."""
        name = own_name(by, i)
        if name not in JOINTS:
            return super().after(placement, move, by, i, sign)
        bent = np.eye(4)
        bent[:3, :3] = bend(name)
        return super().after(placement @ bent, move, by, i, sign) @ bent.T


class AnyAxes(KSymbols):
    """Symbols of 3.3 and 3.5 on such a robot."""

    @classmethod
    def drawn(cls) -> Self:
        """Seeded states of robots with random bodies."""
        generator = np.random.default_rng(_SEED)
        one = random_state(generator, _STATES, closed=False, slanted=True)
        constants = one.constants | random_constants(generator, _STATES)
        state = BentState(constants, one.variables, one.rates)
        still = np.zeros((_STATES, 6))
        return cls(state, Drive(still, still[:, :3], still))

    @cached_property
    def rows(self) -> dict[str, np.ndarray]:
        """Every joint's rate over the pose's, free."""
        return {name: _random(name, 6) for name in JOINTS}

    def _stepped(self, along: str | None, rates: bool) -> Self:
        """As its parent does, but for the loops, which are open."""
        return type(self)(self._state(along, rates), self.drive)

    def skew(self, axis: str, argument: Node, indices: dict[str, str]) -> np.ndarray | None:
        """What turns the axis of a printed rotation into the joint's, ``(3, 3)``."""
        if not isinstance(argument, Symbol):
            return None
        name = argument.bound(indices).name
        return bend(name) if name in JOINTS else None

    def _axis(self, symbol: Symbol, i: str) -> Value | None:
        """An axis about which a joint turns, as the frame carries it that the joint turns from."""
        column = _LETTERS.index(symbol.base)
        angle = frames.joint("xyz"[column], symbol.sub, i)
        found = super()._axis(symbol, i)
        if angle not in JOINTS or found is None:
            return found
        own = bend(angle)[:, column]
        if frames.own_axis(symbol, i):
            return vector(own)
        named = self._frame(symbol.sub) if symbol.sub not in PATHS else (symbol.sub, i)
        return vector(turned(self.state, *named) @ own) if named else None

    _of_i = _of_j = _axis

    def _of_J(self, symbol: Symbol, i: str) -> Value | None:
        return self._derivative_matrix(symbol, i)

    def _of_V(self, symbol: Symbol, i: str) -> Value | None:
        """Any V of chain 0: it depends on all that it is said to depend on."""
        if symbol.sub or symbol.bold or symbol.dots or symbol.primes or symbol.sup:
            return super()._of_V(symbol, i)
        found = [np.sin(self.state.number(name) + 2.0 * k) for k, name in enumerate(_OF_V)]
        return scalar(np.sum(np.broadcast_arrays(*found), axis=0))


_OF_V = (*CHAIN_0, *POSE)


def _random(name: str, columns: int) -> np.ndarray:
    """Numbers away from zero that only their name decides, ``(states, columns)``."""
    generator = np.random.default_rng(zlib.crc32(name.encode()))
    size = (_STATES, columns)
    return np.asarray(generator.uniform(0.5, 2.0, size) * generator.choice([-1.0, 1.0], size))


def slopes(catalogue: Catalogue, equation: Equation) -> bool:
    """Whether a line says how a vector k, or V, changes with an angle or a coordinate."""
    if equation.claim or not equation.printed:
        return False
    try:
        left = catalogue.parse(equation.left)
        members = (*equation.printed, *equation.mending.values())
        used = set().union(*(nt.symbols(catalogue.parse(text)) for text in members if text))
    except FormulaError:
        return False
    return _is_slope(left) and all(map(_is_known, used))


def _is_slope(left: Node) -> bool:
    if isinstance(left, nt.Derivative):
        of = left.of
        if not isinstance(of, Symbol) or of.sup or of.dots or of.primes:
            return False
        varies = of.sub in VECTORS if of.base == "k" else of.name == "V" and not of.bold
        return varies and left.by == Symbol("q", "j")
    if not isinstance(left, Symbol) or left.base != "J" or left.sup or left.dots:
        return False
    chain = "i" if left.sub.endswith("i") else ""
    number = left.sub.removeprefix("theta").removesuffix("i")
    return any(f"{one}{chain}" in VECTORS for one in (number, number[:-1]))


def _is_known(symbol: Symbol) -> bool:
    return symbol.base in (*_LETTERS, "r", "theta", "beta", "psi", "phi", *"xyz", "q", "V")
