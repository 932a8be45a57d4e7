"""The plan at an engine's own times: angles, rates and torques, stretch by stretch."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from pollard_pin.dynamics.inverse import inverse_dynamics
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.report.document import TrajectoryReport

STRETCH = 0.1
"""Length of a stretch [s]: memory stays bounded, and Ctrl-C and progress are prompt."""


@dataclass(frozen=True)
class Stretch:
    """Some steps of the plan, with the middle of each.

    Attributes:
        time: Ends and middles of c steps [s], shape ``(2c + 1,)``.
        q, v: Joint angles [rad] and rates [rad/s], each ``(2c + 1, 12)``.
        motors: Angles, rates and torques of the motors, shape ``(2c + 1, 3, 6)``.
    """

    time: np.ndarray
    q: np.ndarray
    v: np.ndarray
    motors: np.ndarray

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(self.time) // 2

    @property
    def held(self) -> np.ndarray:
        """What a controller asks for at the beginning of each step, ``(c, 3, 6)``.

        A torque that is held for a step is the mean over it, by Simpson's rule.
        """
        start, middle, end = self.motors[:-1:2], self.motors[1::2], self.motors[2::2]
        found = start.copy()
        found[:, 2] = (start[:, 2] + 4 * middle[:, 2] + end[:, 2]) / 6
        return found


def stretches(report: TrajectoryReport, time_step: float) -> Iterator[Stretch]:
    """The plan of a report in equal steps, from its beginning to its end.

    Args:
        report: With six motors.
        time_step: Of the engine [s]; the path's duration is a multiple of it.
    """
    robot, path, near = report.robot, report.path, report.joints.part(np.array([0])).q[0]
    steps, first = round(path.duration / time_step), 0
    size = max(1, round(STRETCH / time_step))
    motors = list(robot.actuated)
    while first < steps:
        last = min(first + size, steps)
        half = np.arange(2 * first, 2 * last + 1)
        time = np.minimum(half * (path.duration / (2 * steps)), path.duration)
        motion = path.at(time)
        joints = joint_trajectory(robot, motion, branch=report.branch, reference=near)
        torque = inverse_dynamics(robot, motion, joints).torque
        found = np.stack([joints.q[:, motors], joints.v[:, motors], torque], axis=1)
        yield Stretch(time, joints.q, joints.v, found)
        near, first = joints.q[-1], last
