"""The two ways to write where the biped is: the thesis's eighteen numbers, a free flyer's.

Source: Scout thesis, 3.1 and (4.2).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from thesis_pin.errors import BadInput, SingularPose
from thesis_pin.numeric.arrays import finite_array, together
from thesis_pin.numeric.rotations import euler_placement, euler_rate_matrix, quaternions
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory
from thesis_pin.numeric.vectors import cross, into, rows
from thesis_pin.tolerances import TOLERANCES

POSE_NAMES = ("x", "y", "z", "pitch", "roll", "yaw")
"""x lateral, y forward, z up [m]; then the thesis's Euler angles θ, φ, ψ [rad]:
rotation = Rx(pitch) Ry(roll) Rz(yaw)."""


def to_free_flyer(
    q: Any, v: Any = None, a: Any = None
) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
    """Thesis coordinates (4.2) and their derivatives → free-flyer q, v, a.

    Args:
        q: Thesis vector, shape ``(..., 18)``.
        v: q̇, shape ``(..., 18)``.
        a: q̈, shape ``(..., 18)``; needs v.

    Returns:
        q ``(..., 19)``, v ``(..., 18)``, a ``(..., 18)``; the root's velocity is
        linear then angular, in the torso's axes, as Pinocchio has it.
    """
    q, rates, second = _motion(finite_array("q", q, 18), v, a)
    matrix, omega, alpha = euler_placement("xyz", q[..., 3:6], rates[..., 3:6], second[..., 3:6])
    position = np.concatenate([q[..., :3], _quaternion(matrix), q[..., 6:]], axis=-1)
    if v is None:
        return position, None, None
    v, a = rates, None if a is None else second
    local = _in_axes(matrix, np.stack([v[..., :3], omega], axis=-2))
    velocity = np.concatenate([local[..., 0, :], local[..., 1, :], v[..., 6:]], axis=-1)
    if a is None:
        return position, velocity, None
    local_a = _in_axes(matrix, np.stack([a[..., :3], alpha], axis=-2))
    # Pinocchio differentiates the components in the moving axes.
    linear = local_a[..., 0, :] - np.cross(local[..., 1, :], local[..., 0, :])
    acceleration = np.concatenate([linear, local_a[..., 1, :], a[..., 6:]], axis=-1)
    return position, velocity, acceleration


def to_thesis(
    q: Any, v: Any = None, a: Any = None
) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
    """Free-flyer q, v, a → thesis coordinates (4.2) and their derivatives.

    Args:
        q: Shape ``(..., 19)``.
        v: Shape ``(..., 18)``.
        a: Shape ``(..., 18)``; needs v.

    Returns:
        q, q̇, q̈, each ``(..., 18)``.

    Raises:
        SingularPose: φ_B = ±90°, where θ_B and ψ_B can't be told apart.
    """
    q, given, second = _motion(finite_array("q", q, 19), v, a)
    if not np.linalg.norm(q[..., 3:7], axis=-1).all():
        raise BadInput("a quaternion in q[3:7] is zero", allowed="unit quaternions")
    matrix = _rotation_matrix(q[..., 3:7])
    cosine = np.hypot(matrix[..., 0, 0], matrix[..., 0, 1])
    if (cosine < TOLERANCES.near_singular).any():
        k = int(np.argmax(np.atleast_1d(cosine) < TOLERANCES.near_singular))
        raise SingularPose(
            "φ_B is ±90°, where θ_B and ψ_B turn about the same axis",
            where=f"sample {k}",
            remedy='Use root="free_flyer"',
        )
    angles = np.stack(
        [
            np.arctan2(-matrix[..., 1, 2], matrix[..., 2, 2]),
            np.arctan2(matrix[..., 0, 2], cosine),
            np.arctan2(-matrix[..., 0, 1], matrix[..., 0, 0]),
        ],
        axis=-1,
    )
    position = np.concatenate([q[..., :3], angles, q[..., 7:]], axis=-1)
    if v is None:
        return position, None, None
    v, a = given, None if a is None else second
    linear = np.einsum("...ij,...j->...i", matrix, v[..., :3])
    omega = np.einsum("...ij,...j->...i", matrix, v[..., 3:6])
    inverse = np.linalg.inv(euler_rate_matrix("xyz", angles))
    rates = np.einsum("...ij,...j->...i", inverse, omega)
    velocity = np.concatenate([linear, rates, v[..., 6:]], axis=-1)
    if a is None:
        return position, velocity, None
    moving = a[..., :3] + np.cross(v[..., 3:6], v[..., :3])
    bias = euler_placement("xyz", angles, rates, np.zeros(rates.shape))[2]
    alpha = np.einsum("...ij,...j->...i", matrix, a[..., 3:6])
    second = np.einsum("...ij,...j->...i", inverse, alpha - bias)
    linear = np.einsum("...ij,...j->...i", matrix, moving)
    return position, velocity, np.concatenate([linear, second, a[..., 6:]], axis=-1)


def free_flyer_state(
    torso: BodyMotion, joints: JointTrajectory
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pinocchio's q ``(n, 19)``, v ``(n, 18)``, a ``(n, 18)`` of a free-flyer root."""

    count, turn = len(joints.q), rows(torso.rotation)
    q, v, a = np.empty((count, 19)), np.empty((count, 18)), np.empty((count, 18))
    linear, angular = into(turn, rows(torso.velocity)), into(turn, rows(torso.omega))
    moving = into(turn, rows(torso.acceleration)) - cross(angular, linear)
    q[:, :3], q[:, 3:7], q[:, 7:] = torso.position, quaternions(turn).T, joints.q
    v[:, :3], v[:, 3:6], v[:, 6:] = linear.T, angular.T, joints.v
    a[:, :3], a[:, 3:6], a[:, 6:] = moving.T, into(turn, rows(torso.alpha)).T, joints.a
    return q, v, a


def _motion(q: np.ndarray, v: Any, a: Any) -> tuple[np.ndarray, ...]:
    """q, v and a checked and in one stack; what isn't given is zero."""
    if v is None and a is not None:
        raise BadInput("a is given without v", allowed="v alone, or both")
    v, a = (
        np.zeros(18) if x is None else finite_array(name, x, 18) for name, x in (("v", v), ("a", a))
    )
    return together(q=q, v=v, a=a)


def _quaternion(matrix: np.ndarray) -> np.ndarray:
    """Unit quaternions (x, y, z, w) of rotations: ``(..., 3, 3)`` → ``(..., 4)``."""
    from scipy.spatial.transform import Rotation

    flat = Rotation.from_matrix(matrix.reshape(-1, 3, 3)).as_quat()
    return flat.reshape(*matrix.shape[:-2], 4)


def _rotation_matrix(quaternion: np.ndarray) -> np.ndarray:
    """Inverse of :func:`_quaternion`; quaternions of any length but zero."""
    from scipy.spatial.transform import Rotation

    flat = Rotation.from_quat(quaternion.reshape(-1, 4)).as_matrix()
    return flat.reshape(*quaternion.shape[:-1], 3, 3)


def _in_axes(matrix: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Components of vectors ``(..., k, 3)`` in the axes of ``(..., 3, 3)``."""
    return np.einsum("...ji,...kj->...ki", matrix, vectors)
