"""Inverse and forward dynamics of any robot with closed loops and motors.

Pinocchio 4 has forward dynamics for bilateral loops (``constraintDynamics``) and
no inverse dynamics. It is linear algebra: with r(q) = 0 the loop equations and
A = ∂r/∂q, the motion obeys

    M v̇ + h = B τ + Aᵀ λ,

and in a basis N of the motions the loops allow (A N = 0) the unknown λ drops
out: Nᵀ B τ = Nᵀ (M v̇ + h). Its rank says whether the motors can hold the robot,
its condition how well; λ follows from the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from thesis_pin.errors import BadInput, ThesisPinError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.kinematics import (
    constraint_drift,
    constraints,
    each,
    newton_close,
    project_rates,
    residual,
)
from thesis_pin.numeric.arrays import finite_array, together, vector
from thesis_pin.numeric.checks import function, instance, real
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import TOLERANCES

_SHORTEST = 1e-9
"""Least duration and step of a simulation [s]."""


@dataclass(frozen=True)
class LoopDynamics:
    """Motor torques and loop forces of a motion.

    Attributes:
        torque: Of the motors [N·m] or [N], in their order, shape ``(..., motors)``.
        force: On the first frame's body at each loop, world axes [N], ``(..., loops, 3)``.
        moment: The same for 6d loops [N·m], zero for ball joints, ``(..., loops, 3)``.
        joint_force: RNEA's generalized forces of the open tree, shape ``(..., nv)``.
        residual: Largest part of them that motors and loops leave unexplained,
            relative to the largest of them, shape ``(...)``.
        freedom: Degrees of freedom by rank, shape ``(...)``.
        condition: Condition number of Nᵀ B, shape ``(...)``.
        unique: Whether the motors' torques are determined (as many as freedoms).
        determined: Whether the loop forces are (independent equations), shape ``(...)``.
    """

    torque: np.ndarray
    force: np.ndarray
    moment: np.ndarray
    joint_force: np.ndarray
    residual: np.ndarray
    freedom: np.ndarray
    condition: np.ndarray
    unique: np.ndarray
    determined: np.ndarray


def inverse_dynamics(
    robot: ClosedRobot, q: ArrayLike, v: ArrayLike, a: ArrayLike, *, check: bool = True
) -> LoopDynamics:
    """Motor torques and loop forces that a motion of the closed robot needs.

    Redundant motors share the load with the least sum of squares; loop forces that
    dependent equations leave open are the smallest that fit.

    Args:
        robot: The robot.
        q: Closed configurations, shape ``(..., nq)``.
        v: Rates that keep the loops closed, shape ``(..., nv)``.
        a: Accelerations that do, shape ``(..., nv)``.
        check: Refuse motions that open the loops.

    Returns:
        Torques, forces, and how well determined they are.

    Raises:
        BadInput: The motion opens a loop (see :func:`close`, :func:`follow`).
    """
    model = instance("robot", robot, ClosedRobot, "load()").model
    q, v, a = together(
        q=finite_array("q", q, model.nq),
        v=finite_array("v", v, model.nv),
        a=finite_array("a", a, model.nv),
    )
    stack = q.shape[:-1]
    if not q.size:
        raise BadInput("the stack is empty", allowed="at least one sample")
    q, v, a = (x.reshape(-1, x.shape[-1]) for x in (q, v, a))
    data, count = model.createData(), len(q)
    tau, matrices = np.empty((count, model.nv)), np.empty((count, robot.equations, model.nv))
    rotations = np.empty((count, len(robot.loops), 3, 3))
    for k in range(count):
        opening, matrices[k], rotations[k] = constraints(robot, data, q[k])
        if check:
            _check_motion(robot, data, k, opening, matrices[k], q[k], v[k], a[k])
        tau[k] = pin.rnea(model, data, q[k], v[k], a[k])
    torque, multipliers, info = _solve(robot, tau, matrices)
    force, moment = _wrenches(robot, multipliers, rotations)
    loops = (*stack, len(robot.loops), 3)
    return LoopDynamics(
        torque.reshape(*stack, -1),
        force.reshape(loops),
        moment.reshape(loops),
        tau.reshape(*stack, -1),
        *(values.reshape(stack) for values in info),
    )


def forward_dynamics(
    robot: ClosedRobot, q: ArrayLike, v: ArrayLike, torque: ArrayLike
) -> np.ndarray:
    """Joint accelerations of the closed robot under motor torques, shape ``(..., nv)``.

    Pinocchio's ``constraintDynamics``; the loops' own drift isn't corrected here, see
    :func:`simulate`.
    """
    instance("robot", robot, ClosedRobot, "load()")
    return each(robot, ForwardDynamics(robot), q=q, v=v, torque=torque)


class ForwardDynamics:
    """``constraintDynamics`` with its models, data and settings kept between calls.

    Args:
        robot: The robot.
        damping: Proximal regularisation; it vanishes with the iterations and lets
            dependent equations (planar loops in space) through.
    """

    def __init__(self, robot: ClosedRobot, *, damping: float = 1e-8) -> None:
        self.robot, self.damping = robot, damping
        self.data = robot.model.createData()
        self.models = robot.rigid_constraint_models()
        self.datas = pin.StdVec_RigidConstraintData()
        for model in self.models:
            self.datas.append(model.createData())
        self.settings = pin.ProximalSettings(1e-14, damping, 50)
        pin.initConstraintDynamics(robot.model, self.data, self.models, self.datas)

    def __reduce__(self) -> tuple[object, ...]:
        """Pinocchio's constraints can't travel; they are made again of the robot."""
        return partial(ForwardDynamics, damping=self.damping), (self.robot,)

    def __call__(self, q: np.ndarray, v: np.ndarray, torque: np.ndarray) -> np.ndarray:
        """Accelerations ``(nv,)`` of one state under motor torques ``(motors,)``."""
        tau = np.zeros(self.robot.model.nv)
        tau[self.robot.actuated] = torque
        return np.asarray(
            pin.constraintDynamics(
                self.robot.model, self.data, q, v, tau, self.models, self.datas, self.settings
            ).copy()
        )


def simulate(
    robot: ClosedRobot,
    q: ArrayLike,
    v: ArrayLike,
    torque: Callable[[float, np.ndarray, np.ndarray], np.ndarray],
    duration: float,
    step: float = 1e-3,
) -> JointTrajectory:
    """Motion of the closed robot under motor torques.

    Runge–Kutta of order four; after every step position and rates are projected
    back onto the closed loops, so drift can't grow.

    Args:
        robot: The robot.
        q: Closed configuration to start from, shape ``(nq,)``.
        v: Rates to start from, shape ``(nv,)``; what opens a loop is removed.
        torque: Function of time [s], q and v that returns ``(motors,)``.
        duration: How long [s].
        step: Time step [s]; the last one is shortened to end at ``duration``.

    Returns:
        The motion, one row a step.

    Raises:
        BadInput: Duration or step isn't positive, q doesn't close the loops, or ``torque``
            fails or returns something else than ``(motors,)`` finite numbers.
        Unreachable: A step left the loops too far open to close again.
    """
    model = instance("robot", robot, ClosedRobot, "load()").model
    duration = real("duration", duration, low=_SHORTEST, unit="s")
    step = real("step", step, low=_SHORTEST, unit="s")
    asked = _asked(torque, len(robot.actuators))
    position, rate = vector("q", q, model.nq).copy(), vector("v", v, model.nv)
    dynamics = ForwardDynamics(robot)
    opening = float(np.abs(residual(robot, position)).max(initial=0.0))
    if opening > TOLERANCES.loop_closure:
        raise BadInput(f"the loops are open by {opening:.2e}", remedy="Close them with close()")
    rate = project_rates(robot, dynamics.data, position, rate)
    time = np.append(np.arange(0.0, duration - 1e-9 * step, step), duration)

    def slope(t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        return dynamics(q, v, asked(t, q, v))

    rows = [(position, rate, slope(0.0, position, rate))]
    for now, width in zip(time[:-1], np.diff(time), strict=True):
        half = width / 2
        a = rows[-1][2]
        v_2 = rate + half * a
        a_2 = slope(now + half, pin.integrate(model, position, half * rate), v_2)
        v_3 = rate + half * a_2
        a_3 = slope(now + half, pin.integrate(model, position, half * v_2), v_3)
        v_4 = rate + width * a_3
        a_4 = slope(now + width, pin.integrate(model, position, width * v_3), v_4)
        position = pin.integrate(model, position, width / 6 * (rate + 2 * v_2 + 2 * v_3 + v_4))
        rate = rate + width / 6 * (a + 2 * a_2 + 2 * a_3 + a_4)
        position = newton_close(robot, position, slice(None), 20)
        rate = project_rates(robot, dynamics.data, position, rate)
        rows.append((position, rate, slope(now + width, position, rate)))
    return JointTrajectory(time, *(np.array(column) for column in zip(*rows, strict=True)))


def _asked(
    torque: Callable[[float, np.ndarray, np.ndarray], Any], motors: int
) -> Callable[[float, np.ndarray, np.ndarray], np.ndarray]:
    """The user's torques, with one clear error if they can't be used."""
    function("torque", torque, "torque(t, q, v)")

    def call(t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        try:
            value = torque(t, q.copy(), v.copy())  # what it does to them stays its own
        except ThesisPinError:
            raise
        except Exception as error:
            raise BadInput(
                f"torque(t, q, v) fails: {type(error).__name__}: {error}", where=f"t = {t:g} s"
            ) from error
        return vector(f"what torque(t, q, v) returns at t = {t:g} s", value, motors)

    return call


def _check_motion(
    robot: ClosedRobot,
    data: pin.Data,
    sample: int,
    opening: np.ndarray,
    matrix: np.ndarray,
    q: np.ndarray,
    v: np.ndarray,
    a: np.ndarray,
) -> None:
    bias = constraint_drift(robot, data, q, v)
    scale = [1.0, 1.0 + np.abs(v).max(initial=0.0), 1.0 + np.abs(a).max(initial=0.0)]
    gaps = (opening, matrix @ v, matrix @ a + bias)
    for what, gap, size in zip(("", " rate", " acceleration"), gaps, scale, strict=True):
        worst = float(np.abs(gap).max(initial=0.0))
        limit = TOLERANCES.loop_motion if what else TOLERANCES.loop_closure
        if worst > limit * size:
            raise BadInput(
                f"the motion opens the loops: their opening{what} is {worst:.2e}",
                where=f"sample {sample}",
                allowed=f"{limit * size:.1e}",
                remedy="Make it with loops.close or loops.follow, or pass check=False",
            )


def _solve(
    robot: ClosedRobot, tau: np.ndarray, matrices: np.ndarray
) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, ...]]:
    """Torques, multipliers, and residual, freedom, condition, uniqueness, determinacy."""
    count, equations, nv = matrices.shape
    motors = len(robot.actuators)
    torque, multipliers = np.zeros((count, motors)), np.zeros((count, equations))
    condition, unique = np.ones(count), np.ones(count, dtype=bool)
    _, values, basis = np.linalg.svd(matrices)
    largest = values.max(axis=1, initial=0.0)[:, None]
    rank = (values > TOLERANCES.rank * largest).sum(axis=1)
    for number in np.unique(rank):
        some = rank == number
        motions = basis[some, number:]
        actuation = motions[:, :, robot.actuated]
        left, singular, right = np.linalg.svd(actuation, full_matrices=False)
        if not singular.size:  # a structure: nothing moves, motors only prestress it
            condition[some], unique[some] = np.inf, False
            continue
        strong = singular > TOLERANCES.rank * singular[:, :1]
        with np.errstate(divide="ignore"):
            inverse = np.where(strong, 1.0 / singular, 0.0)
            condition[some] = singular[:, 0] / singular[:, -1]
        load = np.einsum("nij,nj->ni", motions, tau[some])
        torque[some] = np.einsum(
            "nij,nj->ni", np.swapaxes(right, 1, 2), inverse * np.einsum("nij,ni->nj", left, load)
        )
        unique[some] = strong.sum(axis=1) == motors
        if nv - number > motors:
            condition[some] = np.inf
    rest = tau.copy()
    rest[:, robot.actuated] -= torque
    if equations:
        inverse_t = np.linalg.pinv(np.swapaxes(matrices, 1, 2), rcond=TOLERANCES.rank)
        multipliers = np.einsum("nij,nj->ni", inverse_t, rest)
        rest = rest - np.einsum("nij,ni->nj", matrices, multipliers)
    size = np.abs(tau).max(axis=1, initial=0.0)
    unexplained = np.abs(rest).max(axis=1, initial=0.0) / np.where(size > 0, size, 1.0)
    return torque, multipliers, (unexplained, nv - rank, condition, unique, rank == equations)


def _wrenches(
    robot: ClosedRobot, multipliers: np.ndarray, rotations: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Multipliers → force and moment on the first frame's body, world axes."""
    count = len(multipliers)
    force, moment = np.zeros((2, count, len(robot.loops), 3))
    row = 0
    for k, loop in enumerate(robot.loops):
        # The residual grows when the second body moves on, so λ pushes that one.
        force[:, k] = -np.einsum("nij,nj->ni", rotations[:, k], multipliers[:, row : row + 3])
        if loop.size == 6:
            part = multipliers[:, row + 3 : row + 6]
            moment[:, k] = -np.einsum("nij,nj->ni", rotations[:, k], part)
        row += loop.size
    return force, moment
