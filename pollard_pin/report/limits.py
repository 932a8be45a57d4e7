"""How far a motion uses the motors' limits of torque and speed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, JointLimits


@dataclass(frozen=True)
class MotorUse:
    """Largest use of each motor's limits; all arrays ``(6,)``.

    Attributes:
        effort: Torque limit of every motor [N·m].
        velocity: Speed limit of every motor [rad/s].
        torque, speed: Largest share of the limit, 1 at the limit.
        torque_time, speed_time: When [s].
    """

    effort: float
    velocity: float
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
        shares = np.abs(torque) / limits.effort, np.abs(speed) / limits.velocity
        peaks = [share.max(axis=0) for share in shares]
        times = [time[share.argmax(axis=0)] for share in shares]
        return cls(limits.effort, limits.velocity, *peaks, *times)

    @property
    def within(self) -> bool:
        """Whether no motor exceeds a limit."""
        return bool(self.torque.max() <= 1.0 and self.speed.max() <= 1.0)

    def sentences(self) -> Iterator[str]:
        """The answer in words: the most loaded motors, or everything that is exceeded."""
        broken = []
        for shares, times, limit in (
            (self.torque, self.torque_time, f"{self.effort:g} N·m"),
            (self.speed, self.speed_time, f"{self.velocity:g} rad/s"),
        ):
            for k in np.flatnonzero(shares > 1.0):
                broken.append(
                    f"{ACTUATOR_SYMBOLS[k]} needs {shares[k]:.0%} of its {limit} "
                    f"(t = {times[k]:.3f} s)"
                )
        if broken:
            yield f"The motors can't do this: {'; '.join(broken)}."
            return
        torque, speed = int(self.torque.argmax()), int(self.speed.argmax())
        yield (
            f"Motors within their limits: the most loaded is {ACTUATOR_SYMBOLS[torque]} with "
            f"{self.torque[torque]:.0%} of {self.effort:g} N·m, the fastest "
            f"{ACTUATOR_SYMBOLS[speed]} with {self.speed[speed]:.0%} of {self.velocity:g} rad/s."
        )

    def document(self) -> dict[str, Any]:
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
