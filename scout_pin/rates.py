"""Joint rates and accelerations of a leg from its foot's motion.

Symbols as in :mod:`scout_pin.forward`; b = e × a, v = p5 − p2.

Source: Scout thesis, equations (3.16) and (3.24).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from scout_pin.geometry import LegGeometry
from thesis_pin.errors import SingularPose
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.trajectory import BodyMotion


def leg_rates(
    leg: LegGeometry, theta: np.ndarray, foot: BodyMotion
) -> tuple[np.ndarray, np.ndarray]:
    """Joint rates and accelerations that give the foot its motion.

    The 6×6 systems (3.16) and (3.24) come apart: joints 5 and 6 don't move p5,
    and joints 3, 4, 5 neither move it along e nor turn the foot about b = e × a.
    That leaves two equations for joints 1 and 2, then two for 3 and 4.

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(n, 6)``.
        foot: Motion of the sole seen from the torso, in the torso's axes.

    Returns:
        θ̇ [rad/s] and θ̈ [rad/s²], each of shape ``(n, 6)``.

    Raises:
        SingularPose: At some sample the leg's Jacobian has lost rank.

    Source: Scout thesis, equations (3.16) and (3.24); determinant
    sin γ2 · x_3 x_4 sin γ4 · e·(v × a).
    """
    gamma = np.ascontiguousarray((theta + leg.beta).T)
    sum_4 = gamma[2] + gamma[3]
    sum_5 = sum_4 + gamma[4]
    c1, c2, c3, c34, c345 = np.cos([gamma[0], gamma[1], gamma[2], sum_4, sum_5])
    s1, s2, s3, s34, s345 = np.sin([gamma[0], gamma[1], gamma[2], sum_4, sum_5])
    s4 = np.sin(gamma[3])
    r3_i, r3_j = leg.x_3 * c3, leg.x_3 * s3
    r4_i, r4_j = leg.x_4 * c34, leg.x_4 * s34
    v_i, v_j = leg.x_2 + r3_i + r4_i, r3_j + r4_j
    moment = v_j * c345 - v_i * s345  # v·b
    _refuse_singular(leg, s2, s4, moment, np.hypot(v_i, v_j))

    def in_frame_3(vector: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        x, y, z = vector.T
        radial = c1 * x + s1 * y
        return c2 * radial - s2 * z, c1 * y - s1 * x, s2 * radial + c2 * z

    def solve(p: tuple[np.ndarray, ...], w: tuple[np.ndarray, ...]) -> np.ndarray:
        """Rates from the velocity p of p5 and the angular velocity w, in frame 3."""
        about_b = c345 * w[1] - s345 * w[0]
        # −s2 v_j q1 − v_i q2 = p_e  and  s2 s345 q1 + c345 q2 = w·b
        q1 = (p[2] * c345 + v_i * about_b) / (-s2 * moment)
        q2 = (s345 * p[2] + v_j * about_b) / moment
        left_i = p[0] + c2 * v_j * q1
        left_j = p[1] - c2 * v_i * q1
        scale = leg.x_3 * leg.x_4 * s4
        q3 = (left_i * r4_i + left_j * r4_j) / scale
        q34 = -(left_i * r3_i + left_j * r3_j) / scale
        q345 = w[2] - c2 * q1
        q6 = c345 * (w[0] + s2 * q1) + s345 * (w[1] - q2)
        return np.stack([q1, q2, q3, q34 - q3, q345 - q34, q6])

    # Move the reference point from the sole to p5, which is fixed in the foot.
    arm = np.einsum("nij,j->ni", foot.rotation, leg.foot[1] * leg.y_6 + leg.foot[0] * leg.x_5)
    spin = np.cross(foot.omega, arm)
    velocity = foot.velocity - spin
    rate = solve(in_frame_3(velocity), in_frame_3(foot.omega))

    # What p5 and the foot would accelerate with if θ̈ were zero.
    q1, q2, q3, q4, q5, q6 = rate
    w_i, w_j, w_e = -s2 * q1, q2, c2 * q1  # ω of link 2
    d_i, d_j, d_e = -c2 * q1 * q2, 0.0 * q1, -s2 * q1 * q2  # (q1 k) × (q2 j3)
    bias = np.zeros((3, gamma.shape[1]))

    def swing(r_i: Any, r_j: Any) -> None:
        """Add d × r + w × (w × r) of one link to the bias of p5."""
        dot = w_i * r_i + w_j * r_j
        square = w_i * w_i + w_j * w_j + w_e * w_e
        bias[0] += -d_e * r_j + w_i * dot - square * r_i
        bias[1] += d_e * r_i + w_j * dot - square * r_j
        bias[2] += d_i * r_j - d_j * r_i + w_e * dot

    swing(leg.x_2, 0.0)
    for q, r_i, r_j in ((q3, r3_i, r3_j), (q4, r4_i, r4_j), (q5, 0.0, 0.0)):
        d_i, d_j = d_i + w_j * q, d_j - w_i * q  # ω × (q e)
        w_e = w_e + q
        swing(r_i, r_j)
    d_i, d_j, d_e = (
        d_i - w_e * s345 * q6,
        d_j + w_e * c345 * q6,
        d_e + (w_i * s345 - w_j * c345) * q6,
    )
    acceleration = foot.acceleration - np.cross(foot.alpha, arm) - np.cross(foot.omega, spin)
    p, w = in_frame_3(acceleration), in_frame_3(foot.alpha)
    second = solve(
        (p[0] - bias[0], p[1] - bias[1], p[2] - bias[2]), (w[0] - d_i, w[1] - d_j, w[2] - d_e)
    )
    return rate.T, second.T


def _refuse_singular(
    leg: LegGeometry, s2: np.ndarray, s4: np.ndarray, moment: np.ndarray, length: np.ndarray
) -> None:
    reasons = (
        (np.abs(s2), "hip roll is ±90° from neutral, hip yaw is free (sin γ2 = 0)"),
        (np.abs(s4), "the knee is straight or folded (sin γ4 = 0)"),
        (np.abs(moment) / length, "hip and ankle axes are in line (v × a = 0)"),
    )
    for value, reason in reasons:
        if (bad := value < TOLERANCES.near_singular).any():
            k = int(np.argmax(bad))
            raise SingularPose(
                f"no joint rates exist: {reason}",
                where=f"{leg.names[0].split('_')[0]} leg, sample {k}",
                allowed=f"sines of at least {TOLERANCES.near_singular:.0e}",
                remedy="Move the pose away from the singularity",
            )
