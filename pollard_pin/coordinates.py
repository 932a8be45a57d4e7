"""The task coordinates of the spray tip, and the placements and motions they mean."""

from __future__ import annotations

import numpy as np

from thesis_pin.errors import SingularPose
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.rotations import euler_placement, euler_rate_matrix, rotation
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES

POSE_NAMES = ("x", "y", "z", "psi", "theta", "phi")
"""Task coordinates of the thesis: spray tip [m] and angles [rad] (2.3)."""

_ORDER = [4, 3, 5]  # the turns are about x, y, z in the order θ, ψ, φ; the coordinates ψ, θ, φ


def pose_rotation(pose: np.ndarray) -> np.ndarray:
    """Orientation of the tool, Rx(θ) Ry(ψ) Rz(φ): ``(..., 6)`` → ``(..., 3, 3)``.

    Source: Pollard thesis, 2.4, T_LD0.
    """
    turns = (rotation("x", pose[..., 4]), rotation("y", pose[..., 3]), rotation("z", pose[..., 5]))
    return np.asarray(turns[0] @ turns[1] @ turns[2])


def pose_from_placement(
    position: np.ndarray, matrix: np.ndarray, near: np.ndarray | None = None
) -> np.ndarray:
    """Task coordinates of a placement of the tool.

    Args:
        position: Spray tip [m], shape ``(..., 3)``.
        matrix: Orientation, shape ``(..., 3, 3)``.
        near: Angles ψ, θ, φ next to which those of the pose are to be, ``(..., 3)``:
            (ψ, θ, φ) and (π − ψ, θ + π, φ + π) are one orientation. None takes
            cos ψ ≥ 0 and angles in (−π, π].

    Returns:
        Pose ``(..., 6)``; where cos ψ = 0 only θ ± φ is defined, and φ = 0 or the θ of
        ``near`` is taken.
    """
    m = np.moveaxis(matrix, (-2, -1), (0, 1))
    size = np.sqrt(m[1, 2] * m[1, 2] + m[2, 2] * m[2, 2])  # |cos ψ|
    lost = size < TOLERANCES.singular
    if lost.any():
        free = np.arctan2(m[2, 1], m[1, 1]) if near is None else near[..., 1]
        theta = np.where(lost, free, np.arctan2(-m[1, 2], m[2, 2]))
        c, s = np.cos(theta), np.sin(theta)
    else:
        theta, c, s = np.arctan2(-m[1, 2], m[2, 2]), m[2, 2] / size, -m[1, 2] / size
    psi = np.arctan2(m[0, 2], c * m[2, 2] - s * m[1, 2])
    phi = np.arctan2(c * m[1, 0] + s * m[2, 0], c * m[1, 1] + s * m[2, 1])
    angles = np.array(np.broadcast_arrays(psi, theta, phi))
    if near is not None:
        beside = np.moveaxis(near, -1, 0)
        gap = wrap(angles - beside)
        away = np.abs(gap).sum(axis=0)
        if (away > np.pi).any():  # else the other name, half a turn off in θ and φ, isn't nearer
            other = wrap(np.array([np.pi - psi, theta + np.pi, phi + np.pi]) - beside)
            gap = np.where(away > np.abs(other).sum(axis=0), other, gap)
        angles = beside + gap
    pose = np.empty((*angles.shape[1:], 6))
    pose[..., :3], pose[..., 3:] = position, np.moveaxis(angles, 0, -1)
    return pose


def angular_rate_matrix(pose: np.ndarray) -> np.ndarray:
    """E with ω = E (ψ̇, θ̇, φ̇) in the world frame: ``(..., 6)`` → ``(..., 3, 3)``."""
    return euler_rate_matrix("xyz", pose[..., _ORDER])[..., :, [1, 0, 2]]


def tool_motion(pose: np.ndarray, rate: np.ndarray, acceleration: np.ndarray) -> BodyMotion:
    """The tool's motion of poses and their derivatives, each ``(n, 6)``."""
    turned = (x[..., _ORDER] for x in (pose, rate, acceleration))
    turn, omega, alpha = euler_placement("xyz", *turned)
    return BodyMotion(turn, pose[..., :3], rate[..., :3], acceleration[..., :3], omega, alpha)


def pose_rates(pose: np.ndarray, tool: BodyMotion) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivatives of the poses of a motion of the tool, each ``(n, 6)``.

    Raises:
        SingularPose: cos ψ = 0 at some sample: θ and φ have no rates there.
    """
    lost = np.abs(np.cos(pose[:, 3])) < TOLERANCES.near_singular
    if lost.any():
        raise SingularPose(
            "ψ is 90° up to turns: the angles ψ, θ, φ have no rates, though the tool has",
            where=f"sample {int(np.argmax(lost))}",
            remedy="Use the tool's velocity and angular velocity",
        )
    spread = angular_rate_matrix(pose)
    first = np.linalg.solve(spread, tool.omega[..., None])[..., 0]
    still = np.zeros_like(first)
    order = [1, 0, 2]
    bias = euler_placement("xyz", pose[:, _ORDER], first[:, order], still)[2]
    second = np.linalg.solve(spread, (tool.alpha - bias)[..., None])[..., 0]
    return (
        np.concatenate([tool.velocity, first], axis=-1),
        np.concatenate([tool.acceleration, second], axis=-1),
    )
