"""What each actuator of a robot has to do over a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class ActuatorSummary:
    """What each actuator has to do over a motion; arrays of shape ``(k,)``.

    Attributes:
        names: Actuator names.
        peak_torque: Largest |τ| [N·m].
        rms_torque: Root mean square of τ over time [N·m].
        peak_speed: Largest |θ̇| [rad/s].
        peak_power: Largest |τ θ̇| [W].
        positive_work: Work given to the mechanism [J].
        negative_work: Work taken from it [J], ≤ 0.
    """

    names: tuple[str, ...]
    peak_torque: np.ndarray
    rms_torque: np.ndarray
    peak_speed: np.ndarray
    peak_power: np.ndarray
    positive_work: np.ndarray
    negative_work: np.ndarray

    @property
    def net_work(self) -> np.ndarray:
        """Work given minus work taken back [J]."""
        return np.asarray(self.positive_work + self.negative_work)


def summarise(
    names: Sequence[str], time: np.ndarray, torque: np.ndarray, speed: np.ndarray
) -> ActuatorSummary:
    """Summary of sampled torques and speeds.

    Integrals over time use the trapezoidal rule on the samples.

    Args:
        names: Actuator names, k of them.
        time: Sample times [s], shape ``(n,)``.
        torque: τ [N·m], shape ``(n, k)``.
        speed: θ̇ [rad/s], shape ``(n, k)``.
    """
    power = torque * speed
    duration = time[-1] - time[0]
    return ActuatorSummary(
        names=tuple(names),
        peak_torque=np.abs(torque).max(axis=0),
        rms_torque=np.sqrt(np.trapezoid(torque**2, time, axis=0) / duration),
        peak_speed=np.abs(speed).max(axis=0),
        peak_power=np.abs(power).max(axis=0),
        positive_work=np.trapezoid(np.maximum(power, 0.0), time, axis=0),
        negative_work=np.trapezoid(np.minimum(power, 0.0), time, axis=0),
    )
