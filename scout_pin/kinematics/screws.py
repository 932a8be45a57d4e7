"""The joint screws of a leg in the frame of link 2, where they are simple.

Rates, accelerations and torques of a leg are all products of these vectors.

Symbols as in :mod:`scout_pin.kinematics.forward`; v = p5 − p2, r3 and r4 are thigh and
shank. Components are along i3, j3, e, the frame of link 2; the sample is the
last axis.

Source: Scout thesis, equations (3.16) and (3.24).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np

from scout_pin.kinematics.geometry import LegGeometry
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.elementwise import Numbers, Samples, cosine_sine
from thesis_pin.tolerances import TOLERANCES

Components = tuple[Any, Any, Any]
"""Components of a vector, each an array ``(n,)``."""

Joints = tuple[Any, Any, Any, Any, Any, Any]
"""A quantity of each joint, each an array ``(n,)``."""


class LegScrews:
    """The joint screws of a leg at n configurations, and the equations they make."""

    def __init__(self, leg: LegGeometry, theta: np.ndarray) -> None:
        angles = theta.T[:5] + leg.beta[:5, None]
        angles[3] += angles[2]
        angles[4] += angles[3]
        self._set(leg, *cosine_sine(angles))

    @classmethod
    def single(cls, leg: LegGeometry, theta: Sequence[float]) -> LegScrews:
        """The screws at one configuration, all of floats."""
        gamma = [angle + beta for angle, beta in zip(theta[:5], leg.betas, strict=False)]
        gamma[3] += gamma[2]
        gamma[4] += gamma[3]
        one = cls.__new__(cls)
        one._set(leg, [math.cos(angle) for angle in gamma], [math.sin(angle) for angle in gamma])
        return one

    def _set(self, leg: LegGeometry, cosines: Any, sines: Any) -> None:
        """From cosines and sines of γ1, γ2, γ3, γ3 + γ4, γ3 + γ4 + γ5, ``(5, n)`` each."""
        self.leg, self._turns = leg, (cosines, sines)
        self.c1, self.c2, self.c3, self.c34, self.c345 = cosines
        self.s1, self.s2, self.s3, self.s34, self.s345 = sines
        self.r3 = leg.x_3 * self.c3, leg.x_3 * self.s3
        self.r4 = leg.x_4 * self.c34, leg.x_4 * self.s34
        self.v = leg.x_2 + self.r3[0] + self.r4[0], self.r3[1] + self.r4[1]

    def part(self, samples: Samples) -> LegScrews:
        """The screws at some of the configurations."""
        some = LegScrews.__new__(LegScrews)
        some._set(
            self.leg, *(np.asarray(turns).reshape(5, -1)[:, samples] for turns in self._turns)
        )
        return some

    def components(self, vector: Numbers) -> Components:
        """Components along i3, j3, e of vectors in the torso's axes, ``(3, n)``."""
        x, y, z = vector
        radial = self.c1 * x + self.s1 * y
        return (
            self.c2 * radial - self.s2 * z,
            self.c1 * y - self.s1 * x,
            self.s2 * radial + self.c2 * z,
        )

    @cached_property
    def factors(self) -> Components:
        """The factors of the Jacobian's determinant: sin γ2, sin γ4, e·(v × b)."""
        sine_4 = self.s34 * self.c3 - self.c34 * self.s3
        return self.s2, sine_4, self.v[1] * self.c345 - self.v[0] * self.s345

    @cached_property
    def _inverses(self) -> Components:
        """What :meth:`solve` multiplies by, for rates and for accelerations."""
        s2, s4, v_b = self.factors
        return -1.0 / (s2 * v_b), 1.0 / v_b, 1.0 / (self.leg.x_3 * self.leg.x_4 * s4)

    def solve(self, p: Components, w: Components) -> Joints:
        """Joint rates from the velocity p of p5 and the foot's angular velocity w."""
        (v_i, v_j), (r3_i, r3_j), (r4_i, r4_j) = self.v, self.r3, self.r4
        c345, s345 = self.c345, self.s345
        first, second, area = self._inverses
        about_b = c345 * w[1] - s345 * w[0]
        # −s2 v_j q1 − v_i q2 = p_e  and  s2 s345 q1 + c345 q2 = w·b
        q1 = (p[2] * c345 + v_i * about_b) * first
        q2 = (s345 * p[2] + v_j * about_b) * second
        # What joints 1 and 2 leave is q3 e × r3 + (q3 + q4) e × r4.
        turn = self.c2 * q1
        left_i, left_j = p[0] + v_j * turn, p[1] - v_i * turn
        q3 = (left_i * r4_i + left_j * r4_j) * area
        q34 = (left_i * r3_i + left_j * r3_j) * -area
        q6 = c345 * (w[0] + self.s2 * q1) + s345 * (w[1] - q2)
        return q1, q2, q3, q34 - q3, w[2] - turn - q34, q6

    def bias(self, rate: Joints) -> tuple[Components, Components]:
        """Acceleration of p5 and angular acceleration of the foot when θ̈ = 0.

        Links 2, 3, 4 turn with (ω_i, ω_j, ω_e), of which joints 3, 4, 5 change ω_e only, and
        each adds α × r + ω × (ω × r) of its vector x_2 i3, r3, r4. Link 2 has
        α = (q1 k) × (q2 j3) = (−ω_e ω_j, 0, ω_i ω_j), which cancels half of the terms.
        """
        q1, q2, q3, q4, q5, q6 = rate
        (v_i, v_j), (r3_i, r3_j), (r4_i, r4_j) = self.v, self.r3, self.r4
        i, j, e = -self.s2 * q1, q2, self.c2 * q1
        q34 = q3 + q4
        q345, e_3, e_4, both = q34 + q5, e + q3, e + q34, i * j
        e_2, e_3, e_4 = e * e, e_3 * e_3, e_4 * e_4
        sum_i, sum_j = q3 * r3_i + q34 * r4_i, q3 * r3_j + q34 * r4_j
        point = (
            -(j * j * v_i) - (e_2 * self.leg.x_2 + e_3 * r3_i + e_4 * r4_i),
            2.0 * both * v_i - i * i * v_j - (e_3 * r3_j + e_4 * r4_j),
            e * i * v_i + 2.0 * (i * sum_i + j * sum_j),
        )
        c, s = self.c345 * q6, self.s345 * q6  # q6 a, turned with ω
        turn = e + q345
        foot = (j * (q345 - e) - turn * s, turn * c - i * q345, both + i * s - j * c)
        return point, foot

    def torques(
        self, force: np.ndarray | Sequence[float], moment: np.ndarray | Sequence[float]
    ) -> Joints:
        """Joint torques of a wrench on the foot: z_j · (moment about p_j).

        Args:
            force: In the torso's axes [N], shape ``(3, n)``, or three floats.
            moment: About the torso's origin, in its axes [N·m], likewise.
        """
        leg, (fx, fy, fz) = self.leg, force
        about_z = moment[2] - leg.x_0 * fy  # about p2
        f = self.components(force)
        m = self.components(
            (moment[0] - leg.z_1 * fy, moment[1] + leg.z_1 * fx + leg.x_0 * fz, about_z)
        )
        about_3 = m[2] - leg.x_2 * f[1]
        about_4 = about_3 - self.r3[0] * f[1] + self.r3[1] * f[0]
        about_5 = about_4 - self.r4[0] * f[1] + self.r4[1] * f[0]
        # Joint 1 passes through p2, joint 6 through p5.
        sixth = self.c345 * (m[0] - self.v[1] * f[2]) + self.s345 * (m[1] + self.v[0] * f[2])
        return about_z, m[1], about_3, about_4, about_5, sixth

    def refuse_singular(self, first: int = 0) -> None:
        """Raise at the first sample where one of the determinant's factors vanishes.

        Args:
            first: Number of the first sample, for messages.
        """
        s2, s4, v_b = self.factors
        leg = self.leg
        # No factor vanishes where their product doesn't: |v| is at most the links' sum.
        size = abs(s2 * s4 * v_b)
        least = size if isinstance(size, float) else size.min()
        if least >= TOLERANCES.near_singular * (leg.x_2 + leg.x_3 + leg.x_4):
            return
        reasons = (
            (np.abs(s2), "hip roll is ±90° from neutral, hip yaw is free (sin γ2 = 0)"),
            (np.abs(s4), "the knee is straight or folded (sin γ4 = 0)"),
            (np.abs(v_b) / np.hypot(*self.v), "hip and ankle axes are in line (v × a = 0)"),
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
