"""The same motion run s times faster: which torques and wrenches that takes.

Speeds grow with s, accelerations and all they cause with s²; gravity's part stays, viscous friction
grows with s. So wrenches that single support determines are linear in s², torques quadratic in s.
In double support the least torques are too, as long as they don't press a sole to the border
of its wrench cone: the floor's limits are out of play there, and what is left is a linear
problem. Beyond, a quadratic programme has to be solved for each s.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import free_flying_forces, inverse_dynamics, joint_friction
from scout_pin.dynamics.load_sharing import sharing_problem
from scout_pin.dynamics.stability import planned_zmp
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from thesis_pin.contacts.sharing import LoadSharing
from thesis_pin.numeric.elementwise import Samples
from thesis_pin.numeric.inequalities import where_lines_hold
from thesis_pin.numeric.trajectory import JointTrajectory

_LIMITS_AT_ONCE = 128  # samples whose wrenches are held against some hundred facets


@dataclass(frozen=True)
class Torques:
    """Torques of some samples as functions of speed: constant + linear s + square s².

    Attributes:
        samples: Which samples of the motion, shape ``(m,)``.
        constant, linear, square: Shape ``(m, 12)`` each.
        low, high: The s² between which they hold, shape ``(m,)``.
    """

    samples: np.ndarray
    constant: np.ndarray
    linear: np.ndarray
    square: np.ndarray
    low: np.ndarray
    high: np.ndarray

    def part(self, some: Samples) -> Torques:
        """Some of the samples."""
        return Torques(**{name: values[some] for name, values in vars(self).items()})

    def at(self, some: np.ndarray, s: float) -> np.ndarray:
        """Torques of some of the samples at a speed, ``(k, 12)``."""
        return np.asarray(self.constant[some] + self.linear[some] * s + self.square[some] * s**2)


def single_support(
    robot: Scout, motion: GaitMotion, joints: JointTrajectory, torque: np.ndarray, some: np.ndarray
) -> tuple[Torques, np.ndarray]:
    """Torques where one foot stands, and where on the floor the weight acts [m], ``(m, 2)``.

    Args:
        robot: The biped.
        motion: The sampled gait.
        joints: Its joint trajectory.
        torque: Torques at s = 1, shape ``(n, 12)``.
        some: Samples, all in single support, shape ``(m,)``.
    """
    moving, at_rest = joints.part(some), motion.at_rest(some)
    still = inverse_dynamics(robot, at_rest, _still(moving))
    static, above = still.torque, planned_zmp(robot, at_rest, still)
    constant, linear = _friction(robot, moving)
    square = torque[some] - static - constant - linear
    anything = np.full(len(some), np.inf)
    return Torques(some, static + constant, linear, square, -anything, anything), above


@dataclass(frozen=True)
class DoubleSupport:
    """Samples where both feet stand, at any speed.

    Attributes:
        samples: Which samples of the motion, shape ``(m,)``.
        static, dynamic: The problem of sharing at rest, and what motion adds at s = 1.
        friction: Joint friction's constant and linear part, ``(m, 12)`` each.
    """

    samples: np.ndarray
    static: LoadSharing
    dynamic: LoadSharing
    friction: tuple[np.ndarray, np.ndarray]

    @classmethod
    def of(
        cls, robot: Scout, motion: GaitMotion, joints: JointTrajectory, some: np.ndarray
    ) -> DoubleSupport:
        """From the motion at s = 1.

        Args:
            robot: The biped.
            motion: The sampled gait.
            joints: Its joint trajectory.
            some: Samples, all in double support, shape ``(m,)``.
        """
        here, moving, at_rest = motion.part(some), joints.part(some), motion.at_rest(some)
        static = free_flying_forces(robot, *free_flyer_state(at_rest.torso, _still(moving)))
        whole = free_flying_forces(robot, *free_flyer_state(here.torso, moving))
        every = np.arange(len(some))
        problem = sharing_problem(robot, here, moving.q, static, every)
        added = whole - static
        motion_part = problem.with_load((added[:, 6:12], added[:, 12:18]), added[:, :6])
        return cls(some, problem, motion_part, _friction(robot, moving))

    @cached_property
    def free(self) -> Torques:
        """Torques while the floor's limits are out of play, and the s² between which they are."""
        wrenches = [problem.without_limits() for problem in (self.static, self.dynamic)]
        torques = [
            problem.torques(wrench)
            for problem, wrench in zip((self.static, self.dynamic), wrenches, strict=True)
        ]
        low, high = np.empty((2, len(self.samples)))
        for start in range(0, len(self.samples), _LIMITS_AT_ONCE):
            part = slice(start, start + _LIMITS_AT_ONCE)
            lines = [
                problem.beyond_limits(wrench, part)
                for problem, wrench in zip((self.static, self.dynamic), wrenches, strict=True)
            ]
            low[part], high[part] = where_lines_hold(*lines)
        constant, linear = self.friction
        return Torques(self.samples, torques[0] + constant, linear, torques[1], low, high)

    def at(self, some: np.ndarray, s: float) -> tuple[np.ndarray, np.ndarray]:
        """Torques of some of the samples at a speed by the programme, and who can't stand.

        Args:
            some: Numbers of samples among these, shape ``(k,)``.
            s: The speed.

        Returns:
            Torques ``(k, 12)``, and whether no admissible pair of wrenches exists ``(k,)``:
            the torques are then those without the floor's limits.
        """
        torque, broken = self.free.at(some, s), np.zeros(len(some), dtype=bool)
        constant, linear = self.friction
        limited = np.flatnonzero((s**2 < self.free.low[some]) | (s**2 > self.free.high[some]))
        if not limited.size:
            return torque, broken
        rows = some[limited]
        found, possible = self.static.plus(self.dynamic, s**2, rows).least_torques()
        broken[limited] = ~possible
        found += constant[rows] + linear[rows] * s
        torque[limited[possible]] = found[possible]
        return torque, broken


def _still(joints: JointTrajectory) -> JointTrajectory:
    zero = np.zeros(joints.q.shape)
    return JointTrajectory(joints.time, joints.q, zero, zero)


def _friction(robot: Scout, joints: JointTrajectory) -> tuple[np.ndarray, np.ndarray]:
    """Joint friction at s = 1: the part that stays, and the part that grows with s."""
    linear = robot.specification.assumptions.joint_friction.viscous * joints.v
    return joint_friction(robot, joints.v, joints.resting) - linear, linear
