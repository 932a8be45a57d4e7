"""Torques of a gait of any length, a block of samples at a time, in little memory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait, GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.elementwise import BLOCK, blocks
from thesis_pin.numeric.trajectory import JointTrajectory


@dataclass(frozen=True)
class TorqueBlock(Brief):
    """Some consecutive samples of a gait.

    Attributes:
        first: Number of its first sample in the whole.
        motion: Task-space motion.
        joints: Joint trajectory.
        dynamics: Torques and floor wrenches.
    """

    first: int
    motion: GaitMotion
    joints: JointTrajectory
    dynamics: ContactDynamics


def torque_blocks(
    robot: Scout,
    gait: Gait,
    t: np.ndarray,
    *,
    time_unit: float | None = None,
    branch: str | Sequence[str] | None = None,
    size: int = BLOCK,
) -> Iterator[TorqueBlock]:
    """Sample a gait, solve its joints and its torques, block by block.

    The numbers are those of :func:`scout_pin.inverse_dynamics`. A stream can't look
    ahead, though: it begins on the branch that is valid throughout the first block and
    leaves it only where it ends, while the whole at once takes a branch that is valid
    throughout, if there is one. Samples in messages count from the block's first.

    Args:
        robot: The biped, with a free-flyer root.
        gait: The gait.
        t: Times in the gait's unit, in order, shape ``(n,)``; see ``gait.sample_times``.
        time_unit: Seconds in the gait's unit of t; None for the gait's own.
        branch: As in :func:`scout_pin.joint_trajectory`.
        size: Samples a block.

    Yields:
        Blocks in order.

    Raises:
        TrajectoryError, Unreachable, SingularPose: The motion is impossible.
    """
    t, last = finite_array("t", t, None), gait.reference
    for part in blocks(len(t), size):
        motion = gait.sample(t[part], time_unit)
        joints = joint_trajectory(robot, motion, branch=branch, reference=last)
        last = tuple(joints.q[-1])
        yield TorqueBlock(part.start, motion, joints, inverse_dynamics(robot, motion, joints))
