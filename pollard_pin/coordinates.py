"""The task coordinates of the spray tip, and the placements they mean."""

from __future__ import annotations

import numpy as np

from thesis_pin.numeric.rotations import euler_rate_matrix, rotation
from thesis_pin.tolerances import TOLERANCES

POSE_NAMES = ("x", "y", "z", "psi", "theta", "phi")
"""Task coordinates of the thesis: spray tip [m] and angles [rad] (2.3)."""


def pose_rotation(pose: np.ndarray) -> np.ndarray:
    """Orientation of the tool, Rx(θ) Ry(ψ) Rz(φ): ``(..., 6)`` → ``(..., 3, 3)``.

    Source: Pollard thesis, 2.4, T_LD0.
    """
    turns = (rotation("x", pose[..., 4]), rotation("y", pose[..., 3]), rotation("z", pose[..., 5]))
    return np.asarray(turns[0] @ turns[1] @ turns[2])


def pose_from_placement(position: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Task coordinates of a placement of the tool, with cos ψ ≥ 0.

    Args:
        position: Spray tip [m], shape ``(..., 3)``.
        matrix: Orientation, shape ``(..., 3, 3)``.

    Returns:
        Pose ``(..., 6)``; where cos ψ = 0 only θ ± φ is defined and φ = 0 is taken.
    """
    cosine = np.hypot(matrix[..., 0, 0], matrix[..., 0, 1])
    lost = cosine < TOLERANCES.singular
    theta = np.where(
        lost,
        np.arctan2(matrix[..., 2, 1], matrix[..., 1, 1]),
        np.arctan2(-matrix[..., 1, 2], matrix[..., 2, 2]),
    )
    phi = np.where(lost, 0.0, np.arctan2(-matrix[..., 0, 1], matrix[..., 0, 0]))
    angles = np.stack([np.arctan2(matrix[..., 0, 2], cosine), theta, phi], axis=-1)
    return np.concatenate([position, angles], axis=-1)


def angular_rate_matrix(pose: np.ndarray) -> np.ndarray:
    """E with ω = E (ψ̇, θ̇, φ̇) in the world frame: ``(..., 6)`` → ``(..., 3, 3)``."""
    # The turns are about x, y, z in the order θ, ψ, φ; the coordinates are ψ, θ, φ.
    return euler_rate_matrix("xyz", pose[..., [4, 3, 5]])[..., :, [1, 0, 2]]
