"""Tool motion → joint motion, with everything that can go wrong on the way named."""

from __future__ import annotations

import numpy as np

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch
from pollard_pin.kinematics.rates import (
    check_regular,
    joint_accelerations,
    joint_rates,
    tool_acceleration,
    tool_twist,
)
from pollard_pin.kinematics.screws import Posture
from pollard_pin.kinematics.solutions import Solutions
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion, ToolPath
from pollard_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.numeric.vectors import rows
from thesis_pin.tolerances import TOLERANCES

_JUMP = 1.0  # rad between two samples that only a break of the branch explains …
_UNFORESEEN = 0.5  # … if the rates on both sides foretell less than this of it


def joint_trajectory(
    robot: Pollard,
    motion: ToolMotion,
    branch: Branch = DEFAULT_BRANCH,
    path: ToolPath | None = None,
    start: np.ndarray | None = None,
) -> tuple[JointTrajectory, Solutions]:
    """Angles, rates and accelerations of the twelve joints along a path.

    Args:
        robot: The robot.
        motion: Sampled path.
        branch: Which solution; it is kept all along.
        path: Where the samples come from, to look closer where they are far apart.
        start: Angles of the first sample but for whole turns [rad], ``(12,)``; None for
            those in (−π, π].

    Returns:
        The joint trajectory, its angles without jumps of a whole turn, and the
        solutions with margins and residuals.

    Raises:
        Unreachable: A pose can't be reached, or an angle leaves its limits.
        SingularPose: A sample is singular, or the path crosses a serial singularity.
    """
    solution, v, a = _solve(robot, motion, branch)
    q, changes = _unwrapped(solution.angles)
    if start is not None and (turns := np.rint((start - q[0]) / (2 * np.pi))).any():
        q = q + 2 * np.pi * turns
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
    return JointTrajectory(motion.time, q, v, a), solution


def _solve(
    robot: Pollard, motion: ToolMotion, branch: Branch
) -> tuple[Solutions, np.ndarray, np.ndarray]:
    """Angles in (−π, π], rates and accelerations at the samples."""
    solution = robot.inverse_kinematics(motion.pose, branch).require("path sample", motion.time)
    v, a = np.empty(solution.angles.shape), np.empty(solution.angles.shape)
    for part in blocks(len(motion.time)):
        posture = Posture.of(robot.geometry, solution.angles[part])
        check_regular(posture, motion.time[part])
        pose, rate, acceleration = (
            rows(x[part]) for x in (motion.pose, motion.rate, motion.acceleration)
        )
        rates = joint_rates(posture, *tool_twist(posture, pose[3:5], rate))
        wrist = tool_acceleration(posture, pose[3:5], rate, acceleration)
        v[part], a[part] = rates.T, joint_accelerations(posture, rates, *wrist).T
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
