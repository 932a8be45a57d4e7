"""A gait on a robot, in the forms that other programs read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache, partial

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.kinematics.branches import branch_label
from scout_pin.model import Scout
from scout_pin.motion.exact import exact_toml
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.motion.writing import gait_toml, keeps_curves, rows_of, supports
from scout_pin.report.document import GaitReport
from scout_pin.report.judged.stance import branch_asked
from scout_pin.specification import JOINT_NAMES
from thesis_pin.numeric.elementwise import Samples
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.report.exchange.joint_trajectory import JointStates
from thesis_pin.report.exchange.movement import Movement


def gait_movement(
    robot: Scout,
    gait: Gait,
    *,
    samples: int | None = None,
    time_unit: float | None = None,
    branch: str | Sequence[str] | None = None,
) -> Movement:
    """A gait at some times, for :func:`thesis_pin.report.exchange.movement.content`.

    Args:
        robot: The biped.
        gait: The gait.
        samples: Number of evenly spaced times; None takes the samples it was made of, or 401,
            in our own format its curves themselves.
        time_unit: Seconds in the gait's unit of t; None for the gait's own.
        branch: As in :func:`scout_pin.joint_trajectory`.

    Raises:
        TrajectoryError: The gait isn't a motion.
    """
    if time_unit is not None:
        gait = replace(gait, time_unit=time_unit)
    if branch is not None:  # what is written asks for it too
        gait = replace(gait, branch=branch_label(branch))
    t, curves = rows_of(gait, samples), keeps_curves(gait, samples)
    motion = gait.sample(t)

    @cache
    def joints() -> JointTrajectory:
        asked = branch_asked(robot, gait, branch)
        return joint_trajectory(robot, motion, branch=asked, reference=gait.reference)

    def states() -> JointStates:
        torque = inverse_dynamics(robot, motion, joints()).torque
        q = joints()
        return JointStates(JOINT_NAMES, motion.time, q.q, q.v, q.a, torque)

    return Movement(
        motion.time,
        {"support": supports(gait, t)},
        {
            f"{body}_{name}": ("length" if name in "xyz" else "angle", np.asarray(curve(t)))
            for body in BODIES
            for name, curve in zip(POSE_NAMES, gait.curves[body], strict=True)
        },
        JOINT_NAMES,
        lambda: joints().q,
        states,
        (lambda units: exact_toml(gait, units=units)) if curves else partial(gait_toml, gait, t),
        curves,
    )


def report_states(report: GaitReport, keep: Samples) -> JointStates:
    """What the joints do at some samples of a report."""
    q = report.joints.part(keep)
    return JointStates(JOINT_NAMES, q.time, q.q, q.v, q.a, report.dynamics.torque[keep])
