"""How fast an error grows or dies along a path, from the linearised closed mechanism.

Motor angles u are its coordinates: with the loops closed the passive joints follow, and

    ü = f(u, u̇, τ),   d/dt (δu, δu̇) = [[0, 1], [∂f/∂u, ∂f/∂u̇]] (δu, δu̇).

What the servos add is −B (K, C) in the second row, B = ∂f/∂τ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from pollard_pin.model import Pollard
from pollard_pin.study.simulate.conditions import Servo
from thesis_pin.display.brief import Brief
from thesis_pin.loops.dynamics import ForwardDynamics
from thesis_pin.numeric.trajectory import JointTrajectory

_NUDGE = 1e-5
"""Of angles [rad] and rates [rad/s] for central differences: their error is 1e-9 of the rates."""

_ROUNDING = 1e-16
"""What every number of an engine is uncertain by [rad]: half a unit in its last place."""


_LEAST, _MOST = 1e-6, 1e6  # sizes of a growth that is carried on as it is
_DEAD = 1e-300
"""What is left of errors that die within a step between two looks is taken as that much."""

_ARM = 0.5
"""From a joint to the spray tip [m], for what an angle's error makes there."""


@dataclass(frozen=True)
class Growth(Brief):
    """Errors along a path.

    Attributes:
        time: [s], shape ``(n,)``.
        rate: Of the fastest growing error at each time [1/s], shape ``(n,)``; negative where
            all die.
        factor: Natural logarithm of how much the worst error has grown since the start,
            ``(n,)``.
        fastest: Largest size of any mode's rate, which a time step has to resolve [1/s].
    """

    time: np.ndarray
    rate: np.ndarray
    factor: np.ndarray
    fastest: float

    def horizon(self, size: float) -> float | None:
        """When rounding has moved the spray tip by ``size`` [m]: a time [s], None for never."""
        over = self.factor > np.log(size / (_ROUNDING * _ARM))
        return float(self.time[over.argmax()]) if over.any() else None


def felt_inertia(robot: Pollard, q: np.ndarray) -> np.ndarray:
    """Inertia that each motor feels, the others holding still [kg·m²], shape ``(6,)``."""
    response = _response(ForwardDynamics(robot), q, np.zeros(12), np.zeros(6))
    return np.asarray(np.diag(np.linalg.inv(response)))


def growth(robot: Pollard, joints: JointTrajectory, torque: np.ndarray, servo: Servo) -> Growth:
    """How fast errors grow along a motion.

    Args:
        robot: The robot.
        joints: The motion, dense enough that between samples little changes.
        torque: Its motors' torques [N·m], shape ``(n, 6)``.
        servo: What corrects them.
    """
    dynamics, time = ForwardDynamics(robot), joints.time
    systems = [
        _linear(dynamics, q, v, tau, servo)
        for q, v, tau in zip(joints.q, joints.v, torque, strict=True)
    ]
    modes = np.linalg.eigvals(np.array(systems))
    pace = max(float(modes.real.max()), 1.0)  # so that a rate weighs as its angle
    scale = np.concatenate([np.ones(6), np.full(6, 1 / pace)])
    grown, size, factor = np.eye(12), 0.0, [0.0]
    for k, width in enumerate(np.diff(time)):
        middle = (systems[k] + systems[k + 1]) / 2
        grown = expm(middle * width) @ grown
        now = float(np.linalg.norm(scale[:, None] * grown / scale, 2))
        if now < _DEAD:
            now, grown = _DEAD, _DEAD * np.eye(12)
        factor.append(size + float(np.log(now)))
        if not _LEAST < now < _MOST:  # else it would overflow after some hundred e-foldings
            size, grown = size + float(np.log(now)), grown / now
    return Growth(time, modes.real.max(axis=1), np.array(factor), float(np.abs(modes).max()))


def _linear(
    dynamics: ForwardDynamics, q: np.ndarray, v: np.ndarray, torque: np.ndarray, servo: Servo
) -> np.ndarray:
    """Matrix of the linearised motion, shape ``(12, 12)``."""
    motors = list(dynamics.robot.actuated)
    tangent, rate = _tangent(dynamics, q), v[motors]
    found = np.zeros((12, 12))
    found[:6, 6:] = np.eye(6)
    for j in range(6):
        sides = []
        for sign in (1, -1):
            # Off the loops by the square of the nudge, which central differences cancel.
            place = q + sign * _NUDGE * tangent[:, j]
            sides.append(dynamics(place, _tangent(dynamics, place) @ rate, torque)[motors])
        found[6:, j] = (sides[0] - sides[1]) / (2 * _NUDGE)
        sides = [dynamics(q, v + sign * _NUDGE * tangent[:, j], torque)[motors] for sign in (1, -1)]
        found[6:, 6 + j] = (sides[0] - sides[1]) / (2 * _NUDGE)
    if servo.stiffness.any() or servo.damping.any():
        response = _response(dynamics, q, v, torque)
        found[6:, :6] -= response * servo.stiffness
        found[6:, 6:] -= response * servo.damping
    return found


def _tangent(dynamics: ForwardDynamics, q: np.ndarray) -> np.ndarray:
    """Joint rates of each motor's unit rate with the loops closed, shape ``(12, 6)``."""
    robot = dynamics.robot
    matrix = robot.system.jacobian(robot.system.poses(dynamics.data, q[None]))[0]
    passive, motors = np.asarray(robot.passive), list(robot.actuated)
    found = np.zeros((12, 6))
    found[motors] = np.eye(6)
    found[passive] = -np.linalg.solve(matrix[:, passive], matrix[:, motors])
    return found


def _response(
    dynamics: ForwardDynamics, q: np.ndarray, v: np.ndarray, torque: np.ndarray
) -> np.ndarray:
    """Accelerations of the motors of a unit torque on each, shape ``(6, 6)``."""
    motors = list(dynamics.robot.actuated)
    still = dynamics(q, v, torque)[motors]
    columns = [dynamics(q, v, torque + one)[motors] - still for one in np.eye(6)]
    return np.stack(columns, axis=1)
