"""Forward dynamics and simulation of any robot with closed loops.

The accelerations are sought among the motions N that the loops allow,

    v̇ = v̇_b + N (Nᵀ M N)⁻¹ Nᵀ (B τ − h − M v̇_b),   v̇_b = −A⁺ Ȧ v,

with the number of independent equations that the assembly has, so that equations which
differ by a file's rounding don't brake the robot.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, SingularPose, ThesisPinError, Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import is_closed
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.forces.loads import (
    Wrenches,
    checked_wrenches,
    external_forces,
    passive_forces,
)
from thesis_pin.loops.system.gaps import describe_gap
from thesis_pin.loops.system.newton import settle
from thesis_pin.loops.system.rows import POINT, WELD
from thesis_pin.loops.system.survey import Survey
from thesis_pin.numeric.arrays import finite_array, together, vector
from thesis_pin.numeric.checks import function, instance, real
from thesis_pin.numeric.trajectory import JointTrajectory

Array = NDArray[np.float64]

_MOST = 50
"""Proximal iterations of Pinocchio's solver; it takes three where equations are independent."""

_SHORTEST = 1e-9
"""Least duration and step of a simulation [s]."""


def forward_dynamics(
    robot: ClosedRobot,
    q: ArrayLike,
    v: ArrayLike,
    torque: ArrayLike,
    *,
    external: Wrenches | None = None,
    precision: float | None = None,
) -> Array:
    """Joint accelerations of the closed robot under motor torques, shape ``(..., nv)``.

    The loops' own drift isn't corrected here, see :func:`simulate`.

    Args:
        robot: The robot.
        q: Closed configurations, shape ``(..., nq)``.
        v: Rates that keep the loops closed, shape ``(..., nv)``.
        torque: Of the motors, shape ``(..., motors)``.
        external: Frame → wrench on it from outside, as for
            :func:`thesis_pin.loops.dynamics.inverse_dynamics`.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Raises:
        SingularPose: The loops lose an equation at a pose.
        Unreachable, ModelError: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
    """
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    q, v, torque = together(
        q=finite_array("q", q, model.nq),
        v=finite_array("v", v, model.nv),
        torque=finite_array("torque", torque, len(robot.actuators)),
    )
    stack = q.shape[:-1]
    if not q.size:
        raise BadInput("the stack is empty", allowed="at least one sample")
    wrenches = checked_wrenches(robot, external, stack)
    q, v, torque = (x.reshape(-1, x.shape[-1]) for x in (q, v, torque))
    dynamics = ForwardDynamics(robot, precision=precision)
    pushed = np.zeros_like(v)
    if wrenches:
        poses = robot.system.poses(dynamics.data, q)
        pushed = external_forces(robot, dynamics.data, poses, wrenches)
    rows = [dynamics(*sample) for sample in zip(q, v, torque, pushed, strict=True)]
    return np.stack(rows).reshape(*stack, model.nv)


class ForwardDynamics(Brief):
    """Accelerations of single states, with Pinocchio's data kept between calls.

    Args:
        robot: The robot.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
    """

    def __init__(self, robot: ClosedRobot, *, precision: float | None = None) -> None:
        self.robot, self.precision = robot, precision
        self.data = robot.model.createData()
        anchors = all(loop.rows in (POINT, WELD) and loop.length is None for loop in robot.loops)
        self._simple = anchors and not robot.couplings and not robot.model.armature.any()
        if self._simple:
            self._models = robot.rigid_constraint_models()
            self._datas = pin.StdVec_RigidConstraintData()
            for model in self._models:
                self._datas.append(model.createData())
            self._settings = pin.ProximalSettings(1e-14, 1e-8, _MOST)
            pin.initConstraintDynamics(robot.model, self.data, self._models, self._datas)

    def _shown(self) -> Iterator[tuple[str, object]]:
        yield from (("robot", self.robot), ("precision", self.precision))

    def __reduce__(self) -> tuple[object, ...]:
        """Pinocchio's data can't travel; it is made again of the robot."""
        return partial(ForwardDynamics, precision=self.precision), (self.robot,)

    def __call__(self, q: Array, v: Array, torque: Array, pushed: Array | None = None) -> Array:
        """Accelerations ``(nv,)`` of one state.

        Args:
            q: Closed configuration, shape ``(nq,)``.
            v: Rates, shape ``(nv,)``.
            torque: Of the motors, shape ``(motors,)``.
            pushed: Generalized forces from outside, shape ``(nv,)``.
        """
        robot, model, data = self.robot, self.robot.model, self.data
        tau = -passive_forces(robot, q[None], v[None])[0]
        tau[robot.actuated] += torque
        if pushed is not None:
            tau += pushed
        # Where every equation is real Pinocchio's own is as right and faster; where it doesn't
        # converge the pose is singular, and looked at more closely below.
        if self._simple and surveyed(robot, q, self.precision).rank == robot.equations:
            constraints = self._models, self._datas, self._settings
            found = pin.constraintDynamics(model, data, q, v, tau, *constraints)
            if self._settings.iter < _MOST:
                return np.array(found)
        allowed, opened, mass = self._reduced(q, v)
        tau -= pin.nonLinearEffects(model, data, q, v)
        return np.asarray(opened + self._along(allowed, mass, tau - mass @ opened))

    def projected(self, q: Array, v: Array) -> Array:
        """Nearest rates, by kinetic energy, that keep the loops closed, ``(nv,)``."""
        allowed, _, mass = self._reduced(q, np.zeros_like(v))
        return self._along(allowed, mass, mass @ v)

    def _along(self, allowed: Array, mass: Array, force: Array) -> Array:
        """What a force makes of the motions ``(nv, freedom)`` that are allowed."""
        return np.asarray(allowed @ np.linalg.solve(allowed.T @ mass @ allowed, allowed.T @ force))

    def _reduced(self, q: Array, v: Array) -> tuple[Array, Array, Array]:
        """Allowed motions, the acceleration that keeps the loops closed, and the mass matrix."""
        robot, scale, data = self.robot, self.robot.scale, self.data
        survey = surveyed(robot, q, self.precision)
        if survey.freedom and not survey.moves:
            raise SingularPose("the robot moves only infinitesimally: no acceleration is its own")
        poses = robot.system.poses(data, q[None], v[None])
        matrix = scale.rows[:, None] * robot.system.jacobian(poses)[0] * scale.columns
        parts = robot.system.parts()
        left, values, right = parts.svd(matrix)
        rank = survey.rank
        next_one = values[rank] if rank < len(values) else 0.0
        if rank and values[rank - 1] < 10 * max(survey.noise, next_one):
            raise SingularPose(
                f"the loops lose an equation: its weight is {values[rank - 1]:.1e} rad",
                remedy="Keep away from this pose",
            )
        known = left[:, :rank].T @ (scale.rows * robot.system.drift(poses, v[None])[0])
        opened = -scale.columns * (right[:rank].T @ (known / values[:rank]))
        allowed = scale.columns[:, None] * parts.complement(right[:rank])
        mass = pin.crba(robot.model, data, q)
        return allowed, opened, np.triu(mass) + np.triu(mass, 1).T


def simulate(
    robot: ClosedRobot,
    q: ArrayLike,
    v: ArrayLike,
    torque: Callable[[float, np.ndarray, np.ndarray], np.ndarray],
    duration: float,
    step: float = 1e-3,
    *,
    precision: float | None = None,
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
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Returns:
        The motion, one row a step.

    Raises:
        BadInput: Duration or step isn't positive, q doesn't close the loops, or ``torque``
            fails or returns something else than ``(motors,)`` finite numbers.
        Unreachable: A step left the loops too far open to close again.
        SingularPose: The motion ran into a pose where the loops lose an equation.
    """
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    duration = real("duration", duration, low=_SHORTEST, unit="s")
    step = real("step", step, low=_SHORTEST, unit="s")
    asked = _asked(torque, len(robot.actuators))
    position, rate = vector("q", q, model.nq).copy(), vector("v", v, model.nv)
    dynamics = ForwardDynamics(robot, precision=precision)
    survey = _closed_survey(robot, position, precision)
    rate = dynamics.projected(position, rate)
    time = np.append(np.arange(0.0, duration - 1e-9 * step, step), duration)

    def slope(t: float, q: Array, v: Array) -> Array:
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
        position = _closed_again(dynamics, survey, position, now + width)
        rate = dynamics.projected(position, rate)
        rows.append((position, rate, slope(now + width, position, rate)))
    return JointTrajectory(time, *(np.array(column) for column in zip(*rows, strict=True)))


def _closed_survey(robot: ClosedRobot, q: Array, precision: float | None) -> Survey:
    """The assembly of a configuration, which must be closed."""
    gap = robot.system.gap(robot.system.poses(robot.data, q[None]))[0]
    open_by = f"the loops are open: {describe_gap(robot.system, gap)}"
    refusal = BadInput(open_by, remedy="Close them with close()")
    try:
        survey = surveyed(robot, q, precision)
    except Unreachable:
        raise refusal from None
    if not is_closed(robot, survey, gap):
        raise refusal
    return survey


def _closed_again(dynamics: ForwardDynamics, survey: Survey, q: Array, time: float) -> Array:
    robot, every = dynamics.robot, np.arange(dynamics.robot.model.nv, dtype=np.intp)
    found = settle(robot.system, robot.scale, dynamics.data, q[None], every, survey.cut, 20).one(0)
    if not is_closed(robot, survey, found.gap):
        raise Unreachable(
            f"a step left the loops open: {describe_gap(robot.system, found.gap)}",
            where=f"t = {time:g} s",
            remedy="Take shorter steps",
        )
    return found.q


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
