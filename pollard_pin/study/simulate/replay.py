"""A path's torques on the simulated robot: where its tool goes, what loops and energy do."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.study.simulate.conditions import Conditions, Servo, gains
from pollard_pin.study.simulate.engines import LONGEST, carrier
from pollard_pin.study.simulate.growth import Growth, felt_inertia, growth
from pollard_pin.study.simulate.measures import Log, Replay
from pollard_pin.study.simulate.planned import stretches
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, ModelError, SingularPose, Unreachable
from thesis_pin.numeric.arrays import ascending
from thesis_pin.numeric.workers import silent

MOST_STEPS = 20_000_000
"""Steps of a replay, at most: a quarter of an hour of work."""

_LOOKED_AT = 10.0
"""Places a second at which the growth of errors is worked out, and …"""

_PLACES = (20, 400)
"""… at least and at most."""

_RESOLVED = 0.2
"""Share of the fastest mode's time that a step takes, where it is chosen here."""


@dataclass(frozen=True)
class Prepared(Brief):
    """What a replay is made of: servos, steps, and how errors grow.

    Attributes:
        servo: Gains and limits.
        time_step: Of the engine [s]; the duration is a multiple of it.
        growth: Of errors along the plan.
    """

    servo: Servo
    time_step: float
    growth: Growth


def prepare(report: TrajectoryReport, conditions: Conditions) -> Prepared:
    """Gains, time step and growth of errors.

    Raises:
        BadInput: The time step is too long for the servos, or there are too many steps.
    """
    robot, path = report.robot, report.path
    count = int(np.clip(_LOOKED_AT * path.duration, *_PLACES))
    some = ascending(np.linspace(0, len(report.joints.time) - 1, count).astype(int))
    joints = report.joints.part(some)
    limit, _ = robot.specification.assumptions.joint_limits.of_motors()
    servo = Servo(*gains(conditions, felt_inertia(robot, joints.q[0])), np.zeros(6), limit)
    grown = growth(robot, joints, report.dynamics.torque[some], servo)
    step = conditions.time_step
    if step is None:
        step = min(LONGEST[conditions.engine], _RESOLVED / grown.fastest)
    elif step * grown.fastest > 1:
        raise BadInput(
            f"a time step of {step:g} s is too long for these servos, whose fastest mode takes "
            f"{1 / grown.fastest:.1e} s",
            remedy=f"Take at most {_RESOLVED / grown.fastest:.1e} s, or softer servos",
        )
    if path.duration / step > MOST_STEPS:
        raise BadInput(
            f"{path.duration:g} s in steps of {step:.2g} s are {path.duration / step:.2g} steps",
            allowed=f"at most {MOST_STEPS:,}",
            remedy="Take longer steps, softer servos or a shorter path",
        )
    return Prepared(servo, path.duration / math.ceil(path.duration / step - 1e-9), grown)


def replay(
    report: TrajectoryReport,
    conditions: Conditions,
    prepared: Prepared,
    robot: Pollard | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Replay:
    """Carry the robot along the plan.

    Args:
        report: The plan.
        conditions: What was asked for.
        prepared: See :func:`prepare`.
        robot: The robot that is simulated; None for the plan's.
        progress: Called with the steps done and their total.

    Raises:
        BadInput: The engine isn't installed.
    """
    robot = report.robot if robot is None else robot
    step = prepared.time_step
    total = round(report.path.duration / step)
    log, engine = Log(robot, total, step, prepared.servo), None
    for stretch in stretches(report, step):
        if engine is None:
            engine = carrier(conditions.engine, robot, prepared.servo, step, stretch)
            log.begin(stretch)
        try:
            log.add(stretch, engine.go(stretch))
        except (Unreachable, SingularPose, ModelError) as error:
            log.end = (log.done * step, f"the engine gives up ({error.what})")
        progress(log.done, total)
        if log.end is not None:
            break
    return log.replay()
