"""Tool motion → joint motion, with everything that can go wrong on the way named."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, one_branch
from pollard_pin.kinematics.rates import motion_rates
from pollard_pin.kinematics.screws import Posture
from pollard_pin.kinematics.solutions import Solutions
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion, ToolPath
from pollard_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import TOLERANCES

_JUMP = 1.0  # rad between two samples that only a break of the branch explains …
_UNFORESEEN = 0.5  # … if the rates on both sides foretell less than this of it


@dataclass(frozen=True)
class SolvedTrajectory(JointTrajectory):
    """Joint positions, rates and accelerations over time, and how they were found.

    Attributes:
        time: Sample times [s], shape ``(n,)``.
        q: Joint angles [rad], without jumps of a whole turn, shape ``(n, 12)``.
        v: Joint rates [rad/s], shape ``(n, 12)``.
        a: Joint accelerations [rad/s²], shape ``(n, 12)``.
        solutions: Margins, residuals and posture of each sample.
    """

    solutions: Solutions


def joint_trajectory(
    robot: Pollard,
    motion: ToolMotion,
    *,
    branch: Branch | None = None,
    reference: ArrayLike | None = None,
) -> SolvedTrajectory:
    """Inverse kinematics of a whole motion, rates and accelerations included.

    Args:
        robot: The robot.
        motion: The sampled path.
        branch: Which solution; it is kept all along. None for the default branch.
        reference: Angles [rad] whose whole turns the first sample takes, ``(12,)``;
            None for angles in (−π, π].

    Raises:
        Unreachable: A pose can't be reached, or an angle leaves its limits.
        SingularPose: A sample is singular, or the path crosses a serial singularity.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    instance("motion", motion, ToolMotion, "ToolPath.sample()")
    branch = DEFAULT_BRANCH if branch is None else one_branch(branch)
    path = motion.path
    solution, v, a = _solve(robot, motion, branch)
    q, changes = _unwrapped(solution.angles)
    if reference is not None:
        turns = np.rint((vector("reference", reference, 12) - q[0]) / (2 * np.pi))
        q = q + 2 * np.pi * turns if turns.any() else q
    for k, joint, change in _suspicious(motion.time, changes, v):
        if path is None or _breaks(robot, path, motion.time[k : k + 2], branch):
            raise SingularPose(
                f"the path crosses a serial singularity: {JOINT_NAMES[joint]} "
                f"({JOINT_SYMBOLS[joint]}) jumps by {np.degrees(change):.0f}°",
                where=f"between t = {motion.time[k]:.6g} and {motion.time[k + 1]:.6g} s",
                remedy="Move the path, turn the tool or choose another branch"
                + ("" if path else "; if the samples are far apart, take more of them"),
            )
    _check_limits(robot, motion.time, q)
    return SolvedTrajectory(motion.time, q, v, a, solution)


def _solve(
    robot: Pollard, motion: ToolMotion, branch: Branch
) -> tuple[Solutions, np.ndarray, np.ndarray]:
    """Angles in (−π, π], rates and accelerations at the samples."""
    solution = robot.inverse_kinematics(motion.pose, branch).require("path sample", motion.time)
    v, a = np.empty(solution.angles.shape), np.empty(solution.angles.shape)
    for part in blocks(len(motion.time)):
        some = motion.part(part)
        posture = Posture.of(robot.geometry, solution.angles[part])
        v[part], a[part] = motion_rates(
            posture, some.pose, some.rate, some.acceleration, some.time, first=part.start
        )
    return solution, v, a


def _unwrapped(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles without jumps of a whole turn, and their changes from sample to sample."""
    changes = np.diff(q, axis=0)
    turns = np.rint(changes / (2 * np.pi))
    if turns.any():
        changes = changes - 2 * np.pi * turns
        q = q.copy()
        q[1:] -= 2 * np.pi * np.cumsum(turns, axis=0)
    return q, changes


def _suspicious(
    time: np.ndarray, changes: np.ndarray, v: np.ndarray
) -> list[tuple[int, int, float]]:
    """Sample, joint and change [rad] wherever an angle changes much more than its rate says."""
    found = []
    for k, joint in np.argwhere(np.abs(changes) > _JUMP):
        foreseen = (time[k + 1] - time[k]) * (v[k + 1, joint] + v[k, joint]) / 2
        if abs(changes[k, joint] - foreseen) > _UNFORESEEN:
            found.append((int(k), int(joint), float(changes[k, joint])))
    return found


def _breaks(robot: Pollard, path: ToolPath, ends: np.ndarray, branch: Branch) -> bool:
    """Whether the branch breaks between two samples, looked at 300 times as closely."""
    motion = path.at(np.linspace(ends[0], ends[1], 301))
    solution, v, _ = _solve(robot, motion, branch)
    return bool(_suspicious(motion.time, _unwrapped(solution.angles)[1], v))


def _check_limits(robot: Pollard, time: np.ndarray, q: np.ndarray) -> None:
    beyond = np.maximum(robot.lower - q, q - robot.upper)
    if (beyond > TOLERANCES.joint_limit).any():
        k, joint = (int(i) for i in np.argwhere(beyond > TOLERANCES.joint_limit)[0])
        low, high = np.degrees([robot.lower[joint], robot.upper[joint]])
        raise Unreachable(
            f"{JOINT_NAMES[joint]} ({JOINT_SYMBOLS[joint]}) leaves its limits: "
            f"{np.degrees(q[k, joint]):.2f}°, outside {low:g}° to {high:g}°",
            where=f"t = {time[k]:.6g} s",
            remedy="Move the path, or start it nearer to the middle of the joint's range",
        )
