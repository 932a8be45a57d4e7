"""How far a motion uses the motors' limits, and how near it comes to singularities."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pollard_pin.specification import ACTUATOR_NAMES, JointLimits

MARGIN_BOUNDS = (0.05, 0.2)
"""Reach margins between nearly stretched, near and far."""
CONDITION_BOUNDS = (100.0, 30.0)
"""Condition numbers of the six motors' Jacobian between the same."""


def distance_class(margin: np.ndarray, condition: np.ndarray) -> np.ndarray:
    """0 nearly singular, 1 near, 2 far.

    Args:
        margin: Reach margins, shape ``(n,)``.
        condition: Condition numbers of the six motors' Jacobian, shape ``(n,)``.

    Returns:
        Classes as floats, shape ``(n,)``.
    """
    reach = np.digitize(margin, MARGIN_BOUNDS)
    hold = np.digitize(-condition, [-bound for bound in CONDITION_BOUNDS])
    return np.asarray(np.minimum(reach, hold).astype(float))


@dataclass(frozen=True)
class MotorUse:
    """Largest use of each motor's limits; all arrays ``(6,)``.

    Attributes:
        effort: Torque limit of every motor [N·m].
        velocity: Speed limit of every motor [rad/s].
        torque, speed: Largest share of the limit, 1 at the limit.
        torque_time, speed_time: When [s].
    """

    effort: np.ndarray
    velocity: np.ndarray
    torque: np.ndarray
    speed: np.ndarray
    torque_time: np.ndarray
    speed_time: np.ndarray

    @classmethod
    def of(
        cls, limits: JointLimits, time: np.ndarray, torque: np.ndarray, speed: np.ndarray
    ) -> MotorUse:
        """Use of the limits over samples.

        Args:
            limits: The robot's, which are assumptions.
            time: Sample times [s], shape ``(n,)``.
            torque: [N·m], shape ``(n, 6)``.
            speed: [rad/s], shape ``(n, 6)``.
        """
        peaks, times = [], []
        bounds = limits.of_motors()
        for values, limit in zip((torque, speed), bounds, strict=True):
            # A motor at a time: of a million samples the sizes of all would take 48 MB.
            which = np.array([np.abs(motor).argmax() for motor in values.T])
            peaks.append(np.abs(values[which, np.arange(len(which))]) / limit)
            times.append(time[which])
        return cls(*bounds, *peaks, *times)

    @property
    def within(self) -> bool:
        """Whether no motor exceeds a limit."""
        return bool(self.torque.max() <= 1.0 and self.speed.max() <= 1.0)

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        return {
            "actuators": list(ACTUATOR_NAMES),
            "effort": self.effort,
            "velocity": self.velocity,
            "torque_share": self.torque,
            "torque_share_time": self.torque_time,
            "speed_share": self.speed,
            "speed_share_time": self.speed_time,
            "within": self.within,
        }
