"""Torques of a path of any length, a block of samples at a time, in little memory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.dynamics.inverse import PollardDynamics, inverse_dynamics
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion, ToolPath
from pollard_pin.motion.trajectory import check_steps, joint_trajectory
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.arrays import finite_array, vector
from thesis_pin.numeric.elementwise import BLOCK, blocks
from thesis_pin.numeric.trajectory import JointTrajectory


@dataclass(frozen=True)
class TorqueBlock(Brief):
    """Some consecutive samples of a path.

    Attributes:
        first: Number of its first sample in the whole.
        motion: Tool motion.
        joints: Joint trajectory.
        dynamics: Torques and ball-joint forces.
    """

    first: int
    motion: ToolMotion
    joints: JointTrajectory
    dynamics: PollardDynamics


def torque_blocks(
    robot: Pollard,
    path: ToolPath,
    time: np.ndarray,
    *,
    branch: Branch | None = None,
    reference: ArrayLike | None = None,
    size: int = BLOCK,
) -> Iterator[TorqueBlock]:
    """Sample a path, solve its joints and its torques, block by block.

    The numbers are those of :func:`pollard_pin.inverse_dynamics` on the whole. Singularities
    of the actuation aren't looked for; the report does that. A joint that fits its limits only
    if it starts a turn back has to be told so: nobody knows here what comes later.

    Args:
        robot: The robot.
        path: The path of the spray tip.
        time: Sample times in order [s], shape ``(n,)``.
        branch: Which solution; None for the default branch.
        reference: Angles [rad] whose whole turns the first sample takes, ``(12,)``; None for
            those that fit the first block.
        size: Samples a block.

    Yields:
        Blocks in order.

    Raises:
        Unreachable, SingularPose, TrajectoryError: The motion is impossible.
    """
    time = finite_array("time", time, None)
    start = None if reference is None else vector("reference", reference, 12)
    branch = DEFAULT_BRANCH if branch is None else branch
    last: JointTrajectory | None = None
    for part in blocks(len(time), size):
        motion = path.at(time[part])
        joints = joint_trajectory(robot, motion, branch=branch, reference=start)
        if last is not None:  # so that no jump hides between two blocks
            check_steps(robot, path, branch, _joined(last, joints.part(slice(0, 1))))
        last, start = joints.part(slice(-1, None)), joints.q[-1]
        yield TorqueBlock(part.start, motion, joints, inverse_dynamics(robot, motion, joints))


def _joined(one: JointTrajectory, other: JointTrajectory) -> JointTrajectory:
    pairs = ((getattr(one, name), getattr(other, name)) for name in ("time", "q", "v", "a"))
    return JointTrajectory(*(np.concatenate(pair) for pair in pairs))
