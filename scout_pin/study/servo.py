"""What a position servo has to be told so that it is where a plan wants it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance, real


@dataclass(frozen=True)
class ServoGains:
    """How a position servo answers: torque = stiffness · (command − angle) − damping · rate.

    Attributes:
        stiffness: [N·m/rad].
        damping: [N·m·s/rad].

    Raises:
        BadInput: The stiffness isn't positive, or the damping is negative.
    """

    stiffness: float = 20.0
    damping: float = 0.05

    def __post_init__(self) -> None:
        """Refuse what no servo has."""
        real("the servos' stiffness", self.stiffness, low=1e-6, high=1e9, unit="N·m/rad")
        real("the servos' damping", self.damping, low=0.0, high=1e9, unit="N·m·s/rad")


def sag_compensated(
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    torque: ArrayLike,
    gains: ServoGains,
    *,
    damping: float = 0.0,
    armature: ArrayLike = 0.0,
) -> np.ndarray:
    """Angles to command so that servos that give way are at the planned ones.

    θ_cmd = θ + (τ + (k_v + b) θ̇ + J_a θ̈) / k_p: a servo of stiffness k_p gives the torque that
    the motion needs only where its command is ahead of the angle by so much.

    Args:
        q: Planned angles [rad], shape ``(n, k)``.
        v: Their rates [rad/s], ``(n, k)``.
        a: Their accelerations [rad/s²], ``(n, k)``.
        torque: What the motors have to give [N·m], ``(n, k)``.
        gains: k_p and k_v.
        damping: b, viscous friction of the joints that ``torque`` leaves out [N·m·s/rad].
        armature: J_a, inertia of the rotors that ``torque`` leaves out [kg·m²], one number or
            ``(k,)``.

    Returns:
        Commands [rad], ``(n, k)``.

    Raises:
        WrongShape: The arrays' shapes differ.
    """
    instance("gains", gains, ServoGains, "scout_pin.study.servo.ServoGains()")
    angle, rate, second, effort = (
        finite_array(name, values, None)
        for name, values in (("q", q), ("v", v), ("a", a), ("torque", torque))
    )
    for name, values in (("v", rate), ("a", second), ("torque", effort)):
        if values.shape != angle.shape:
            raise WrongShape(name, values.shape, f"{angle.shape}, as q")
    rotors = finite_array("armature", armature)
    ahead = effort + (gains.damping + damping) * rate + rotors * second
    return np.asarray(angle + ahead / gains.stiffness)
