"""What the motors and loops of any robot have to do over a motion, as numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.dynamics import LoopDynamics
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.loops.motion.whole import WholeMotion
from thesis_pin.model.formats.writer import NO_EFFORT_LIMIT
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.report.summary import ActuatorSummary, summarise
from thesis_pin.report.tables import Table
from thesis_pin.report.torque.drawn import Drawn, Judged
from thesis_pin.report.torque.nearby import Way
from thesis_pin.report.torque.uncertainty import Headlines, headlines, shares
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class TorqueNumbers(Brief):
    """A motion of a robot and what it takes.

    Attributes:
        robot: The robot.
        motion: The motion that was asked for.
        whole: What all joints do in it.
        dynamics: Torques of the motors and forces of the loops.
        precision: What counted as dependent, if that was asked for.
        drawn: What the motion's samples leave open, judged; None if it is exact.
        external: Frame → constant wrench on it from outside: force, then moment about the
            frame's origin, world axes [N], [N·m], shape ``(6,)``.
    """

    robot: ClosedRobot
    motion: JointMotion
    whole: WholeMotion
    dynamics: LoopDynamics
    precision: float | None = None
    drawn: Drawn | None = None
    external: Mapping[str, Array] = field(default_factory=dict)

    @property
    def way(self) -> Way:
        """How the motion is carried."""
        return Way(self.robot, self.motion, self.whole, self.precision, self.external)

    @cached_property
    def headlines(self) -> Headlines | None:
        """Intervals that the motion's samples leave its numbers; None if it is exact."""
        if self.drawn is None:
            return None
        keep = self.drawn.keep
        values = (self.dynamics.torque, self.speed, self.loop_force_size)
        own = Judged(*(one[keep][None] for one in values))
        limits = self.effort_limits, self.speed_limits
        return headlines(own, self.drawn, self.joints.time[keep], limits)

    @property
    def joints(self) -> JointTrajectory:
        """Positions, rates and accelerations of all joints, Pinocchio's coordinates."""
        return self.whole.joints

    @property
    def names(self) -> tuple[str, ...]:
        """The motors, as the description calls them, in its order."""
        return tuple(motor.name for motor in self.robot.motors)

    @property
    def turning(self) -> NDArray[np.bool_]:
        """Whether each motor's joint turns rather than slides, shape ``(motors,)``."""
        known = singles(self.robot.model)
        return np.array([known[name].turns for name in self.robot.actuators], dtype=bool)

    def table(self) -> Table:
        """What every motor has to do."""
        speeds = ("rad/s" if turns else "m/s" for turns in self.turning)
        return self.actuators.table(list(zip(self.units, speeds, strict=True)))

    @property
    def units(self) -> tuple[str, ...]:
        """Unit of each motor's torque or force."""
        return tuple("N·m" if turns else "N" for turns in self.turning)

    @property
    def speed(self) -> Array:
        """Rates of the motors' joints [rad/s] or [m/s], shape ``(n, motors)``."""
        return np.asarray(self.joints.v[:, self.robot.actuated])

    @cached_property
    def power(self) -> Array:
        """Power that each motor gives to the robot [W], shape ``(n, motors)``."""
        return np.asarray(self.dynamics.torque * self.speed)

    @cached_property
    def work_done(self) -> Array:
        """Its integral since the start, by the trapezoidal rule [J], the same shape."""
        width = np.diff(self.joints.time)[:, None]
        steps = width * (self.power[1:] + self.power[:-1]) / 2
        return np.concatenate([np.zeros((1, steps.shape[1])), np.cumsum(steps, axis=0)])

    @cached_property
    def actuators(self) -> ActuatorSummary:
        """Peaks, means and work of each motor."""
        return summarise(self.names, self.joints.time, self.dynamics.torque, self.speed)

    @property
    def loop_force_size(self) -> Array:
        """Size of each loop's force [N], shape ``(n, loops)``."""
        return np.asarray(np.linalg.norm(self.dynamics.force, axis=-1))

    @property
    def effort_limits(self) -> Array:
        """Least and greatest torque of each motor [N·m] or [N], ``(2, motors)``; ±∞ without.

        A limit of zero in a URDF is one that nobody filled in; one of 1e308 says that there
        is none.
        """
        model, places = self.robot.model, self.robot.actuated
        low, high = model.lowerEffortLimit[places], model.upperEffortLimit[places]
        given = [motor.effort for motor in self.robot.motors]
        least = np.array([motor[0] for motor in given], dtype=float).reshape(-1)
        most = np.array([motor[1] for motor in given], dtype=float).reshape(-1)
        unknown = (high <= 0) & (low >= 0)
        low = np.where(unknown | (low <= -NO_EFFORT_LIMIT), -np.inf, low)
        high = np.where(unknown | (high >= NO_EFFORT_LIMIT), np.inf, high)
        return np.array([np.maximum(low, least), np.minimum(high, most)])

    @property
    def speed_limits(self) -> Array:
        """Greatest speed of each motor's joint [rad/s] or [m/s], ``(motors,)``; ∞ without."""
        given = np.array([motor.speed for motor in self.robot.motors], dtype=float).reshape(-1)
        limits = self.robot.model.upperVelocityLimit[self.robot.actuated]
        return np.asarray(np.minimum(np.where(limits > 0, limits, np.inf), given))

    @cached_property
    def effort_use(self) -> Array:
        """Largest share of each motor's torque limit, shape ``(motors,)``; 0 without a limit."""
        used = shares(self.dynamics.torque, self.effort_limits)
        return np.asarray(used.max(axis=0, initial=0.0))

    @property
    def speed_use(self) -> Array:
        """Largest share of each motor's speed limit, shape ``(motors,)``; 0 without a limit."""
        return np.asarray((np.abs(self.speed) / self.speed_limits).max(axis=0, initial=0.0))

    @cached_property
    def outside(self) -> dict[str, float]:
        """Joints that leave their range, and by how much [rad] or [m]."""
        found = {}
        for name, joint in singles(self.robot.model).items():
            excess = float(joint.excess(self.joints.q).max())
            if excess > TOLERANCES.joint_limit:
                found[name] = excess
        return found

    @property
    def unexplained(self) -> Array:
        """Load that nothing carries, relative to the largest, ``(n,)``; not on harmless idling."""
        return np.asarray(self.dynamics.unexplained)
