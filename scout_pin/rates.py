"""Joint rates and accelerations of a leg from its foot's motion.

The 6×6 systems (3.16) and (3.24) come apart: joints 5 and 6 don't move p5, and
joints 3, 4, 5 neither move it along e nor turn the foot about b = e × a. That
leaves two equations for joints 1 and 2, then two for 3 and 4.

Symbols as in :mod:`scout_pin.forward`; v = p5 − p2, r3 and r4 are thigh and
shank. Components are along i3, j3, e, the frame of link 2.

Source: Scout thesis, equations (3.16) and (3.24).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from scout_pin.geometry import LegGeometry
from thesis_pin.errors import SingularPose
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.trajectory import BodyMotion

Components = tuple[Any, Any, Any]


def leg_rates(
    leg: LegGeometry, theta: np.ndarray, foot: BodyMotion
) -> tuple[np.ndarray, np.ndarray]:
    """Joint rates and accelerations that give the foot its motion.

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
    screws = _Screws(leg, theta)
    screws.refuse_singular()
    # The point the equations speak of is p5, not the sole; both are fixed in the foot.
    arm = np.einsum("nij,j->ni", foot.rotation, leg.foot[1] * leg.y_6 + leg.foot[0] * leg.x_5)
    spin = np.cross(foot.omega, arm)
    velocity = foot.velocity - spin
    rate = screws.solve(screws.components(velocity), screws.components(foot.omega))
    acceleration = foot.acceleration - np.cross(foot.alpha, arm) - np.cross(foot.omega, spin)
    linear, angular = screws.bias(rate)
    p, w = screws.components(acceleration), screws.components(foot.alpha)
    second = screws.solve(
        (p[0] - linear[0], p[1] - linear[1], p[2] - linear[2]),
        (w[0] - angular[0], w[1] - angular[1], w[2] - angular[2]),
    )
    return rate.T, second.T


class _Screws:
    """The joint screws of a leg at n configurations, and the equations they make."""

    def __init__(self, leg: LegGeometry, theta: np.ndarray) -> None:
        gamma = np.ascontiguousarray((theta + leg.beta).T)
        sum_4 = gamma[2] + gamma[3]
        angles = [gamma[0], gamma[1], gamma[2], sum_4, sum_4 + gamma[4]]
        self.c1, self.c2, c3, c34, self.c345 = np.cos(angles)
        self.s1, self.s2, s3, s34, self.s345 = np.sin(angles)
        self.s4 = np.sin(gamma[3])
        self.leg = leg
        self.r3 = leg.x_3 * c3, leg.x_3 * s3
        self.r4 = leg.x_4 * c34, leg.x_4 * s34
        self.v = leg.x_2 + self.r3[0] + self.r4[0], self.r3[1] + self.r4[1]
        self.v_b = self.v[1] * self.c345 - self.v[0] * self.s345

    def components(self, vector: np.ndarray) -> Components:
        """Components along i3, j3, e of vectors in the torso's axes, ``(n, 3)``."""
        x, y, z = vector.T
        radial = self.c1 * x + self.s1 * y
        return (
            self.c2 * radial - self.s2 * z,
            self.c1 * y - self.s1 * x,
            self.s2 * radial + self.c2 * z,
        )

    def solve(self, p: Components, w: Components) -> np.ndarray:
        """Joint rates ``(6, n)`` from the velocity p of p5 and the foot's angular velocity w."""
        (v_i, v_j), (r3_i, r3_j), (r4_i, r4_j) = self.v, self.r3, self.r4
        c2, s2, c345, s345 = self.c2, self.s2, self.c345, self.s345
        about_b = c345 * w[1] - s345 * w[0]
        # −s2 v_j q1 − v_i q2 = p_e  and  s2 s345 q1 + c345 q2 = w·b
        q1 = (p[2] * c345 + v_i * about_b) / (-s2 * self.v_b)
        q2 = (s345 * p[2] + v_j * about_b) / self.v_b
        # What joints 1 and 2 leave is q3 e × r3 + (q3 + q4) e × r4.
        left_i, left_j = p[0] + c2 * v_j * q1, p[1] - c2 * v_i * q1
        area = self.leg.x_3 * self.leg.x_4 * self.s4
        q3 = (left_i * r4_i + left_j * r4_j) / area
        q34 = -(left_i * r3_i + left_j * r3_j) / area
        q345 = w[2] - c2 * q1
        q6 = c345 * (w[0] + s2 * q1) + s345 * (w[1] - q2)
        return np.stack([q1, q2, q3, q34 - q3, q345 - q34, q6])

    def bias(self, rate: np.ndarray) -> tuple[Components, Components]:
        """Acceleration of p5 and angular acceleration of the foot when θ̈ = 0.

        The link vectors x_2 i3, r3, r4 turn with links 2, 3, 4, whose angular
        velocity ω and acceleration α are carried along the leg.
        """
        q1, q2, q3, q4, q5, q6 = rate
        omega = (-self.s2 * q1, q2, self.c2 * q1)
        alpha = (-self.c2 * q1 * q2, 0.0 * q1, -self.s2 * q1 * q2)  # (q1 k) × (q2 j3)
        point = _swing(alpha, omega, (self.leg.x_2, 0.0))
        for q, link in ((q3, self.r3), (q4, self.r4), (q5, (0.0, 0.0))):
            alpha = (alpha[0] + omega[1] * q, alpha[1] - omega[0] * q, alpha[2])  # ω × (q e)
            omega = (omega[0], omega[1], omega[2] + q)
            step = _swing(alpha, omega, link)
            point = (point[0] + step[0], point[1] + step[1], point[2] + step[2])
        c, s = self.c345, self.s345
        foot = (  # ω × (q6 a)
            alpha[0] - omega[2] * s * q6,
            alpha[1] + omega[2] * c * q6,
            alpha[2] + (omega[0] * s - omega[1] * c) * q6,
        )
        return point, foot

    def refuse_singular(self) -> None:
        """Raise at the first sample where one of the determinant's factors vanishes."""
        reasons = (
            (np.abs(self.s2), "hip roll is ±90° from neutral, hip yaw is free (sin γ2 = 0)"),
            (np.abs(self.s4), "the knee is straight or folded (sin γ4 = 0)"),
            (np.abs(self.v_b) / np.hypot(*self.v), "hip and ankle axes are in line (v × a = 0)"),
        )
        for value, reason in reasons:
            if (bad := value < TOLERANCES.near_singular).any():
                k = int(np.argmax(bad))
                raise SingularPose(
                    f"no joint rates exist: {reason}",
                    where=f"{self.leg.names[0].split('_')[0]} leg, sample {k}",
                    allowed=f"sines of at least {TOLERANCES.near_singular:.0e}",
                    remedy="Move the pose away from the singularity",
                )


def _swing(alpha: Components, omega: Components, link: tuple[Any, Any]) -> Components:
    """α × r + ω × (ω × r) of a link vector r in the plane of i3 and j3."""
    r_i, r_j = link
    dot = omega[0] * r_i + omega[1] * r_j
    square = omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]
    return (
        -alpha[2] * r_j + omega[0] * dot - square * r_i,
        alpha[2] * r_i + omega[1] * dot - square * r_j,
        alpha[0] * r_j - alpha[1] * r_i + omega[2] * dot,
    )
