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
    """Terms of the equations of motion; the first axis is the state.

    Attributes:
        mass: D, shape ``(N, n, n)``.
        velocity: V, shape ``(N, n, n)``.
        gravity: C [N], [N·m], shape ``(N, n)``.
        rate: Ṅ, the time derivative of D, shape ``(N, n, n)``.
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
    return 0.5 * (body.mass * (velocity * velocity).sum(-1) + (omega * spin).sum(-1))


def exact_rates(moved: Sequence[Body], step: float) -> np.ndarray:
    """Derivative of N from bodies moved by an imaginary step of that length."""
    return np.imag(mass_matrix(moved)) / step


def assemble(
    bodies: Sequence[Body],
    rate: np.ndarray,
    varied: np.ndarray,
    rates: np.ndarray,
    gravity: float,
) -> Terms:
    """D, V and C.

    Args:
        bodies: The bodies, arrays of shape ``(N, 1, ...)``.
        rate: Ṅ, shape ``(N, 1, n, n)``.
        varied: ∂N/∂q_j with j along axis 1, shape ``(N, n, n, n)``.
        rates: q̇, shape ``(N, 1, n)``.
        gravity: Gravitational acceleration along −z [m/s²].

    Returns:
        The terms, without axis 1.
    """
    mass = mass_matrix(bodies)[:, 0]
    half = 0.5 * np.einsum("nok,njkl->njl", rates, varied)
    weight = sum(
        gravity * np.asarray(body.mass)[..., None] * body.linear[..., 2, :] for body in bodies
    )
    return Terms(mass, rate[:, 0] - half, np.asarray(weight)[:, 0], rate[:, 0])
