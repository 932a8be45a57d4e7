"""What servos are sent along a gait, at their rate: planned angles, and commands that are ahead."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scout_pin.dynamics.inverse import inverse_dynamics, walking
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.motion.writing import supports
from scout_pin.report.judged.stance import branch_asked
from scout_pin.specification import JOINT_NAMES
from scout_pin.study.servo import ServoGains, sag_compensated
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import instance, real
from thesis_pin.report.writers import csv_bytes
from thesis_pin.tables.writing import WrittenUnits, heading, texts

RATE = 50.0
"""How often a hobby servo is told where to go [Hz]: a pulse every 20 ms."""

RATES = (1.0, 1e4)
"""Least and greatest rate of a table [Hz]: hobby servos are told 50 to 333 times a second, the
drives of industrial robots up to 8 000 times."""


def servo_tables(
    robot: Scout, gait: Gait, rate: float = RATE, gains: ServoGains | None = None
) -> dict[str, bytes]:
    """Tables of joint angles at a servo's rate, in SI; the first is read as a gait.

    Args:
        robot: The biped.
        gait: The gait; where it ends between two instants of the rate, its last pose is held.
        rate: How often the servos are told [Hz].
        gains: How they give way; None takes the usual.

    Returns:
        ``joints.csv`` with the angles as planned, and ``commands.csv`` with those that make
        servos follow them, see :func:`scout_pin.study.servo.sag_compensated`.

    Raises:
        BadInput: No servo is told that often, or it makes more rows than a table may have.
    """
    walking(robot)
    instance("gait", gait, Gait, "scout_pin.plan_gait()")
    rate = servo_rate("the servos' rate", rate)
    last = (gait.end - gait.start) * gait.time_unit
    count = int(np.ceil(last * rate * (1.0 - 1e-12))) + 1
    if count > LIMITS.rows:
        raise BadInput(
            f"{rate:g} Hz make {count:,} rows of {last:g} s",
            allowed=f"at most {LIMITS.rows:,}",
            remedy="Take a lower rate or fewer steps",
        )
    time = np.arange(count) / rate
    t = np.minimum(gait.start + time / gait.time_unit, gait.end)
    motion = gait.sample(t)
    asked = branch_asked(robot, gait, None)
    joints = joint_trajectory(robot, motion, branch=asked, reference=gait.reference)
    torque = inverse_dynamics(robot, motion, joints).torque
    commands = sag_compensated(joints.q, joints.v, joints.a, torque, gains or ServoGains())
    units = WrittenUnits()
    first: dict[str, Sequence[str]] = {
        heading("t", units.time): texts(time, units.time),
        "support": supports(gait, t),
    }
    return {
        name: csv_bytes(
            first
            | {
                heading(joint, units.angle): texts(angles[:, k], units.angle)
                for k, joint in enumerate(JOINT_NAMES)
            }
        )
        for name, angles in (("joints.csv", joints.q), ("commands.csv", commands))
    }


def servo_rate(name: str, rate: float) -> float:
    """A rate at which servos can be told where to go [Hz].

    Raises:
        BadInput: It is outside :data:`RATES`.
    """
    if (found := real(name, rate)) < RATES[0] or found > RATES[1]:
        raise BadInput(
            f"{name} is {rate:g} Hz",
            allowed=f"{RATES[0]:g} to {RATES[1]:g} Hz",
            remedy="Hobby servos take 50 to 333 Hz, industrial drives up to 8000 Hz",
        )
    return found
