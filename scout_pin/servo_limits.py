"""How fast a gait may be run before a servo's limit is met."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from scout_pin.dynamics import ContactDynamics, inverse_dynamics, joint_friction, joint_trajectory
from scout_pin.gait import Gait, Motion
from scout_pin.model import Scout
from thesis_pin.trajectory import BodyMotion, JointTrajectory


@dataclass(frozen=True)
class FastestTimeUnit:
    """Smallest time unit [s] each servo limit allows; None if none does.

    Attributes:
        speed: The no-load speed alone.
        torque: The stall torque alone.
        line: The torque-speed line, |τ|/τ_stall + |θ̇|/ω_no-load ≤ 1.
    """

    speed: float
    torque: float | None
    line: float | None


def fastest_time_unit(
    robot: Scout,
    gait: Gait,
    motion: Motion,
    joints: JointTrajectory,
    dynamics: ContactDynamics,
    unit: float,
) -> FastestTimeUnit:
    """Smallest time unit that the servos' limits allow.

    Running the gait s times faster multiplies speeds by s and the part of the
    torques that comes from motion by s²; gravity's part stays. In single support
    the smallest s at which a limit is met is therefore a root of a quadratic. In
    double support the sharing rule isn't quadratic in s, so up to 64 samples of
    it are tried directly, by bisection.
    """
    speed = float(unit * (np.abs(joints.v) / robot.no_load_speed).max())
    still = BodyMotion(
        motion.torso.rotation, motion.torso.position, *(np.zeros((len(joints.q), 3)),) * 4
    )
    at_rest = Motion(
        motion.time, motion.t, motion.support, still, motion.left_foot, motion.right_foot
    )
    zero = np.zeros(joints.q.shape)
    static = inverse_dynamics(robot, at_rest, JointTrajectory(joints.time, joints.q, zero, zero))
    single = ~motion.support.all(axis=1)
    friction = joint_friction(robot, joints.v)
    viscous = robot.specification.assumptions.joint_friction.viscous * joints.v
    constant = (static.torque + friction - viscous)[single]
    square = (dynamics.torque - friction - static.torque)[single]
    linear = viscous[single]
    results = []
    double = gait.t_in_double_support(64)
    for line in (False, True):
        slope = robot.stall_torque / robot.no_load_speed if line else 0.0
        growth = np.abs(joints.v[single]) * slope
        factor = _first_limit(constant, linear, square, growth, robot.stall_torque)
        if double.size and factor > 0:
            factor = _limit_in_double_support(robot, gait, double, unit, line, factor)
        results.append(unit / factor if factor > 0 else None)
    return FastestTimeUnit(speed, results[0], results[1])


def _first_limit(
    constant: np.ndarray, linear: np.ndarray, square: np.ndarray, growth: np.ndarray, limit: Any
) -> float:
    """Smallest s > 0 with |constant + linear s + square s²| + growth s = limit; 0 if at rest."""
    if (np.abs(constant) > limit).any():
        return 0.0
    smallest = np.inf
    for sign in (1.0, -1.0):
        a, b, c = sign * square, sign * linear + growth, sign * constant - limit
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.sqrt(b * b - 4 * a * c)
            # c ≤ 0, so this form of the root that grows from s = 0 never cancels.
            found = -2 * c / (b + root)
        found = np.where(np.isfinite(found) & (found > 0), found, np.inf)
        smallest = min(smallest, float(found.min(initial=np.inf)))
    return smallest


def _limit_in_double_support(
    robot: Scout, gait: Gait, t: np.ndarray, unit: float, line: bool, factor: float
) -> float:
    """The largest speed-up, at most ``factor``, at which double support keeps the limit too."""

    def kept(speed_up: float) -> bool:
        motion = gait.sample(t, unit / speed_up)
        joints = joint_trajectory(robot, motion)
        use = np.abs(inverse_dynamics(robot, motion, joints).torque) / robot.stall_torque
        if line:
            use = use + np.abs(joints.v) / robot.no_load_speed
        return bool((use <= 1.0).all())

    upper = min(factor, 1e3)
    if kept(upper):
        return factor
    lower = 1e-3 * upper
    if not kept(lower):
        return 0.0
    while upper / lower > 1.0 + 1e-4:
        middle = float(np.sqrt(lower * upper))
        lower, upper = (middle, upper) if kept(middle) else (lower, middle)
    return lower
