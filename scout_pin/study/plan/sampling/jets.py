"""The torso's motion as eighteen numbers a sample, and what Pinocchio's root makes of them.

Source: Scout thesis, 3.1–3.3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from thesis_pin.numeric.arrays import skew
from thesis_pin.numeric.rotations import euler_parts, rotation
from thesis_pin.numeric.sparing import spread
from thesis_pin.numeric.trajectory import BodyMotion

JET = 18
"""Numbers of a jet: the six of :data:`scout_pin.coordinates.POSE_NAMES` [m], [rad], their
rates, their accelerations."""

_PITCH, _ROLL, _YAW = 3, 4, 5
_SLOPES = slice(3, 6)  # of the angles, in each six of a jet


@dataclass(frozen=True)
class Heading:
    """A heading that angles count from, which turns evenly.

    Attributes:
        angle: To the left [rad], ``(n,)``.
        rate: [rad/s].
    """

    angle: np.ndarray
    rate: float


def torso_motion(jets: np.ndarray, heading: Heading | None = None) -> BodyMotion:
    """The torso's motion in the world: jets ``(n, 18)``, whose angles count from a heading."""
    count, columns = len(jets), list(jets.T)
    turned = euler_parts("xyz", columns[3:6], columns[9:12], columns[15:18])
    turn, omega, alpha = (spread(part, (count,)) for part in turned)
    if heading is not None:
        about = rotation("z", heading.angle)
        up = np.array([[0.0], [0.0], [heading.rate]])
        alpha = np.einsum("nij,jn->in", about, alpha + np.cross(up, omega, axis=0))
        omega = np.einsum("nij,jn->in", about, omega) + up
        turn = np.einsum("nij,jkn->ikn", about, turn.reshape(3, 3, count))
    return BodyMotion(
        turn.reshape(3, 3, count).transpose(2, 0, 1),
        jets[:, :3],
        jets[:, 6:9],
        jets[:, 12:15],
        omega.T,
        alpha.T,
    )


@dataclass(frozen=True)
class RootSlopes:
    """Derivatives of a free-flyer root by the torso's jet, each ``(n, 6, 18)``.

    Attributes:
        q: Of the placement, as a small twist in the torso's axes.
        v: Of the velocity, linear then angular, in the torso's axes.
        a: Of its acceleration, spatial, as Pinocchio has it.
    """

    q: np.ndarray
    v: np.ndarray
    a: np.ndarray


def root_slopes(jets: np.ndarray, torso: BodyMotion, rate: float = 0.0) -> RootSlopes:
    """Derivatives of Pinocchio's root by the jets ``(n, 18)`` of a torso.

    Args:
        jets: The jets.
        torso: Its motion.
        rate: Of the heading that angles count from [rad/s].
    """
    count, back = len(jets), np.swapaxes(torso.rotation, 1, 2)
    angle_rates, angle_seconds = jets[:, 9:12], jets[:, 15:18]
    w, w_of, w_of_of = _rate_matrix(jets[:, _ROLL], jets[:, _YAW])
    # dW/dt, and what it becomes of each angle: W depends on roll and yaw only.
    drift = np.einsum("kn,knij->nij", angle_rates.T, w_of)

    q = np.zeros((count, 6, JET))
    q[:, :3, :3], q[:, 3:, _SLOPES] = back, w

    def turned(vector: np.ndarray) -> np.ndarray:
        """How the components of a world vector change with the angles, ``(n, 3, 3)``."""
        vector = np.broadcast_to(vector, (count, 3))
        return np.asarray(skew(np.einsum("nij,nj->ni", back, vector)) @ w)

    v = np.zeros((count, 6, JET))
    v[:, :3, 3:6], v[:, :3, 6:9] = turned(torso.velocity), back
    v[:, 3:, 3:6] = np.einsum("knij,nj->nik", w_of, angle_rates)
    v[:, 3:, 9:12] = w
    spun = v[:, 3:, 3:6].copy()  # of the angles' own angular velocity
    if rate:  # the vertical turns in the torso's axes
        v[:, 3:, 3:6] += rate * turned(np.array([0.0, 0.0, 1.0]))

    a = np.zeros((count, 6, JET))
    a[:, 3:, 3:6] = np.einsum("knij,nj->nik", w_of, angle_seconds)
    a[:, 3:, 3:6] += np.einsum("klnij,ln,nj->nik", w_of_of, angle_rates.T, angle_rates)
    a[:, 3:, 9:12] = drift + np.einsum("knij,nj->nik", w_of, angle_rates)
    a[:, 3:, 15:18] = w
    if rate:
        vertical, own = back[:, :, 2], np.einsum("nij,nj->ni", w, angle_rates)
        a[:, 3:, 3:6] += rate * (
            skew(vertical) @ spun - skew(own) @ turned(np.array([0.0, 0.0, 1.0]))
        )
        a[:, 3:, 9:12] += rate * skew(vertical) @ w
    # The spatial acceleration leaves ω × v out.
    linear = np.einsum("nij,nj->ni", back, torso.velocity)
    omega = np.einsum("nij,nj->ni", back, torso.omega)
    a[:, :3, 3:6], a[:, :3, 12:15] = turned(torso.acceleration), back
    a[:, :3] += skew(linear) @ v[:, 3:] - skew(omega) @ v[:, :3]
    return RootSlopes(q, v, a)


def _rate_matrix(roll: np.ndarray, yaw: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """W with ω = W @ (rates of pitch, roll, yaw) in the torso's axes, and its derivatives.

    Returns:
        W ``(n, 3, 3)``, by each angle ``(3, n, 3, 3)``, and by each pair ``(3, 3, n, 3, 3)``.
    """
    count, zero = len(roll), np.zeros(len(roll))
    cr, sr, cy, sy = np.cos(roll), np.sin(roll), np.cos(yaw), np.sin(yaw)

    def matrix(first: tuple[np.ndarray, ...], second: tuple[np.ndarray, ...]) -> np.ndarray:
        whole = np.zeros((count, 3, 3))
        whole[:, :, 0], whole[:, :, 1] = np.transpose(first), np.transpose(second)
        return whole

    w = matrix((cr * cy, -cr * sy, sr), (sy, cy, zero))
    w[:, 2, 2] = 1.0
    of, of_of = np.zeros((3, count, 3, 3)), np.zeros((3, 3, count, 3, 3))
    of[1] = matrix((-sr * cy, sr * sy, cr), (zero, zero, zero))
    of[2] = matrix((-cr * sy, -cr * cy, zero), (cy, -sy, zero))
    of_of[1, 1] = matrix((-cr * cy, cr * sy, -sr), (zero, zero, zero))
    of_of[1, 2] = of_of[2, 1] = matrix((sr * sy, sr * cy, zero), (zero, zero, zero))
    of_of[2, 2] = matrix((-cr * cy, cr * sy, zero), (-sy, -cy, zero))
    return w, of, of_of
