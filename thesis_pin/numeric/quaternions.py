"""Rotations over time by unit quaternions: which way they turn, and how they move.

A quaternion and its negative are one rotation, so that a turn between two rotations
leaves open by how many half circles of the quaternion. The rule is the shorter way:
at most half a turn between neighbours.
"""

from __future__ import annotations

import numpy as np

from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.numeric.vectors import cross, rows
from thesis_pin.tolerances import TOLERANCES


def shorter_turns(matrix: np.ndarray, hint: np.ndarray | None = None) -> np.ndarray:
    """The turn from each rotation to the next, the shorter way.

    Args:
        matrix: Rotations in order, shape ``(n, 3, 3)``.
        hint: For each step roughly the rotation vector that is meant, shape
            ``(n − 1, 3)``: says which way half a turn goes, and nothing else.

    Returns:
        Rotation vectors (axis times angle) in the fixed frame [rad], ``(n − 1, 3)``.

    Raises:
        TrajectoryError: A step is half a turn, and the hint doesn't tell which way;
            carries the number of the step's first rotation as ``step``.
    """
    from scipy.spatial.transform import Rotation

    step = matrix[1:] @ np.swapaxes(matrix[:-1], -1, -2)
    turn = Rotation.from_quat(quaternions(step)).as_rotvec()
    size = np.linalg.norm(turn, axis=-1)
    for k in np.flatnonzero(size > np.pi - TOLERANCES.half_turn):
        along = 0.0 if hint is None else float(hint[k] @ turn[k])
        if abs(along) < TOLERANCES.half_turn:
            raise HalfTurn(int(k))
        if along < 0:
            turn[k] *= 1 - 2 * np.pi / size[k]  # the other way round
    return np.asarray(turn)


class HalfTurn(TrajectoryError):
    """Two neighbouring rotations are half a turn apart, and nothing says which way."""

    def __init__(self, step: int, where: str = "") -> None:
        self.step = step
        super().__init__(
            "the tool turns by half a turn from one orientation to the next, which may be either "
            "way round",
            where=where or f"between orientations {step} and {step + 1}",
            allowed="less than half a turn",
            remedy="Put another orientation in between",
        )


def continuous(matrix: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Unit quaternions (x, y, z, w) that follow given turns without a change of sign.

    Args:
        matrix: Rotations in order, shape ``(n, 3, 3)``.
        turns: From each to the next, of :func:`shorter_turns`, shape ``(n − 1, 3)``.

    Returns:
        Shape ``(n, 4)``.
    """
    found = quaternions(matrix)
    between = _vector_part(found[1:], found[:-1]), (found[1:] * found[:-1]).sum(axis=-1)
    half = np.linalg.norm(turns, axis=-1) / 2
    ahead = turns / 2 * np.sinc(half / np.pi)[:, None], np.cos(half)
    alike = (between[0] * ahead[0]).sum(axis=-1) + between[1] * ahead[1]
    sign = np.concatenate([[1.0], np.cumprod(np.where(alike < 0, -1.0, 1.0))])
    return np.asarray(found * sign[:, None])


def unbroken(quaternion: np.ndarray) -> np.ndarray:
    """The same rotations without a change of sign from one to the next: q and −q are one.

    Args:
        quaternion: Unit quaternions in order, shape ``(n, 4)``.
    """
    same = np.einsum("ij,ij->i", quaternion[1:], quaternion[:-1]) >= 0
    sign = np.concatenate([[1.0], np.cumprod(np.where(same, 1.0, -1.0))])
    return np.asarray(quaternion * sign[:, None])


def motion(
    value: np.ndarray, first: np.ndarray, second: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rotation, angular velocity and angular acceleration of a moving quaternion.

    The quaternion p need not be of unit length: the rotation is that of p / |p|, with
    ω = 2 Im(ṗ p*) / |p|² and α its derivative, in the fixed frame.

    Args:
        value: p as (x, y, z, w), shape ``(n, 4)``, away from zero.
        first: ṗ, same shape.
        second: p̈, same shape.

    Returns:
        Rotation ``(n, 3, 3)``, ω ``(n, 3)`` [rad/s], α ``(n, 3)`` [rad/s²].
    """
    from scipy.spatial.transform import Rotation

    square = (value * value).sum(axis=-1, keepdims=True)
    omega = 2 * _vector_part(first, value) / square
    growth = 2 * (value * first).sum(axis=-1, keepdims=True) / square
    alpha = 2 * _vector_part(second, value) / square - growth * omega
    return Rotation.from_quat(value).as_matrix(), omega, alpha


def _vector_part(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Vector part of one times the conjugate of the other, ``(n, 3)``."""
    v, w = one[:, :3], other[:, :3]
    return np.asarray(other[:, 3:] * v - one[:, 3:] * w - cross(rows(v), rows(w)).T)
