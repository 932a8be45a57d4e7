"""Whether a motion keeps both ball joints together."""

from __future__ import annotations

import numpy as np

from pollard_pin.kinematics.screws import Posture
from thesis_pin.errors import BadInput
from thesis_pin.numeric.vectors import Vector, cross, dot
from thesis_pin.tolerances import TOLERANCES


def refuse_open_loops(posture: Posture, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> None:
    """Refuse motions ``(..., 12)`` that don't keep both ball joints together.

    Raises:
        BadInput: A configuration, rate or acceleration opens a loop; says by how much.
    """
    opening = np.linalg.norm(posture.opening, axis=-1)
    if not (opening < TOLERANCES.loop_closure).all():
        raise BadInput(
            f"the configuration opens a ball joint by {float(opening.max()):.2e} m",
            allowed=f"{TOLERANCES.loop_closure:.0e} m",
            remedy="Use angles from inverse_kinematics or forward_kinematics",
        )
    rates, accelerations = (np.broadcast_to(x, q.shape).reshape(-1, 12).T for x in (v, a))
    for i in (0, 1):
        swing = _Swing(posture, rates, i)
        speed = 1.0 + np.abs(rates).max(axis=0)
        _refuse(swing.gap_rate(), speed, f"the rates open ball joint {i + 1} at", "m/s", "rates")
        size = speed**2 + np.abs(accelerations).max(axis=0)
        gap = swing.gap_acceleration(accelerations)
        _refuse(gap, size, f"the accelerations open ball joint {i + 1} at", "m/s²", "accelerations")


def _refuse(gap: Vector, size: np.ndarray, what: str, unit: str, name: str) -> None:
    opening, limit = np.sqrt(dot(gap, gap)), TOLERANCES.loop_motion * size
    if not (opening <= limit).all():
        sample = int(np.argmax(~(opening <= limit)))
        raise BadInput(
            f"{what} {opening[sample]:.2e} {unit}",
            where=f"sample {sample}",
            allowed=f"{limit[sample]:.1e} {unit}",
            remedy=f"Use the {name} of joint_motion",
        )


class _Swing:
    """Motion of both sides of ball joint i: its place on the forearm, and the rod's tip.

    Args:
        posture: Postures of n samples.
        rates: Of the twelve joints [rad/s], shape ``(12, n)``.
        i: 0 or 1.
    """

    def __init__(self, posture: Posture, rates: np.ndarray, i: int) -> None:
        self.posture, self.k, self.i = posture, rates, i
        k_21, k_65, _ = self.side = rates[6 + 3 * i : 9 + 3 * i]
        self.pitch, self.yaw = posture.pitch_axes[i], posture.yaw_axes[i]
        self.omega_b = k_65 * self.pitch + _along(2, k_21)
        self.turn_axis = posture.forearm_axes[2]

    def gap_rate(self) -> Vector:
        """Velocity of the one relative to the other [m/s], ``(3, n)``."""
        return self._gap(self.k)

    def _gap(self, k: np.ndarray) -> Vector:
        """What joint numbers k, rates or accelerations, do to the gap by themselves."""
        posture, i = self.posture, self.i
        k_21, k_65, k_76 = k[6 + 3 * i : 9 + 3 * i]
        elbow = cross(_along(1, k[0]), posture.upper_arm)
        omega = _along(1, k[0] + k[1]) + k[2] * self.turn_axis
        turn = _along(2, k_21) + k_65 * self.pitch + k_76 * self.yaw
        tip = cross(_along(2, k_21), posture.arms[i]) + cross(turn, posture.rods[i])
        return np.asarray(elbow + cross(omega, posture.levers[i]) - tip)

    def gap_acceleration(self, a: np.ndarray) -> Vector:
        """Acceleration of the one relative to the other [m/s²], ``(3, n)``."""
        posture, k, i = self.posture, self.k, self.i
        k_21, k_65, k_76 = self.side
        omega_f = _along(1, k[0] + k[1]) + k[2] * self.turn_axis
        bend_f = (k[0] + k[1]) * k[2] * cross(_along(1, np.ones_like(k_21)), self.turn_axis)
        anchor = cross(bend_f, posture.levers[i]) - k[0] ** 2 * posture.upper_arm
        anchor = anchor + cross(omega_f, cross(omega_f, posture.levers[i]))
        omega_u = self.omega_b + k_76 * self.yaw
        bend_u = k_65 * cross(_along(2, k_21), self.pitch) + k_76 * cross(self.omega_b, self.yaw)
        tip = cross(bend_u, posture.rods[i]) + cross(omega_u, cross(omega_u, posture.rods[i]))
        return np.asarray(self._gap(a) + anchor - (tip - k_21**2 * posture.arms[i]))


def _along(axis: int, values: np.ndarray) -> Vector:
    """Vectors along a base axis: ``(n,)`` → ``(3, n)``."""
    found = np.zeros((3, *values.shape))
    found[axis] = values
    return found
