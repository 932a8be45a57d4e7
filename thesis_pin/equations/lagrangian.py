"""D, V and C assembled from the bodies' Jacobians and their derivatives.

Both theses write the equations of motion as ``D q̈ + V q̇ + C`` with

    N = Σ m JᵀJ + Wᵀ I W,   D = N,   V = Ṅ − ½ [q̇ᵀ ∂N/∂q_j]_j,   C = −Σ m ∂(gᵀb)/∂q

(J, W: Jacobians of a body's centre of mass and of its angular velocity; I its
inertia in world axes). V isn't Pinocchio's Coriolis matrix: only V q̇ compares.

Source: Scout thesis, 4.2 to 4.4 and 4.7; Pollard thesis, chapter 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.equations.values import STEP
from thesis_pin.tolerances import GRAVITY

_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Body:
    """One rigid body at a batch of states.

    Attributes:
        mass: Mass [kg], broadcasts with the batch.
        inertia: Centroidal inertia in world axes [kg·m²], shape ``(..., 3, 3)``.
        linear: Jacobian of the centre of mass, shape ``(..., 3, n)``.
        angular: Jacobian of the angular velocity, shape ``(..., 3, n)``.
        centre: Centre of mass in the world [m], shape ``(..., 3)``.
    """

    mass: np.ndarray
    inertia: np.ndarray
    linear: np.ndarray
    angular: np.ndarray
    centre: np.ndarray


@dataclass(frozen=True)
class Terms:
    """Terms of the equations of motion.

    Attributes:
        mass: D, shape ``(..., n, n)``.
        velocity: V, shape ``(..., n, n)``.
        gravity: C [N], [N·m], shape ``(..., n)``.
        rate: Ṅ, the time derivative of D, shape ``(..., n, n)``.
    """

    mass: np.ndarray
    velocity: np.ndarray
    gravity: np.ndarray
    rate: np.ndarray


def _transpose(matrix: np.ndarray) -> np.ndarray:
    return np.swapaxes(matrix, -1, -2)


def mass_matrix(bodies: Sequence[Body]) -> np.ndarray:
    """N = Σ m JᵀJ + Wᵀ I W, shape ``(..., n, n)``; complex bodies carry a step through."""
    total: np.ndarray | float = 0.0
    for body in bodies:
        mass = np.asarray(body.mass)[..., None, None]
        total = (
            total
            + mass * (_transpose(body.linear) @ body.linear)
            + _transpose(body.angular) @ body.inertia @ body.angular
        )
    return np.asarray(total)


def kinetic_energy(body: Body, rates: np.ndarray) -> np.ndarray:
    """½ m ḃ² + ½ ωᵀ I ω [J] at rates ``(..., n)``."""
    velocity = (body.linear @ rates[..., None])[..., 0]
    omega = (body.angular @ rates[..., None])[..., 0]
    spin = (body.inertia @ omega[..., None])[..., 0]
    return np.asarray(0.5 * (body.mass * (velocity * velocity).sum(-1) + (omega * spin).sum(-1)))


def exact_rates(moved: Sequence[Body]) -> np.ndarray:
    """Derivative of N from bodies moved by an imaginary step."""
    return np.imag(mass_matrix(moved)) / STEP


def assemble(
    bodies: Sequence[Body],
    rate: np.ndarray,
    varied: np.ndarray,
    rates: np.ndarray,
    up: np.ndarray = _UP,
) -> Terms:
    """D, V and C.

    Args:
        bodies: The bodies.
        rate: Ṅ, shape ``(..., n, n)``.
        varied: ∂N/∂q_j, shape ``(..., n, n, n)`` with j first of the three.
        rates: q̇, shape ``(..., n)``.
        up: Which way weight is lifted, shape ``(..., 3)``.
    """
    half = 0.5 * np.einsum("...k,...jkl->...jl", rates, varied)
    weight = sum(
        GRAVITY * np.asarray(body.mass)[..., None] * (up[..., None] * body.linear).sum(axis=-2)
        for body in bodies
    )
    return Terms(mass_matrix(bodies), rate - half, np.asarray(weight), rate)
