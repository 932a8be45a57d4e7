"""Tool motion → joint motion, with everything that can go wrong on the way named."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, one_branch
from pollard_pin.kinematics.inverse import usual
from pollard_pin.kinematics.linkage import Linkage
from pollard_pin.kinematics.rates import motion_rates, stack_rates
from pollard_pin.kinematics.regular import check_regular
from pollard_pin.kinematics.solutions import Solutions, Solved
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion, ToolPath
from pollard_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import (
    FEW,
    LONG,
    Samples,
    blocks,
    components,
    intervals,
    pieces,
    put,
)
from thesis_pin.numeric.long import LongTrajectory
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.numeric.turns import TURN, started, unwound
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


class LongSolvedTrajectory(LongTrajectory, SolvedTrajectory):
    """Of very many samples: rates and accelerations are worked out when asked for."""

    def __init__(
        self, robot: Pollard, motion: ToolMotion, q: np.ndarray, solutions: Solutions
    ) -> None:
        derive = partial(_rates, robot, motion, solutions.angles)
        super().__init__(motion.time, q, derive)
        object.__setattr__(self, "solutions", solutions)


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
            None for angles in (−π, π], or whole turns from it where only so the limits
            hold the whole motion.

    Raises:
        Unreachable: A pose can't be reached, or an angle leaves its limits.
        SingularPose: A sample is singular, or the path crosses a serial singularity.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    instance("motion", motion, ToolMotion, "ToolPath.sample()")
    branch = DEFAULT_BRANCH if branch is None else one_branch(branch)
    start = None if reference is None else vector("reference", reference, 12)
    joints = _solve(robot, motion, branch, start)
    check_steps(robot, motion.path, branch, joints)
    if joints.q is not joints.solutions.angles:  # which keep them
        _check_limits(robot, motion.time, joints.q)
    return joints


def check_steps(
    robot: Pollard, path: ToolPath | None, branch: Branch, joints: JointTrajectory
) -> None:
    """Refuse a motion that crosses a serial singularity between two samples.

    Raises:
        SingularPose: An angle changes much more than its rate says, and the path, looked at
            more closely, breaks there.
    """
    time = joints.time
    for k, joint, change in _suspicious(joints):
        if path is None or _breaks(robot, path, time[k : k + 2], branch):
            raise SingularPose(
                f"the path crosses a serial singularity: {JOINT_NAMES[joint]} "
                f"({JOINT_SYMBOLS[joint]}) jumps by {np.degrees(change):.0f}°",
                where=f"between t = {time[k]:.6g} and {time[k + 1]:.6g} s",
                remedy="Move the path, turn the tool or choose another branch"
                + ("" if path else "; if the samples are far apart, take more of them"),
            )


def _solve(
    robot: Pollard, motion: ToolMotion, branch: Branch, reference: np.ndarray | None = None
) -> SolvedTrajectory:
    """Angles without jumps of a turn, rates and accelerations."""
    solutions, rates, inside = _usual(robot, motion, branch) or _any(robot, motion, branch)
    q = solutions.angles
    if not inside:
        q = unwound(q)
    if reference is not None:
        turns = np.rint((reference - q[0]) / TURN)
        q = q + TURN * turns if turns.any() else q
    elif not inside:
        q = started(q, robot.lower, robot.upper)
    if len(rates):
        return SolvedTrajectory(motion.time, q, rates[0], rates[1], solutions)
    return LongSolvedTrajectory(robot, motion, q, solutions)


_Motion = tuple[Solutions, np.ndarray | tuple[np.ndarray, ...], bool]
"""Solutions; rates and accelerations ``(n, 12)``, none for very many samples; whether the angles
neither jump by a turn nor leave the limits, or else may."""


def _usual(robot: Pollard, motion: ToolMotion, branch: Branch) -> _Motion | None:
    """A motion whose samples are reachable and regular; None if one takes a closer look."""
    count, geometry = len(motion.time), robot.geometry
    long = count >= LONG
    # Angles, rates, accelerations: one array of 4 MB or more comes in large pages.
    whole, cosines = np.empty((1 if long else 3, count, 12)), np.empty((count, 3))
    angles, rates = whole[0], whole[1:]
    least, most = np.full(12, np.inf), np.full(12, -np.inf)
    for xp, _, piece in pieces(count):
        found = usual(xp, geometry, components(motion.pose, piece), branch)
        if found is None:
            return None
        put(angles, piece, found[0])
        put(cosines, piece, found[1])
        if not long:
            both = motion_rates(geometry, found[2], motion.tool, piece)
            put(rates[0], piece, both[0])
            put(rates[1], piece, both[1])
        if isinstance(found[0], np.ndarray):  # rows, of which these cost least
            least = np.minimum(least, found[0].min(axis=1))
            most = np.maximum(most, found[0].max(axis=1))
    if count < FEW:
        least, most = (angles, angles) if count == 1 else (angles.min(axis=0), angles.max(axis=0))
    if not (np.maximum(robot.lower - least, most - robot.upper) <= TOLERANCES.joint_limit).all():
        return None
    solutions = Solutions(geometry, (branch,), motion.pose, Solved(angles, cosines))
    return solutions, rates, bool((most - least < np.pi).all())


def _any(robot: Pollard, motion: ToolMotion, branch: Branch) -> _Motion:
    """Whatever can be solved, or the reason why it can't."""
    solutions = robot.inverse_kinematics(motion.pose, branch).require("path sample", motion.time)
    geometry, angles = robot.geometry, solutions.angles
    if len(angles) < LONG:
        return solutions, stack_rates(geometry, angles, motion.tool, motion.time), False
    for part in blocks(len(angles)):
        known = Linkage.of(geometry, components(angles, part))
        check_regular(geometry, known, motion.time[part], part.start)
    return solutions, (), False


def _rates(
    robot: Pollard, motion: ToolMotion, angles: np.ndarray, samples: Samples
) -> tuple[np.ndarray, np.ndarray]:
    """Joint rates and accelerations at some samples, each ``(m, 12)``."""
    some, first = motion.part(samples), samples.start if isinstance(samples, slice) else 0
    return stack_rates(robot.geometry, angles[samples], some.tool, some.time, first=first or 0)


def _suspicious(joints: JointTrajectory) -> list[tuple[int, int, float]]:
    """Sample, joint and change [rad] wherever an angle changes much more than its rate says."""
    found = []
    for part in intervals(len(joints.time)):
        changes = np.diff(joints.q[part], axis=0)
        for k, joint in np.argwhere(np.abs(changes) > _JUMP):
            first = int(part.start + k)
            ends = joints.part(slice(first, first + 2))
            foreseen = (ends.time[1] - ends.time[0]) * ends.v[:, joint].sum() / 2
            if abs(changes[k, joint] - foreseen) > _UNFORESEEN:
                found.append((first, int(joint), float(changes[k, joint])))
    return found


def _breaks(robot: Pollard, path: ToolPath, ends: np.ndarray, branch: Branch) -> bool:
    """Whether the branch breaks between two samples, looked at 300 times as closely."""
    motion = path.at(np.linspace(ends[0], ends[1], 301))
    return bool(_suspicious(_solve(robot, motion, branch)))


def _check_limits(robot: Pollard, time: np.ndarray, q: np.ndarray) -> None:
    for part in blocks(len(q)):
        beyond = np.maximum(robot.lower - q[part], q[part] - robot.upper) > TOLERANCES.joint_limit
        if not beyond.any():
            continue
        k, joint = (int(i) for i in np.argwhere(beyond)[0] + (part.start, 0))
        low, high = np.degrees([robot.lower[joint], robot.upper[joint]])
        mine = q[:, joint : joint + 1]
        start = started(mine, robot.lower[joint : joint + 1], robot.upper[joint : joint + 1])
        least, most = np.degrees([mine.min(), mine.max()])
        raise Unreachable(
            f"{JOINT_NAMES[joint]} ({JOINT_SYMBOLS[joint]}) leaves its limits: "
            f"{np.degrees(q[k, joint]):.2f}°, outside {low:g}° to {high:g}°",
            where=f"t = {time[k]:.6g} s",
            allowed=f"a motion that fits them from some start; this goes from {least:.2f}° to "
            f"{most:.2f}°",
            remedy="Move the path, or turn the tool the other way"
            if start is mine
            else f"Start it at {np.degrees(start[0, 0]):.2f}° (reference)",
        )
