"""Task motion → joint motion of the biped."""

from __future__ import annotations

import numpy as np

from scout_pin.kinematics.rates import leg_rates
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.trajectory import JointTrajectory

_LEGS = (slice(0, 6), slice(6, 12))  # each leg's joints, in the order of SIDES


def joint_trajectory(
    robot: Scout, motion: GaitMotion, reference: np.ndarray | None = None
) -> JointTrajectory:
    """Inverse kinematics of a whole motion, rates and accelerations included.

    Args:
        robot: The biped.
        motion: The sampled gait.
        reference: Angles [rad] the first sample is to be near, ``(12,)``; None for zero.

    Raises:
        Unreachable: Some pose has no valid branch.
        SingularPose: A leg's Jacobian loses rank on the way.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    instance("motion", motion, GaitMotion, "Gait.sample()")
    q = robot.follow(motion.torso, motion.left_foot, motion.right_foot, reference)
    feet = (motion.left_foot, motion.right_foot)
    v, a = np.empty(q.shape), np.empty(q.shape)
    for side, foot, mine in zip(SIDES, feet, _LEGS, strict=True):
        v[:, mine], a[:, mine] = leg_rates(robot.legs[side], q[:, mine], foot, motion.torso)
    return JointTrajectory(motion.time, q, v, a)
