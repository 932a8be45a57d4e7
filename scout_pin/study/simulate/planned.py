"""What servos are commanded at every step of the engine, and what is expected of the robot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.motion.gait import GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.report.document import GaitReport
from scout_pin.specification import SIDES
from scout_pin.study.servo import sag_compensated
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.world import rotors, time_step
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import JointTrajectory

SETTLING = 0.5
"""Time [s] that a robot stands before it begins, and after it has ended, at rest."""

MOST_STEPS = 2_000_000
"""Of the engine, for a gait: their commands take half a gigabyte."""

RECORDED = 1e-3
"""Time [s] between recorded instants, or the engine's step if that is longer."""

_FIRST = slice(0, 1)


@dataclass(frozen=True)
class Planned(Brief):
    """A gait as the engine is to be driven, and as it would go if all went to plan.

    Attributes:
        commands: Angles [rad] commanded at each step, standing before and after included,
            ``(steps, 12)``.
        before, after: Of these, steps at rest before it begins and after it has ended.
        step: Time step of the engine [s].
        every: Steps from one recorded instant to the next.
        time: Recorded instants [s], 0 where it begins, ``(n,)``.
        q, v: What is planned then, as Pinocchio counts, ``(n, 19)`` and ``(n, 18)``.
        feet: Planned places of both soles, left then right, ``(2, n, 3)``.
        low: Planned height of each sole's lowest corner [m], ``(2, n)``.
        torque: Planned torques [N·m], ``(n, 12)``.
        line: Largest share of each servo's torque-speed line that the plan takes, its rotor
            counted, ``(12,)``.
        duration: How long the gait takes [s].
        stances: Of each foot, planned times [s] from landing to lift-off.
    """

    commands: np.ndarray
    before: int
    after: int
    step: float
    every: int
    time: np.ndarray
    q: np.ndarray
    v: np.ndarray
    feet: np.ndarray
    low: np.ndarray
    torque: np.ndarray
    line: np.ndarray
    duration: float
    stances: tuple[tuple[tuple[float, float], ...], ...]


def planned(report: GaitReport, conditions: Conditions) -> Planned:
    """What servos are commanded so that a gait is walked.

    Args:
        report: On the gait, by :func:`scout_pin.gait_report`.
        conditions: The engine's time step, the servos, whether their sag is made up for.

    Raises:
        BadInput: There would be too many steps.
    """
    robot, gait, unit = report.robot, report.gait, report.time_unit
    first = free_flyer_state(report.motion.torso.part(_FIRST), report.joints.part(_FIRST))[0]
    step = time_step(robot, conditions, first[0])
    seconds = (gait.end - gait.start) * unit
    steps = int(np.ceil(seconds / step - 1e-6))
    if steps > MOST_STEPS:
        raise BadInput(
            f"{seconds:g} s in steps of {step:g} s are {steps:,} steps",
            where=f"gait {gait.name!r}",
            allowed=f"at most {MOST_STEPS:,}",
            remedy="Take a longer time step, or a shorter gait",
        )
    t = np.minimum(gait.start + np.arange(steps + 1) * step / unit, gait.end)
    motion = gait.sample(t, unit)
    joints = joint_trajectory(robot, motion, branch=report.branch, reference=gait.reference)
    commands, torque = np.empty((steps + 1, 12)), np.empty((steps + 1, 12))
    line, rotor = np.zeros(12), rotors(robot, conditions) - robot.specification.armature()
    for part in blocks(steps + 1):
        some = joints.part(part)
        torque[part] = inverse_dynamics(robot, motion.part(part), some).torque
        commands[part] = _commands(report, conditions, some, torque[part])
        given = torque[part] + rotor * some.a
        # Against its turning a servo gives at any speed what it gives at rest.
        ahead = np.maximum(np.sign(given) * some.v, 0.0) / robot.no_load_speed
        line = np.maximum(line, (np.abs(given) / robot.stall_torque + ahead).max(axis=0))
    before = _count(step) if report.ends.start.rests else 0
    after = _count(step) if report.ends.end.rests else 0
    stands = [_standing(report, conditions, motion, joints, k) for k in (0, steps)]
    every = max(1, round(RECORDED / step))
    index = np.clip(np.arange(-before, steps + after + 1)[::every], 0, steps)
    here, mine = motion.part(index), joints.part(index)
    q, v, _ = free_flyer_state(here.torso, mine)
    v[(index == 0) & (before > 0)] = 0.0
    v[(index == steps) & (after > 0)] = 0.0
    feet = (here.left_foot, here.right_foot)
    corners = [
        robot.sole_vertices(side, foot.placement)[..., 2].min(axis=-1)
        for side, foot in zip(SIDES, feet, strict=True)
    ]
    return Planned(
        np.concatenate(
            [
                np.broadcast_to(stands[0], (before, 12)),
                commands[:-1],
                np.broadcast_to(stands[1], (after, 12)),
            ]
        ),
        before,
        after,
        step,
        every,
        np.arange(-before, steps + after + 1)[::every] * step,
        q,
        v,
        np.stack([foot.position for foot in feet]),
        np.stack(corners),
        torque[index],
        line,
        seconds,
        tuple(tuple(_stances(report, side)) for side in SIDES),
    )


def _count(step: float) -> int:
    return round(SETTLING / step)


def _commands(
    report: GaitReport, conditions: Conditions, joints: JointTrajectory, torque: np.ndarray
) -> np.ndarray:
    """Angles to command [rad], ``(n, 12)``."""
    if not conditions.sag_compensation:
        return np.array(joints.q)
    armature = rotors(report.robot, conditions) - report.robot.specification.armature()
    return sag_compensated(
        joints.q, joints.v, joints.a, torque, conditions.gains, armature=armature
    )


def _standing(
    report: GaitReport,
    conditions: Conditions,
    motion: GaitMotion,
    joints: JointTrajectory,
    sample: int,
) -> np.ndarray:
    """Angles to command for the pose of a sample to be held [rad], ``(12,)``."""
    one = slice(sample, sample + 1)
    still, some = motion.at_rest(one), joints.part(one)
    rest = JointTrajectory(some.time, some.q, np.zeros((1, 12)), np.zeros((1, 12)))
    torque = inverse_dynamics(report.robot, still, rest).torque
    return np.asarray(_commands(report, conditions, rest, torque)[0])


def _stances(report: GaitReport, side: str) -> list[tuple[float, float]]:
    """Planned times [s] from each landing of a foot to its lift-off, from the gait's start."""
    gait, unit = report.gait, report.time_unit
    found: list[tuple[float, float]] = []
    for phase in gait.phases:
        if phase.support not in (side, "double") or phase.end <= phase.start:
            continue
        start, end = ((one - gait.start) * unit for one in (phase.start, phase.end))
        if found and start <= found[-1][1]:
            found[-1] = (found[-1][0], end)
        else:
            found.append((start, end))
    return found
