"""Inverse dynamics of one motion in one assembly, some samples at a time."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, NoSolution, SingularPose
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import loop_gaps
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.forces.judging import (
    REFUSED,
    Contradiction,
    refuse_opening,
    refuse_singular,
)
from thesis_pin.loops.forces.loads import (
    external_forces,
    open_tree_forces,
)
from thesis_pin.loops.forces.uncertainty import State, by_noise, by_rounding
from thesis_pin.loops.forces.wrenches import base_wrenches, loop_wrenches
from thesis_pin.loops.system.equations import Poses
from thesis_pin.loops.system.idle import HARMLESS_LOAD
from thesis_pin.loops.system.newton import CUT
from thesis_pin.loops.system.solve import Solved, solve
from thesis_pin.loops.system.survey import Survey

Array = NDArray[np.float64]

UNEXPLAINED = 1e-6
"""Load outside harmless idle freedoms that counts as none, relative to the largest [-]."""


class InverseWork:
    """Inverse dynamics of one motion in one assembly, some samples at a time."""

    def __init__(
        self, robot: ClosedRobot, survey: Survey, precision: float | None, check: bool
    ) -> None:
        self.robot, self.survey, self.precision, self.check = robot, survey, precision, check
        self.data = robot.model.createData()
        self.driven = np.concatenate([robot.actuated, robot.base])

    def chunk(self, first: int, state: State) -> dict[str, NDArray[np.generic]]:
        """Every array of the result for samples ``(n, …)``, the first of them numbered."""
        robot, survey, equations = self.robot, self.survey, self.robot.system
        q, v, a, wrenches = state.q, state.v, state.a, state.wrenches
        poses = equations.poses(self.data, q, v if self.check else None)
        matrices = equations.jacobian(poses)
        if self.check:
            refuse_opening(robot, survey, poses, matrices, v, a, first)
        tau = open_tree_forces(robot, self.data, q, v, a, state.sliding)
        if wrenches:
            tau -= external_forces(robot, self.data, poses, wrenches)
        solved = solve(survey, robot.scale, matrices, tau, self.driven, robot.passive)
        rank = np.full(len(q), survey.rank)
        doubtful = (solved.weakest < max(1e-3, 100 * survey.noise)) | (
            solved.forbidden > survey.threshold
        )
        for k in np.flatnonzero(doubtful):
            rank[k] = self._judge(first, int(k), poses, matrices, tau, solved)
        uncertainty = self._uncertainty(first, state, matrices, tau, solved)
        return self._arrays(first, poses, tau, solved, rank, uncertainty)

    def _judge(
        self, first: int, k: int, poses: Poses, matrices: Array, tau: Array, solved: Solved
    ) -> int:
        """Refuse a singular sample; solve it again if it is of another assembly. Its rank."""
        robot, passive, where = self.robot, self.robot.passive, f"sample {first + k}"
        scaled = robot.scale.rows[:, None] * matrices[k] * robot.scale.columns
        try:
            refuse_singular(robot, self.survey, scaled, where)
            return self.survey.rank
        except SingularPose as error:
            other = self._another(error, poses.q[k], scaled, where)
        one = slice(k, k + 1)
        again = solve(other, robot.scale, matrices[one], tau[one], self.driven, passive)
        if self.check and again.forbidden[0] > other.threshold:
            raise SingularPose(
                "the equations forbid a motion of the motors that they allow elsewhere",
                where=where,
            )
        for item in fields(Solved):
            getattr(solved, item.name)[one] = getattr(again, item.name)
        return other.rank

    def _another(self, error: SingularPose, q: Array, scaled: Array, where: str) -> Survey:
        """The assembly of a pose that isn't generic in the one surveyed before.

        Without checks a singular pose is taken for what it is at that instant.
        """
        try:
            if not isinstance(error, Contradiction):
                raise error
            other = surveyed(self.robot, q, self.precision, again=True)
            refuse_singular(self.robot, other, scaled, where)
            return other
        except BadInput:
            if self.check:
                raise error from None
        values = self.robot.system.parts().values(scaled)
        rank = int((values > max(CUT, 10 * self.survey.noise)).sum())
        return replace(self.survey, rank=rank, passive_rank=-1, idle=())

    def _uncertainty(
        self, first: int, state: State, matrices: Array, tau: Array, solved: Solved
    ) -> Array:
        """How far the file's noise may move the torques; refused where it turns them over."""
        robot, survey, weakest = self.robot, self.survey, solved.weakest
        torque = solved.driven[:, : len(robot.actuators)]
        largest = np.abs(torque).max(axis=1, initial=0.0)
        largest = np.maximum(largest, 1e-3 * np.abs(tau).max(axis=1, initial=0.0))
        shown = by_noise(robot, survey, self.data, state, matrices, torque, largest, weakest)
        digits = by_rounding(robot, survey, state, torque, largest, weakest, self.precision)
        result = np.maximum(shown, digits)
        if self.check and (result > REFUSED).any():
            k = int(np.argmax(result > REFUSED))
            cause, remedy = f"noise {survey.noise:.1e} rad", "write the file with more digits"
            if shown[k] <= REFUSED and robot.rounding is not None:
                cause = f"nearly round in the file: {', '.join(robot.rounding.digits)}"
                remedy = "write these with all digits"
            raise SingularPose(
                f"the file's digits may turn the torques over: uncertainty {result[k]:.0%}, "
                f"{cause}, weakest motion {weakest[k]:.1e} rad",
                where=f"sample {first + k}",
                allowed=f"{REFUSED:.0%}",
                remedy=f"Keep away from this pose, or {remedy}",
            )
        return result

    def _arrays(
        self,
        first: int,
        poses: Poses,
        tau: Array,
        solved: Solved,
        rank: NDArray[np.int_],
        uncertainty: Array,
    ) -> dict[str, NDArray[np.generic]]:
        robot, survey, count = self.robot, self.survey, len(tau)
        size = np.abs(tau).max(axis=1, initial=0.0)
        size = np.where(size > 0, size, 1.0)
        rest = np.zeros_like(tau)
        rest[:, robot.passive] = solved.rest
        share = np.abs(rest) / size[:, None]
        idle_load = np.zeros((count, len(survey.idle)))
        outside = share.copy()
        for k, group in enumerate(survey.idle):
            idle_load[:, k] = share[:, group.places].max(axis=1)
            if group.light:
                harmless = idle_load[:, k] <= HARMLESS_LOAD
                outside[np.ix_(harmless, group.places)] = 0.0
        unexplained = outside.max(axis=1, initial=0.0)
        if self.check and (unexplained > UNEXPLAINED).any():
            self._refuse_unexplained(first, outside, tau)
        motors = len(robot.actuators)
        force, moment = loop_wrenches(robot.system, poses, solved.multipliers)
        driven = survey.passive_rank == survey.rank
        return {
            "torque": solved.driven[:, :motors],
            "force": force,
            "moment": moment,
            "coupling": solved.multipliers[:, robot.system.size - len(robot.couplings) :],
            "base": base_wrenches(robot, poses.q, solved.driven[:, motors:]),
            "joint_force": tau,
            "residual": share.max(axis=1, initial=0.0),
            "unexplained": unexplained,
            "idle_load": idle_load,
            "freedom": robot.model.nv - rank,
            "condition": solved.condition,
            "uncertainty": uncertainty,
            "gaps": loop_gaps(robot, robot.system.gap(poses)),
            "unique": np.full(count, driven),
            "determined": rank == robot.equations,
        }

    def _refuse_unexplained(self, first: int, outside: Array, tau: Array) -> None:
        robot = self.robot
        k, place = np.unravel_index(int(np.argmax(outside)), outside.shape)
        size = float(np.abs(tau[k]).max())
        groups = [g for g in self.survey.idle if place in g.places]
        names = ", ".join(groups[0].joints[:6]) if groups else "a joint"
        raise NoSolution(
            f"sample {first + int(k)}: neither motors nor loops carry {outside[k, place]:.1%} "
            f"of the largest load, on {names}; {len(robot.actuators)} motors for "
            f"{robot.model.nv - self.survey.rank - len(robot.base)} freedoms",
            float(outside[k, place]) * size,
            "N·m or N",
            remedy="Name more motors: name_mot of the closure file",
        )
