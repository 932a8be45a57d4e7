"""The two ways to write where the biped is: the thesis's eighteen numbers, a free flyer's.

Source: Scout thesis, 3.1 and (4.2).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.errors import BadInput, SingularPose
from thesis_pin.numeric.arrays import finite_array, together
from thesis_pin.numeric.rotations import euler_placement, euler_rate_matrix, quaternion_rows
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory
from thesis_pin.numeric.vectors import cross, into, rows
from thesis_pin.tolerances import TOLERANCES

POSE_NAMES = ("x", "y", "z", "pitch", "roll", "yaw")
"""x lateral, y forward, z up [m]; then the thesis's Euler angles θ, φ, ψ [rad]:
rotation = Rx(pitch) Ry(roll) Rz(yaw)."""


def to_free_flyer(
    q: ArrayLike, v: ArrayLike | None = None, a: ArrayLike | None = None
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
    position, rates, second = _motion(finite_array("q", q, 18), v, a)
    s, ds, dds = (x.reshape(-1, 18) for x in (position, rates, second))
    turn, omega, alpha = euler_placement("xyz", s[:, 3:6], ds[:, 3:6], dds[:, 3:6])
    torso = BodyMotion(turn, s[:, :3], ds[:, :3], dds[:, :3], omega, alpha)
    joints = JointTrajectory(np.zeros(len(s)), s[:, 6:], ds[:, 6:], dds[:, 6:])
    state = free_flyer_state(torso, joints)
    found = [x.reshape(*position.shape[:-1], x.shape[1]) for x in state]
    return found[0], None if v is None else found[1], None if a is None else found[2]


def to_thesis(
    q: ArrayLike, v: ArrayLike | None = None, a: ArrayLike | None = None
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
    state, given, second = _motion(finite_array("q", q, 19), v, a)
    if not np.linalg.norm(state[..., 3:7], axis=-1).all():
        raise BadInput("a quaternion in q[3:7] is zero", allowed="unit quaternions")
    matrix = _rotation_matrix(state[..., 3:7])
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
    position = np.concatenate([state[..., :3], angles, state[..., 7:]], axis=-1)
    if v is None:
        return position, None, None
    linear = np.einsum("...ij,...j->...i", matrix, given[..., :3])
    omega = np.einsum("...ij,...j->...i", matrix, given[..., 3:6])
    inverse = np.linalg.inv(euler_rate_matrix("xyz", angles))
    rates = np.einsum("...ij,...j->...i", inverse, omega)
    velocity = np.concatenate([linear, rates, given[..., 6:]], axis=-1)
    if a is None:
        return position, velocity, None
    moving = second[..., :3] + np.cross(given[..., 3:6], given[..., :3])
    bias = euler_placement("xyz", angles, rates, np.zeros(rates.shape))[2]
    alpha = np.einsum("...ij,...j->...i", matrix, second[..., 3:6])
    bend = np.einsum("...ij,...j->...i", inverse, alpha - bias)
    linear = np.einsum("...ij,...j->...i", matrix, moving)
    return position, velocity, np.concatenate([linear, bend, second[..., 6:]], axis=-1)


def free_flyer_state(
    torso: BodyMotion, joints: JointTrajectory
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pinocchio's q ``(n, 19)``, v ``(n, 18)``, a ``(n, 18)`` of a free-flyer root.

    Args:
        torso: Motion of the torso in the world.
        joints: The twelve joints' trajectory.
    """
    count = len(joints.q)
    q, v, a = np.empty((count, 19)), np.empty((count, 18)), np.empty((count, 18))
    fill_root(torso, (q.T, v.T, a.T))
    q[:, 7:], v[:, 6:], a[:, 6:] = joints.q, joints.v, joints.a
    return q, v, a


def fill_root(torso: BodyMotion, out: tuple[np.ndarray, np.ndarray, np.ndarray]) -> None:
    """Write the root's part of :func:`free_flyer_state`: ``(19, n)``, ``(18, n)``, ``(18, n)``."""
    turn, (q, v, a) = rows(torso.rotation), out
    q[:3], q[3:7] = torso.position.T, quaternion_rows(turn)
    v[:3], a[:3] = into(turn, rows(torso.velocity)), into(turn, rows(torso.acceleration))
    if torso.turns:
        v[3:6], a[3:6] = into(turn, rows(torso.omega)), into(turn, rows(torso.alpha))
        a[:3] -= cross(v[3:6], v[:3])
    else:
        v[3:6] = a[3:6] = 0.0


def _motion(q: np.ndarray, v: ArrayLike | None, a: ArrayLike | None) -> tuple[np.ndarray, ...]:
    """q, v and a checked and in one stack; what isn't given is zero."""
    if v is None and a is not None:
        raise BadInput("a is given without v", allowed="v alone, or both")
    rates, second = (
        np.zeros(18) if x is None else finite_array(name, x, 18) for name, x in (("v", v), ("a", a))
    )
    return together(q=q, v=rates, a=second)


def _rotation_matrix(quaternion: np.ndarray) -> np.ndarray:
    """Rotations of quaternions (x, y, z, w), not zero: ``(..., 4)`` → ``(..., 3, 3)``."""
    from scipy.spatial.transform import Rotation

    flat = Rotation.from_quat(quaternion.reshape(-1, 4)).as_matrix()
    return np.asarray(flat.reshape(*quaternion.shape[:-1], 3, 3))
