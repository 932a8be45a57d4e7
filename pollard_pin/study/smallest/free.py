"""How short a path may be done with which motors.

The path's geometry stays, its law of time is free: from rest to rest, at rest in corners.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.timing.course import Course
from thesis_pin.errors import Infeasible
from thesis_pin.sizing.loads import Array, Loads
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.timing.fastest import fastest
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.solving import SPARE
from thesis_pin.timing.track import Grid


@dataclass(frozen=True, eq=False)
class AnyLaw:
    """A path whose law of time is free, held against motors.

    Attributes:
        report: The path's report in any timing.
        factor: Least safety factor.
    """

    report: TrajectoryReport
    factor: float = 1.0

    @cached_property
    def course(self) -> Course:
        """The path's geometry on the robot."""
        path = replace(self.report.path, made_for=None)  # whose it is, the report has said
        return Course.of(self.report.robot, path, self.report.branch)

    @property
    def notes(self) -> list[str]:
        """What was made of the path, whole sentences."""
        return [f"{note[0].upper()}{note[1:].rstrip('.')}." for note in self.course.notes]

    def limits(self, torque: Array, family: Family) -> Limits:
        """Limits of motors of a kind.

        Args:
            torque: Stall torque of each [N·m], shape ``(6,)``.
            family: Which motors.
        """
        return self.limits_of(
            torque, family.speeds(torque), family.rotors(torque), line=family.bound == "line"
        )

    def limits_of(self, torque: Array, speed: Array, rotor: Array, *, line: bool) -> Limits:
        """Limits of motors.

        Args:
            torque: Stall torque of each [N·m], shape ``(6,)``.
            speed: No-load or greatest speed of each [rad/s], likewise.
            rotor: N² J of each [kg·m²], likewise.
            line: Whether torque and speed bound each other.
        """
        own = self.report.robot.specification.motors.armature()
        return Limits(ACTUATOR_NAMES, torque / self.factor, speed, line, rotor - own)

    def fastest(self, limits: Limits, grid: Grid) -> float:
        """Shortest time of the path on a grid [s]; infinite if the motors can't even hold it."""
        try:
            return fastest(grid, limits.tightened(SPARE)).duration
        except Infeasible:
            return math.inf

    def scaled(self, limits: Limits, loads: Loads, weight: Array) -> float | None:
        """Shortest time with the given law run faster or slower as a whole [s].

        Args:
            limits: Of the motors.
            loads: Of the given law, without rotors.
            weight: Torques that hold the robot still at the same samples [N·m], ``(n, 6)``.

        Returns:
            None if the motors can't even hold it.
        """
        rotor = self.report.robot.specification.motors.armature()
        rotor = rotor if limits.rotor is None else rotor + limits.rotor
        moved = loads.torque - weight + rotor * loads.acceleration
        share, growth = weight / limits.effort, np.abs(loads.speed) / limits.speed
        if (np.abs(share) > 1.0).any():
            return None
        bend = moved / limits.effort
        # ±(share + bend s²) + growth s ≤ 1: the first root of each from s = 0 on.
        most = np.inf if limits.line else 1.0 / max(float(growth.max()), 1e-300)
        linear = growth if limits.line else np.zeros_like(growth)
        for sign in (1.0, -1.0):
            square, rest = sign * bend, 1.0 - sign * share
            under = np.maximum(linear**2 + 4.0 * square * rest, 0.0)
            below = linear + np.sqrt(under)
            reach = linear**2 + 4.0 * square * rest >= 0.0
            with np.errstate(divide="ignore", invalid="ignore"):
                root = np.where(reach & (below > 0.0), 2.0 * rest / below, np.inf)
            most = min(most, float(root.min()))
        return self.report.path.duration / most if most > 0.0 else None
