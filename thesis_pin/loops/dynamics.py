"""Inverse dynamics of any robot with closed loops and motors.

Pinocchio 4 has forward dynamics for bilateral loops (``constraintDynamics``) and
no inverse dynamics. It is linear algebra: with r(q) = 0 the loop equations and
A = ∂r/∂q, the motion obeys

    M v̇ + h = B τ + Aᵀ λ.

The columns of A that belong to passive joints give λ, its other columns then the
torques. How many equations are independent is known from a walk through the assembly
(:mod:`thesis_pin.loops.system.survey`), so that a file's rounding can't pose as a real equation.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.errors import BadInput, NoSolution, SingularPose
from thesis_pin.loops.closing import loop_gaps
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.forces.judging import (
    REFUSED,
    Contradiction,
    is_uncertain,
    refuse_opening,
    refuse_singular,
    weakest_motion,
)
from thesis_pin.loops.forces.loads import (
    Wrenches,
    checked_wrenches,
    external_forces,
    open_tree_forces,
)
from thesis_pin.loops.forces.wrenches import base_wrenches, loop_wrenches
from thesis_pin.loops.forward import ForwardDynamics as ForwardDynamics
from thesis_pin.loops.forward import forward_dynamics as forward_dynamics
from thesis_pin.loops.forward import simulate as simulate
from thesis_pin.loops.surveying import surveyed
from thesis_pin.loops.system.equations import Poses
from thesis_pin.loops.system.idle import HARMLESS_LOAD, IdleGroup
from thesis_pin.loops.system.newton import CUT
from thesis_pin.loops.system.solve import Solved, solve
from thesis_pin.loops.system.survey import Survey
from thesis_pin.numeric.arrays import finite_array, together
from thesis_pin.numeric.checks import instance

Array = NDArray[np.float64]

UNEXPLAINED = 1e-6
"""Load outside harmless idle freedoms that counts as none, relative to the largest [-]."""

_CHUNK = 2048  # samples worked on at once, so that memory stays bounded


@dataclass(frozen=True)
class LoopDynamics:
    """Motor torques and loop forces of a motion.

    Attributes:
        torque: Of the motors at their joints [N·m] or [N], in their order, ``(..., motors)``.
        force: On the first frame's body at each loop's second origin, world axes [N], shape
            ``(..., loops, 3)``.
        moment: The same for loops that forbid turns [N·m], zero for ball joints and rods.
        coupling: Force of each coupling per unit of its equation, ``(..., couplings)``:
            a joint of factor f gets f times it.
        base: On a free flyer's root link, what the world must supply: force, then moment
            about its origin, world axes [N], [N·m], ``(..., 6)``; ``(..., 0)`` without one.
        joint_force: Generalized forces that the open tree needs, shape ``(..., nv)``.
        residual: Largest part of them that motors and loops leave unexplained,
            relative to the largest of them, shape ``(...)``.
        unexplained: The same without the load on harmless idle freedoms, shape ``(...)``.
        idle_load: Load on each idle group, relative to the largest force, ``(..., groups)``.
        freedom: Degrees of freedom by rank, shape ``(...)``.
        condition: Condition number of Nᵀ B, shape ``(...)``.
        uncertainty: How far the torques may be off because of the file's noise, relative to
            the largest of them, at most, shape ``(...)``.
        gaps: Opening of each loop [m], [rad], shape ``(..., loops, 2)``.
        unique: Whether the motors' torques are determined (as many as freedoms).
        determined: Whether the loop forces are (independent equations), shape ``(...)``.
        noise: How far the file's digits let dependent equations differ [rad].
        idle: Motions that no motor holds.
    """

    torque: np.ndarray
    force: np.ndarray
    moment: np.ndarray
    coupling: np.ndarray
    base: np.ndarray
    joint_force: np.ndarray
    residual: np.ndarray
    unexplained: np.ndarray
    idle_load: np.ndarray
    freedom: np.ndarray
    condition: np.ndarray
    uncertainty: np.ndarray
    gaps: np.ndarray
    unique: np.ndarray
    determined: np.ndarray
    noise: float
    idle: tuple[IdleGroup, ...]


def inverse_dynamics(
    robot: ClosedRobot,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    *,
    external: Wrenches | None = None,
    check: bool = True,
    precision: float | None = None,
) -> LoopDynamics:
    """Motor torques and loop forces that a motion of the closed robot needs.

    Damping, friction, springs and armature of the description count. Redundant motors
    share the load with the least sum of squares; loop forces that dependent equations
    leave open are the smallest that fit, metres scaled by the loop's size.

    Args:
        robot: The robot.
        q: Closed configurations, shape ``(..., nq)``.
        v: Rates that keep the loops closed, shape ``(..., nv)``.
        a: Accelerations that do, shape ``(..., nv)``.
        external: Frame → wrench that acts on it from outside: force, then moment about the
            frame's origin, world axes [N], [N·m], shape ``(6,)`` or ``(..., 6)``.
        check: Refuse motions that open the loops, and loads that neither motors nor loops
            carry.
        precision: See :func:`thesis_pin.loops.surveying.surveyed`.

    Returns:
        Torques, forces, and how well determined they are.

    Raises:
        BadInput: The motion opens a loop (see :func:`close`, :func:`follow`).
        SingularPose: Torques don't exist at a pose, or the file's noise may turn them over.
        NoSolution: Neither motors nor loops carry some load.
        ModelError: See :func:`thesis_pin.loops.surveying.surveyed`.
    """
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    q, v, a = together(
        q=finite_array("q", q, model.nq),
        v=finite_array("v", v, model.nv),
        a=finite_array("a", a, model.nv),
    )
    stack = q.shape[:-1]
    if not q.size:
        raise BadInput("the stack is empty", allowed="at least one sample")
    wrenches = checked_wrenches(robot, external, stack)
    q, v, a = (x.reshape(-1, x.shape[-1]) for x in (q, v, a))
    survey = surveyed(robot, q[0], precision)
    work = _Work(robot, survey, precision, check)
    parts = []
    for first in range(0, len(q), _CHUNK):
        some = slice(first, first + _CHUNK)
        pushed = [(frame, wrench[some]) for frame, wrench in wrenches]
        parts.append(work.chunk(first, q[some], v[some], a[some], pushed))
    joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    shaped = {name: x.reshape((*stack, *x.shape[1:])) for name, x in joined.items()}
    return LoopDynamics(**shaped, noise=survey.noise, idle=survey.idle)


class _Work:
    """Inverse dynamics of one motion in one assembly, some samples at a time."""

    def __init__(
        self, robot: ClosedRobot, survey: Survey, precision: float | None, check: bool
    ) -> None:
        self.robot, self.survey, self.precision, self.check = robot, survey, precision, check
        self.data = robot.model.createData()
        self.driven = np.concatenate([robot.actuated, robot.base])

    def chunk(
        self, first: int, q: Array, v: Array, a: Array, wrenches: list[tuple[int, Array]]
    ) -> dict[str, NDArray[np.generic]]:
        """Every array of the result for samples ``(n, …)``, the first of them numbered."""
        robot, survey, equations = self.robot, self.survey, self.robot.system
        poses = equations.poses(self.data, q, v if self.check else None)
        matrices = equations.jacobian(poses)
        if self.check:
            refuse_opening(robot, survey, poses, matrices, v, a, first)
        tau = open_tree_forces(robot, self.data, q, v, a)
        if wrenches:
            tau -= external_forces(robot, self.data, poses, wrenches)
        solved = solve(survey, robot.scale, matrices, tau, self.driven, robot.passive)
        rank = np.full(len(q), survey.rank)
        doubtful = (solved.weakest < max(1e-3, 100 * survey.noise)) | (
            solved.forbidden > survey.threshold
        )
        for k in np.flatnonzero(doubtful):
            rank[k] = self._judge(first, int(k), poses, matrices, tau, solved)
        uncertainty = self._uncertainty(first, q, v, a, matrices, tau, solved)
        return self._arrays(first, poses, tau, solved, rank, uncertainty)

    def _judge(
        self, first: int, k: int, poses: Poses, matrices: Array, tau: Array, solved: Solved
    ) -> int:
        """Refuse a singular sample; solve it again if it is of another assembly. Its rank."""
        robot, passive, where = self.robot, self.robot.passive, f"sample {first + k}"
        scaled = robot.scale.rows[:, None] * matrices[k] * robot.scale.columns
        try:
            refuse_singular(self.survey, scaled, scaled[:, passive], where)
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
            refuse_singular(other, scaled, scaled[:, self.robot.passive], where)
            return other
        except BadInput:
            if self.check:
                raise error from None
        values = np.linalg.svd(scaled, compute_uv=False)
        rank = int((values > max(CUT, 10 * self.survey.noise)).sum())
        return replace(self.survey, rank=rank, passive_rank=-1, idle=())

    def _uncertainty(
        self,
        first: int,
        q: Array,
        v: Array,
        a: Array,
        matrices: Array,
        tau: Array,
        solved: Solved,
    ) -> Array:
        """Five times what moving along the weakest motion, by the noise, does to the torques.

        Where that is little, its estimate from the weakest singular value alone.
        """
        robot, survey, scale = self.robot, self.survey, self.robot.scale
        with np.errstate(divide="ignore"):
            result = np.asarray(5 * survey.blur / solved.weakest**2)
        some = np.flatnonzero(is_uncertain(survey, solved.weakest))
        if not some.size or not survey.rank:
            return result
        scaled = scale.rows[:, None] * matrices[some] * scale.columns
        values, motions = weakest_motion(survey, scaled, robot.passive)
        motors = len(robot.actuators)
        largest = np.abs(solved.driven[some, :motors]).max(axis=1, initial=0.0)
        largest = np.maximum(largest, 1e-3 * np.abs(tau[some]).max(axis=1))
        largest_share = np.zeros(len(some))
        step = survey.blur / values
        for sign in (1.0, -1.0):
            moves = sign * step[:, None] * motions * scale.columns
            moved = np.array(
                [
                    pin.integrate(robot.model, q[k], move)
                    for k, move in zip(some, moves, strict=True)
                ]
            )
            other = robot.system.jacobian(robot.system.poses(self.data, moved))
            forces = open_tree_forces(robot, self.data, moved, v[some], a[some])
            again = solve(survey, scale, other, forces, self.driven, robot.passive).driven
            change = np.abs(again - solved.driven[some])[:, :motors].max(axis=1, initial=0.0)
            share = 5 * change / np.where(largest > 0, largest, 1.0)
            largest_share = np.maximum(largest_share, share)
        # A step as long as the way to the singularity may end beyond it: nothing is known.
        result[some] = np.where(step > 0.5 * values, np.inf, largest_share)
        if self.check and (result > REFUSED).any():
            k = int(np.argmax(result > REFUSED))
            raise SingularPose(
                f"the file's digits may turn the torques over: uncertainty {result[k]:.0%}, "
                f"noise {survey.noise:.1e} rad, weakest motion "
                f"{values[np.searchsorted(some, k)]:.1e} rad",
                where=f"sample {first + k}",
                allowed=f"{REFUSED:.0%}",
                remedy="Keep away from this pose, or write the file with more digits",
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
            remedy="Name more motors, or pass check=False",
        )
