"""What a path asks of a robot from many places at once, and from which it can't be followed.

The same kinematics and dynamics as the trajectory report's, stacked over placements: from where
a report would raise an error there is a reason instead.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pollard_pin.coordinates import pose_from_placement
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.kinematics.geometry import Branch
from pollard_pin.kinematics.rates import stack_rates
from pollard_pin.kinematics.screws import Posture
from pollard_pin.kinematics.singularity import LENGTH, actuation, base_rows
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion, ToolPath
from pollard_pin.motion.placing import Placement, middle, place_path
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.specification import ACTUATORS
from pollard_pin.study.placement.judged import (
    ACTUATION,
    ARMS,
    CONDITION,
    FOLLOWED,
    LIMITS,
    NEAREST,
    OUT,
    SERIAL,
    SPEED,
    TORQUE,
    WEIGHT,
    Judged,
    arms_cross,
    pace_within,
)
from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.numeric.elementwise import BLOCK
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.numeric.workers import silent
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_JUMP = 1.0
"""Change of an angle between two samples [rad] from which a branch may have broken."""


@dataclass(frozen=True)
class Judge:
    """Judges placements of one path on one robot, at the same samples.

    Attributes:
        robot: The robot.
        path: The path where it stands.
        motion: Its samples.
        about: Its middle [m], shape ``(3,)``.
        conditions: Whether condition numbers are wanted.
        paces: Whether it is wanted how fast the path can be played.
        apart: Whether the arms of the side chains must not cross.
        worst: Largest condition number that is allowed.
    """

    robot: Pollard
    path: ToolPath
    motion: ToolMotion
    about: Array
    conditions: bool = True
    paces: bool = False
    apart: bool = False
    worst: float = math.inf

    @classmethod
    def of(
        cls,
        robot: Pollard,
        path: ToolPath,
        samples: int,
        *,
        paces: bool = False,
        apart: bool = False,
        worst: float = math.inf,
    ) -> Judge:
        """A judge of a path at evenly spaced samples."""
        return cls(robot, path, path.sample(samples), middle(path), True, paces, apart, worst)

    def placements(self, placements: Sequence[Placement], branch: Branch) -> Judged:
        """Judge placements of any kind, one by one."""
        return Judged.joined(
            [self.positions(one, branch, np.array([one.position])) for one in placements]
        )

    def positions(
        self,
        turned: Placement,
        branch: Branch,
        positions: Array,
        progress: Callable[[int, int], None] = silent,
    ) -> Judged:
        """Judge positions of a path that is turned and mirrored alike.

        Args:
            turned: Says how; its own position isn't looked at.
            branch: Which solution of inverse kinematics.
            positions: What is added to x, y, z [m], shape ``(m, 3)``.
            progress: Called with the placements done and their total.
        """
        stand = Placement((0.0, 0.0, 0.0), turned.turn, turned.mirrored)
        tool, angles = self.motion.tool, self.motion.pose[:, 3:]
        if not stand.moves_only:
            tool = stand.of_tool(tool, self.about)
            angles = pose_from_placement(tool.position, tool.rotation)[:, 3:]
        found, many = Judged.none(len(positions)), max(1, BLOCK // len(angles))
        for start in range(0, len(positions), many):
            part = np.arange(start, min(start + many, len(positions)))
            chunk = _Chunk(self, stand, branch, tool, angles, positions[part])
            found.put(part, chunk.judged())
            progress(int(part[-1]) + 1, len(positions))
        return found


@dataclass(frozen=True)
class _Chunk:
    """A few placements whose samples stay in the cache together."""

    judge: Judge
    stand: Placement
    branch: Branch
    tool: BodyMotion
    angles: Array
    positions: Array

    def judged(self) -> Judged:
        """Judge them."""
        robot, count, many = self.judge.robot, len(self.angles), len(self.positions)
        found = Judged.none(many)
        pose = np.empty((many, count, 6))
        pose[..., :3] = self.tool.position + self.positions[:, None]
        pose[..., 3:] = self.angles
        solutions = robot.inverse_kinematics(pose, self.branch)
        found.margin[:] = solutions.margin.min(axis=1)
        found.reason[~solutions.valid.all(axis=1)] = LIMITS
        found.reason[~solutions.reachable.all(axis=1)] = OUT
        some = np.flatnonzero(found.reason == FOLLOWED)
        q = solutions.angles[some]
        leaps = (np.abs(np.diff(q, axis=1)) > _JUMP).any(axis=(1, 2))
        for k in some[leaps]:
            found.reason[k] = self._followed(pose[k], self.positions[k])
        kept = found.reason[some] == FOLLOWED
        some, q = some[kept], q[kept]
        if some.size:
            found.crossed[some] = arms_cross(robot.geometry, q).any(axis=1)
            found.reason[some[found.crossed[some] & self.judge.apart]] = ARMS
            kept = found.reason[some] == FOLLOWED
            some, q = some[kept], q[kept]
        if some.size:
            self._sines(found, some, q)
            kept = found.reason[some] == FOLLOWED
            self._loads(found, some[kept], q[kept])
        for name in ("margin", "clearance"):
            getattr(found, name)[(found.reason > FOLLOWED) & (found.reason < CONDITION)] = np.nan
        return found

    def _followed(self, pose: Array, position: Array) -> int:
        """Why a path can't be followed some of whose angles leap: by a turn, or off its branch."""
        x, y, z = position.tolist()
        there = Placement((x, y, z), self.stand.turn, self.stand.mirrored)
        tool = Placement((x, y, z)).of_tool(self.tool, self.judge.about)
        path = place_path(self.judge.path, there)
        motion = ToolMotion(self.judge.motion.time, tool, pose, path)
        try:
            joint_trajectory(self.judge.robot, motion, branch=self.branch)
        except Unreachable:
            return LIMITS
        except SingularPose:
            return SERIAL
        return FOLLOWED

    def _sines(self, found: Judged, some: NDArray[np.intp], q: Array) -> None:
        """Clearance from singular sets, and what lies in one."""
        shape = q.shape[:2]
        sines = np.abs(Posture.of(self.judge.robot.geometry, q).serial_sines)
        least = sines.min(axis=1)
        found.clearance[some], found.nearest[some] = least.min(axis=1), least.argmin(axis=1)
        regular = found.clearance[some] > TOLERANCES.near_singular
        found.reason[some[~regular]] = SERIAL
        some, q = some[regular], q[regular]
        if not some.size:
            return
        rows = base_rows(Posture.of(self.judge.robot.geometry, q.reshape(-1, 12)))
        determinant = np.linalg.det(rows)
        volume = np.abs(determinant) / np.linalg.norm(rows, axis=-1).prod(axis=-1)
        signs = np.sign(determinant).reshape(-1, shape[1])
        found.reason[some[(signs != signs[:, :1]).any(axis=1) | (signs[:, 0] == 0)]] = ACTUATION
        open_by = volume.reshape(-1, shape[1]).min(axis=1)
        nearer = open_by < found.clearance[some]
        found.clearance[some[nearer]] = open_by[nearer]
        found.nearest[some[nearer]] = len(NEAREST) - 1

    def _loads(self, found: Judged, some: NDArray[np.intp], q: Array) -> None:
        """Torques, speeds, and what else is wanted, of what can be followed."""
        if not some.size:
            return
        judge, many, count = self.judge, len(some), q.shape[1]
        flat = np.ascontiguousarray(q.reshape(-1, 12))
        tool = _repeated(self.tool, many)
        v, a = stack_rates(judge.robot.geometry, flat, tool)
        posture = Posture.of(judge.robot.geometry, flat)
        try:
            torque = inverse_dynamics_at(judge.robot, flat, v, a, posture).torque
        except SingularPose:  # the rods pull in one direction at some sample of some placement
            if many == 1:
                found.reason[some] = ACTUATION
            else:
                for k in range(many):
                    self._loads(found, some[k : k + 1], q[k : k + 1])
            return
        torque, speed = torque.reshape(many, count, 6), v[:, ACTUATORS].reshape(many, count, 6)
        found.torque[some] = np.abs(torque).max(axis=1)
        found.speed[some] = np.abs(speed).max(axis=1)
        if judge.conditions or judge.worst < math.inf:
            condition = actuation(posture, LENGTH).condition
            found.condition[some] = condition.reshape(many, count).max(axis=1)
        effort, velocity = judge.robot.specification.assumptions.joint_limits.of_motors()
        if judge.paces:
            still = np.zeros_like(v)
            weight = inverse_dynamics_at(judge.robot, flat, still, still, posture).torque
            found.pace[some] = pace_within(
                torque, weight.reshape(torque.shape), speed, effort, velocity
            )
            found.reason[some[found.pace[some] == 0.0]] = WEIGHT
        else:
            found.reason[some[(found.speed[some] > velocity).any(axis=1)]] = SPEED
            found.reason[some[(found.torque[some] > effort).any(axis=1)]] = TORQUE
        found.reason[some[found.condition[some] > judge.worst]] = CONDITION


def _repeated(tool: BodyMotion, many: int) -> BodyMotion:
    """A motion of the tool many times, one after the other; positions aren't looked at."""
    every = (tool.rotation, tool.position, tool.velocity, tool.acceleration, tool.omega, tool.alpha)
    return BodyMotion(*(np.tile(one, (many, *[1] * (one.ndim - 1))) for one in every))
