"""The joint screws of a leg in the frame of link 2, where they are simple.

Rates, accelerations and torques of a leg are all products of these vectors.

Symbols as in :mod:`scout_pin.kinematics.forward`; v = p5 − p2, r3 and r4 are thigh and
shank. Components are along i3, j3, e, the frame of link 2; the sample is the
last axis.

Source: Scout thesis, equations (3.16) and (3.24).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from scout_pin.kinematics.geometry import LegGeometry
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.elementwise import cosine_sine
from thesis_pin.tolerances import TOLERANCES

Components = tuple[Any, Any, Any]


class LegScrews:
    """The joint screws of a leg at n configurations, and the equations they make."""

    def __init__(self, leg: LegGeometry, theta: np.ndarray) -> None:
        gamma = np.ascontiguousarray((theta + leg.beta).T)
        sum_4 = gamma[2] + gamma[3]
        angles = np.stack([gamma[0], gamma[1], gamma[2], sum_4, sum_4 + gamma[4]])
        cosines, sines = cosine_sine(angles)
        self.c1, self.c2, c3, c34, self.c345 = cosines
        self.s1, self.s2, s3, s34, self.s345 = sines
        self.s4 = s34 * c3 - c34 * s3
        self.leg = leg
        self.r3 = leg.x_3 * c3, leg.x_3 * s3
        self.r4 = leg.x_4 * c34, leg.x_4 * s34
        self.v = leg.x_2 + self.r3[0] + self.r4[0], self.r3[1] + self.r4[1]
        self.v_b = self.v[1] * self.c345 - self.v[0] * self.s345

    def components(self, vector: np.ndarray) -> Components:
        """Components along i3, j3, e of vectors in the torso's axes, ``(3, n)``."""
        x, y, z = vector
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

    def torques(self, force: np.ndarray, moment: np.ndarray) -> np.ndarray:
        """Joint torques of a wrench on the foot: z_j · (moment about p_j), ``(6, n)``.

        Args:
            force: In the torso's axes [N], shape ``(3, n)``.
            moment: About the torso's origin, in its axes [N·m], shape ``(3, n)``.
        """
        leg, (fx, fy, fz) = self.leg, force
        x, y, z = moment[0] - leg.z_1 * fy, moment[1] + leg.z_1 * fx, moment[2]
        about_2 = np.stack([x, y + leg.x_0 * fz, z - leg.x_0 * fy])  # about p2
        f, m = self.components(force), self.components(about_2)
        about_3 = m[2] - leg.x_2 * f[1]
        about_4 = about_3 - self.r3[0] * f[1] + self.r3[1] * f[0]
        about_5 = about_4 - self.r4[0] * f[1] + self.r4[1] * f[0]
        # Joint 1 passes through p2, joint 6 through p5.
        sixth = self.c345 * (m[0] - self.v[1] * f[2]) + self.s345 * (m[1] + self.v[0] * f[2])
        return np.stack([about_2[2], m[1], about_3, about_4, about_5, sixth])

    def refuse_singular(self, first: int = 0) -> None:
        """Raise at the first sample where one of the determinant's factors vanishes.

        Args:
            first: Number of the first sample, for messages.
        """
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
                    where=f"{self.leg.names[0].split('_')[0]} leg, sample {first + k}",
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
