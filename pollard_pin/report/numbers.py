"""The numbers of a path on a robot, worked out where they are first asked for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from pollard_pin.dynamics.inverse import PollardDynamics, inverse_dynamics_at
from pollard_pin.dynamics.reactions import joint_reactions
from pollard_pin.kinematics.geometry import Branch
from pollard_pin.kinematics.singularity import (
    Actuation,
)
from pollard_pin.kinematics.solutions import Solutions
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion, ToolPath
from pollard_pin.report.judged.limits import MotorUse, distance_class
from pollard_pin.specification import (
    ACTUATOR_NAMES,
    ACTUATORS,
)
from thesis_pin.display.brief import Brief
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.numeric.arrays import ascending
from thesis_pin.numeric.elementwise import blocks, intervals
from thesis_pin.numeric.long import gathered
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.report.summary import ActuatorSummary, summarise_parts

if TYPE_CHECKING:  # six motors on an exact path need none of them
    from pollard_pin.dynamics.three_motors import ThreeTorques
    from pollard_pin.dynamics.variants import Drawn
    from pollard_pin.report.uncertainty.headlines import Headlines

_REACTION_SAMPLES = 2000  # joint reactions are a loop over samples; peaks need no more


@dataclass(frozen=True)
class TrajectoryNumbers(Brief):
    """Everything known of a path on a robot.

    Attributes:
        robot, path, branch: What was asked about.
        motors: ``"six"``, or ``"three"`` for the thesis's form.
        motion: Sampled path.
        joints: Joint trajectory.
        solutions: Its margins and residuals.
        dynamics: Torques and ball-joint forces with six motors.
        holding: Condition and determinants of the actuation.
        three: The thesis's form, if it was asked for.
        drawn: What the path's samples leave open, judged; None if it is exact.
    """

    robot: Pollard
    path: ToolPath
    branch: Branch
    motors: Literal["six", "three"]
    motion: ToolMotion
    joints: JointTrajectory
    solutions: Solutions
    dynamics: PollardDynamics
    holding: Actuation
    three: ThreeTorques | None
    drawn: Drawn | None = None

    @cached_property
    def headlines(self) -> Headlines | None:
        """Intervals that the path's samples leave its numbers; None if it is exact."""
        if self.drawn is None:
            return None
        from pollard_pin.dynamics.variants import Judged
        from pollard_pin.report.uncertainty.headlines import headlines

        keep = self.drawn.keep
        values = {
            "torque": self.torque[keep],
            "speed": self.joints.part(keep).v[:, ACTUATORS],
            "loop_force": self.loop_force_size[keep],
            "reach": self.solutions.margin[keep],
        }
        own = Judged(**{name: value[None] for name, value in values.items()})
        use = self.motor_use
        return headlines(own, self.drawn, self.joints.time[keep], (use.effort, use.velocity))

    @cached_property
    def torque(self) -> np.ndarray:
        """Motor torques [N·m], shape ``(n, 6)``; the wrist's are zero in the thesis's form."""
        if self.three is None:
            return self.dynamics.torque
        wrist = np.zeros((len(self.joints.time), 3))
        return np.concatenate([self.three.torque, wrist], axis=1)

    @property
    def speed(self) -> np.ndarray:
        """Motor speeds [rad/s], shape ``(n, 6)``."""
        count = len(self.joints.time)
        return gathered(count, self.joints.part, lambda part: part.v[:, ACTUATORS])

    @cached_property
    def tool_speed(self) -> np.ndarray:
        """Speed of the spray tip [m/s], shape ``(n,)``."""
        count = len(self.joints.time)
        return gathered(
            count,
            self.motion.part,
            lambda part: np.asarray(np.linalg.norm(part.tool.velocity, axis=1)),
        )

    @property
    def power(self) -> np.ndarray:
        """Motor power [W], shape ``(n, 6)``."""
        return np.asarray(self.torque * self.speed)

    @cached_property
    def actuators(self) -> ActuatorSummary:
        """Peaks, RMS, power and work of each motor."""
        time, torque = self.joints.time, self.torque
        return summarise_parts(
            ACTUATOR_NAMES,
            (
                (time[part], torque[part], self.joints.part(part).v[:, ACTUATORS])
                for part in intervals(len(time))
            ),
        )

    @cached_property
    def motor_use(self) -> MotorUse:
        """How far the motors' limits are used; the limits are assumptions."""
        limits = self.robot.specification.assumptions.joint_limits
        return MotorUse.of(limits, self.joints.time, self.torque, self.speed)

    @cached_property
    def work_done(self) -> np.ndarray:
        """Work of each motor since the start [J], shape ``(n, 6)``."""
        torque, work = self.torque, np.zeros((len(self.joints.time), 6))
        for part in intervals(len(work)):
            some = self.joints.part(part)
            power = torque[part] * some.v[:, ACTUATORS]
            step = np.diff(some.time)[:, None] * (power[1:] + power[:-1]) / 2
            work[part] = np.cumsum(
                np.concatenate([work[part.start : part.start + 1], step]), axis=0
            )
        return work

    @cached_property
    def energy_change(self) -> float:
        """Kinetic plus potential energy at the end minus at the start [J]."""
        ends = self.joints.part(np.array([0, -1]))
        start, end = self.robot.energy(ends.q, ends.v)
        return float(end - start)

    @property
    def work_exchanged(self) -> float:
        """Positive minus negative work of all motors [J], what balances are judged by."""
        a = self.actuators
        return float(a.positive_work.sum() - a.negative_work.sum())

    @property
    def energy_error(self) -> float:
        """Net work of all motors minus the change of energy [J]; rounding with six motors."""
        return float(self.actuators.net_work.sum()) - self.energy_change

    @property
    def relative_energy_error(self) -> float:
        """Size of :attr:`energy_error` over the work exchanged; zero if none was."""
        exchanged = self.work_exchanged
        return abs(self.energy_error) / exchanged if exchanged else 0.0

    @cached_property
    def distance_class(self) -> np.ndarray:
        """0 nearly singular, 1 near, 2 far, shape ``(n,)``."""
        return distance_class(self.solutions.margin, self.holding.condition)

    @cached_property
    def loop_force_size(self) -> np.ndarray:
        """Size of the two ball-joint forces [N], shape ``(n, 2)``."""
        return np.asarray(np.linalg.norm(self.dynamics.loop_force, axis=-1))

    @cached_property
    def peak_reactions(self) -> tuple[np.ndarray, np.ndarray]:
        """Largest force [N] and moment [N·m] in each of the twelve joints, each ``(12,)``.

        Taken over at most 2 000 evenly spread samples.
        """
        count = len(self.joints.time)
        some = ascending(np.linspace(0, count - 1, min(count, _REACTION_SAMPLES)).astype(int))
        joints, forces = self.joints.part(some), self.dynamics.loop_force[some]
        wrench = joint_reactions(self.robot, joints.q, joints.v, joints.a, forces)
        return (
            np.linalg.norm(wrench[..., :3], axis=-1).max(axis=0),
            np.linalg.norm(wrench[..., 3:], axis=-1).max(axis=0),
        )

    @cached_property
    def other_reading(self) -> tuple[Reading, np.ndarray]:
        """The other reading of the inertias and its peak torques of six motors [N·m]."""
        reading: Reading = "printed" if self.robot.inertia == "physical" else "physical"
        other = Pollard(self.robot.specification, reading)
        peaks = []
        for part in blocks(len(self.joints.time)):
            some = self.joints.part(part)
            found = inverse_dynamics_at(other, some.q, some.v, some.a)
            peaks.append(np.abs(found.torque).max(axis=0))
        return reading, np.max(peaks, axis=0)
