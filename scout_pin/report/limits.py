"""How fast a gait may be run before a servo's limit is met."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from scout_pin.dynamics.inverse import inverse_dynamics, joint_friction
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait, GaitMotion
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.numeric.trajectory import JointTrajectory

_TRIED = 32  # samples of double support added at a time to those it is bisected on
_MOST = 2048  # samples of double support among which they are chosen


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
    motion: GaitMotion,
    joints: JointTrajectory,
    dynamics: ContactDynamics,
    unit: float,
) -> FastestTimeUnit:
    """Smallest time unit that the servos' limits allow.

    Running the gait s times faster multiplies speeds by s and the part of the
    torques that comes from motion by s²; gravity's part stays. In single support
    the smallest s at which a limit is met is therefore a root of a quadratic. In
    double support the sharing rule isn't quadratic in s: at the speed that single
    support allows, the samples that ask most are found, and s is bisected on them.
    """
    speed = float(unit * (np.abs(joints.v) / robot.no_load_speed).max())
    single = np.flatnonzero(~motion.support.all(axis=1))
    at_rest = motion.at_rest(single)
    zero = np.zeros(joints.q[single].shape)
    static = inverse_dynamics(
        robot, at_rest, JointTrajectory(at_rest.time, joints.q[single], zero, zero)
    )
    friction = joint_friction(robot, joints.v[single])
    linear = robot.specification.assumptions.joint_friction.viscous * joints.v[single]
    constant = static.torque + friction - linear
    square = dynamics.torque[single] - friction - static.torque
    double = np.flatnonzero(motion.support.all(axis=1))
    double = double[:: 1 + len(double) // _MOST]
    chosen = (
        motion.t[double],
        JointTrajectory(joints.time[double], joints.q[double], joints.v[double], joints.a[double]),
    )
    results = []
    for line in (False, True):
        slope = robot.stall_torque / robot.no_load_speed if line else 0.0
        growth = np.abs(joints.v[single]) * slope
        factor = _first_limit(constant, linear, square, growth, robot.stall_torque)
        if double.size and factor > 0:
            factor = _limit_in_double_support(robot, gait, chosen, unit, line, factor)
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
    robot: Scout,
    gait: Gait,
    chosen: tuple[np.ndarray, JointTrajectory],
    unit: float,
    line: bool,
    factor: float,
) -> float:
    """The largest speed-up, at most ``factor``, at which double support keeps the limit too."""
    t, joints = chosen

    def use(some: np.ndarray, s: float) -> np.ndarray:
        motion = gait.sample(t[some], unit / s)
        # Run s times faster the joints pass the same angles, on the same branch.
        q, v, a = joints.q[some], joints.v[some] * s, joints.a[some] * s**2
        faster = JointTrajectory(motion.time, q, v, a)
        share = np.abs(inverse_dynamics(robot, motion, faster).torque) / robot.stall_torque
        if line:
            share = share + np.abs(v) / robot.no_load_speed
        return np.asarray(share.max(axis=1))

    upper = min(factor, 1e3)
    every = np.ones(len(t), dtype=bool)
    active = ~every
    share = use(every, upper)
    if (share <= 1.0).all():
        return factor
    # Samples that ask most at one speed need not at another: bisect on those known
    # to matter, and go on while some other sample breaks the limit found.
    while (share > 1.0).any():
        active[np.argsort(share)[-_TRIED:]] = True
        lower = 1e-3 * upper
        if (use(active, lower) > 1.0).any():
            return 0.0
        while upper / lower > 1.0 + 1e-5:
            middle = float(np.sqrt(lower * upper))
            kept = (use(active, middle) <= 1.0).all()
            lower, upper = (middle, upper) if kept else (lower, middle)
        upper, share = lower, use(every, lower)
    return upper
