"""What a motion asks of each joint, apart from who drives it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.smoothing.intervals import Interval

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Loads(Brief):
    """Torques, speeds and accelerations of joints over a motion.

    Attributes:
        robot, motion: What they are called.
        joints: Names of the joints, ``k`` of them.
        time: Sample times [s], shape ``(n,)``.
        torque: What the motors give at the joints without any rotor [N·m], ``(n, k)``.
        speed: [rad/s], the same shape.
        acceleration: [rad/s²], the same shape.
        notes: What is left out of them, whole sentences.
    """

    robot: str
    motion: str
    joints: tuple[str, ...]
    time: Array
    torque: Array
    speed: Array
    acceleration: Array
    notes: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        robot: str,
        motion: str,
        joints: Sequence[str],
        time: Array,
        torque: Array,
        speed: Array,
        acceleration: Array,
        armature: Array,
        notes: Sequence[str] = (),
    ) -> Loads:
        """Loads from torques that hold rotors; in a given motion these are N² J θ̈ each.

        Args:
            robot: What it is called.
            motion: The same of the motion.
            joints: Names.
            time: [s], shape ``(n,)``.
            torque: With the rotors [N·m], shape ``(n, k)``.
            speed: [rad/s], the same shape.
            acceleration: [rad/s²], the same shape.
            armature: Of the rotors that they hold, N² J [kg·m²], shape ``(k,)``.
            notes: What is left out.
        """
        bare = torque - armature * acceleration
        return cls(robot, motion, tuple(joints), time, bare, speed, acceleration, tuple(notes))

    def part(self, joints: Sequence[int]) -> Loads:
        """The same of some of the joints."""
        some = list(joints)
        return Loads(
            self.robot,
            self.motion,
            tuple(self.joints[k] for k in some),
            self.time,
            self.torque[:, some],
            self.speed[:, some],
            self.acceleration[:, some],
            self.notes,
        )

    def with_rotor(self, armature: float) -> Array:
        """Torques of motors with such a rotor at each joint [N·m], shape ``(n, k)``."""
        return np.asarray(self.torque + armature * self.acceleration)

    def rms(self, values: Array) -> Array:
        """Root mean square over time of values ``(n, k)``: ``(k,)``."""
        duration = self.time[-1] - self.time[0]
        return np.asarray(np.sqrt(np.trapezoid(values**2, self.time, axis=0) / duration))


def resolution_notes(joints: Sequence[str], peaks: Sequence[Interval]) -> list[str]:
    """What the resolution of a motion's samples leaves open of peak torques, a sentence or none.

    Args:
        joints: Names, ``k`` of them.
        peaks: The peak torque of each, and between what it lies.
    """
    more = {name: one.high - one.value for name, one in zip(joints, peaks, strict=True)}
    name = max(more, key=lambda joint: more[joint])
    if not more[name] > 0:
        return []
    return [
        "The motion's samples have a finite resolution: peak torques may be larger than said by up "
        f"to {more[name]:.2g} N·m (at {name}); safety factors don't count that."
    ]
