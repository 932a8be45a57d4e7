"""Task motion → joint motion of the biped."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.kinematics.rates import leg_rates
from scout_pin.kinematics.screws import LegScrews
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import LONG, Samples, blocks
from thesis_pin.numeric.long import LongTrajectory
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory

_LEGS = (slice(0, 6), slice(6, 12))  # each leg's joints, in the order of SIDES


def joint_trajectory(
    robot: Scout,
    motion: GaitMotion,
    *,
    branch: str | Sequence[str] | None = None,
    reference: ArrayLike | None = None,
) -> JointTrajectory:
    """Inverse kinematics of a whole motion, rates and accelerations included.

    Args:
        robot: The biped.
        motion: The sampled gait.
        branch: Signs of the branch to take, for both legs or one label a leg, as
            ``"+-+"`` or ``("+++", "-+-")``; None takes the nearest to the reference of
            those that are valid throughout.
        reference: Angles [rad] the first sample is to be near, ``(12,)``; None for zero.

    Raises:
        Unreachable: Some pose has no valid branch.
        SingularPose: A leg's Jacobian loses rank on the way.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    instance("motion", motion, GaitMotion, "Gait.sample()")
    start = None if reference is None else vector("reference", reference, 12)
    q = robot.follow(motion.torso, motion.left_foot, motion.right_foot, start, branch=branch)
    if len(q) < LONG:
        return JointTrajectory(motion.time, q, *_rates(robot, motion, q))
    for side, mine in zip(SIDES, _LEGS, strict=True):
        for part in blocks(len(q)):
            if _rests(motion.part(part), side):
                continue
            LegScrews(robot.legs[side], q[part, mine]).refuse_singular(part.start)
    return LongTrajectory(motion.time, q, partial(_rates, robot, motion, q))


def _rates(
    robot: Scout, motion: GaitMotion, q: np.ndarray, samples: Samples = slice(None)
) -> tuple[np.ndarray, np.ndarray]:
    """Joint rates and accelerations at some samples, each ``(m, 12)``."""
    motion, q = motion.part(samples), q[samples]
    v, a = np.zeros(q.shape), np.zeros(q.shape)
    for side, mine in zip(SIDES, _LEGS, strict=True):
        if not _rests(motion, side):
            foot = _foot(motion, side)
            v[:, mine], a[:, mine] = leg_rates(robot.legs[side], q[:, mine], foot, motion.torso)
    return v, a


def _foot(motion: GaitMotion, side: str) -> BodyMotion:
    return motion.left_foot if side == "left" else motion.right_foot


def _rests(motion: GaitMotion, side: str) -> bool:
    """Whether torso and a foot rest throughout: so do the joints, at singular poses too."""
    return not any(
        rate.any()
        for body in (motion.torso, _foot(motion, side))
        for rate in (body.velocity, body.acceleration, body.omega, body.alpha)
    )
