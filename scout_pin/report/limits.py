"""How fast a gait may be run before a servo's limit is met."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from scout_pin.dynamics.inverse import inverse_dynamics, joint_friction
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait, GaitMotion
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import TOLERANCES

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
    speed = 0.0
    for part in blocks(len(joints.time)):
        share = np.abs(joints.part(part).v) / robot.no_load_speed
        speed = max(speed, float(unit * share.max()))
    single = np.flatnonzero(~motion.support.all(axis=1))
    double = np.flatnonzero(motion.support.all(axis=1))
    double = double[:: 1 + len(double) // _MOST]
    chosen = (motion.t[double], joints.part(double))
    results = []
    for line, factor in enumerate(_in_single_support(robot, motion, joints, dynamics, single)):
        if double.size and factor > 0:
            factor = _limit_in_double_support(robot, gait, chosen, unit, bool(line), factor)
        results.append(unit / factor if factor > 0 else None)
    return FastestTimeUnit(speed, results[0], results[1])


def _in_single_support(
    robot: Scout,
    motion: GaitMotion,
    joints: JointTrajectory,
    dynamics: ContactDynamics,
    single: np.ndarray,
) -> tuple[float, float]:
    """The largest speed-up on samples of single support by torque alone, and by the line."""
    viscous = robot.specification.assumptions.joint_friction.viscous
    stall, slope = robot.stall_torque, robot.stall_torque / robot.no_load_speed
    torque = line = np.inf
    for part in blocks(len(single)):
        some = single[part]
        moving, at_rest = joints.part(some), motion.at_rest(some)
        zero = np.zeros(moving.q.shape)
        still = JointTrajectory(at_rest.time, moving.q, zero, zero)
        static = inverse_dynamics(robot, at_rest, still).torque
        friction, linear = joint_friction(robot, moving.v), viscous * moving.v
        constant, square = static + friction - linear, dynamics.torque[some] - friction - static
        torque = min(torque, _first_limit(constant, linear, square, zero, stall))
        growth = np.abs(moving.v) * slope
        line = min(line, _first_limit(constant, linear, square, growth, stall))
    return torque, line


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
        while upper / lower > 1.0 + TOLERANCES.time_unit:
            middle = float(np.sqrt(lower * upper))
            kept = (use(active, middle) <= 1.0).all()
            lower, upper = (middle, upper) if kept else (lower, middle)
        upper, share = lower, use(every, lower)
    return upper
