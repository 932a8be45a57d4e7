"""What each symbol of the thesis must equal, computed without its formulas.

Geometry comes from :mod:`pollard_pin.thesis.state`: products of elementary
transforms, differentiated factor by factor. From these follow, by definition
and not by the thesis's derivations:

========================  ====================================================
symbol                    reference
========================  ====================================================
T                         products of elementary transforms
a, b, c, d                elements of T_LDn, T_LDn2, T_LDn3, T_LDi (2.24 – 2.110)
Ec, X, Y, Z               last columns of the two sides of (2.3) and (2.90)
A, B, C                   Fourier coefficients of |Ec_1|² − |Ec_2|² in θ21, of
                          |Ec_3|² − |Ec_4|² in θ21i
V                         coefficients of the rates, :mod:`pollard_pin.thesis.symbols.rates`
E                         denominators times the closed mechanism's joint rates
G                         coefficients of the accelerations,
                          :mod:`pollard_pin.thesis.symbols.accelerations`
R, r; i, j, k, framed     rotations, differences of origins; columns of a rotation
v, ω                      their derivatives along the joints' rates
k_1, k_3 … (vectors)      ∂r_G/∂θ by the one angle they multiply
k_2, k_6 … (rows)         joint rates of the closed mechanism
J_n, J'_n of a k_n        its derivatives by the angles of a chain
M, N, L                   the bodies' Jacobians, inertias and energies
D, V, C                   :mod:`thesis_pin.equations.lagrangian` on those Jacobians
Q, q̈                      what the equation of motion leaves; what the three base
                          motors alone produce, so that Q = J_τᵀ τ as 3.6 supposes
r_p; r_A … r_L            appendix A: the spray tip; derivatives of the wrist, a rod's
                          end and its ball joint by one angle
J_θ, J_q, J_β, J_k        appendix A: the same, all angles of a chain
========================  ====================================================

A dot is a complex step along the rates; two dots in chapter 2 a Taylor
coefficient along rates and accelerations; ∂/∂q_j a complex step along q_j with
the loops closed, ∂/∂θ one of that angle alone.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Self

import numpy as np

from pollard_pin.thesis.state import POSE, State
from pollard_pin.thesis.symbols.accelerations import accelerating
from pollard_pin.thesis.symbols.appendix_a import AppendixA
from pollard_pin.thesis.symbols.bodies import random_constants
from pollard_pin.thesis.symbols.dynamics import MOTORS, Dynamics
from pollard_pin.thesis.symbols.motion import Drive
from pollard_pin.thesis.symbols.positions import Positions
from pollard_pin.thesis.symbols.rates import joint_rates


class OpenReferences(Positions):
    """Chapter 2's symbols, where nothing of the loops is assumed."""


class LoopReferences(AppendixA):
    """Appendix A's symbols at closed states, which it calls by names of other things."""

    @classmethod
    def at(cls, state: State) -> LoopReferences:
        """The symbols at closed states; appendix A has no forces and no accelerations."""
        (size,) = state.shape
        return cls(state, Drive(np.zeros((size, 6)), np.zeros((size, 3)), np.zeros((size, 6))))


class References(Dynamics):
    """All other symbols, at closed states."""

    @classmethod
    def driven(cls, state: State, generator: np.random.Generator) -> Self:
        """Closed states with random bodies, moved by random torques of the three base motors."""
        (size,) = state.shape
        state = replace(state, constants={**state.constants, **random_constants(generator, size)})
        torque = generator.uniform(-500, 500, (size, 3))
        virtual = generator.uniform(-1, 1, (size, 6))
        still = cls(state, Drive(np.zeros((size, 6)), torque, virtual))
        rows = joint_rates(state)
        force = sum(torque[:, k, None] * rows[name] for k, name in enumerate(MOTORS))
        rest = force - still.generalized_force
        acceleration = np.linalg.solve(still.terms.mass, rest[..., None])[..., 0]
        bent = replace(state, accelerations=dict(zip(POSE, acceleration.T, strict=True)))
        return cls(accelerating(bent), Drive(acceleration, torque, virtual))


class SlantedReferences(References):
    """Symbols of the side chains where nothing of them vanishes by the thesis's geometry.

    An arm's offset lies along its axis, which is upright: turning doesn't move its end, nor
    lift the arm. On slanted states it does the first, and this gravity does the second.
    """

    gravity = np.array([3.0, -4.0, -8.0])
