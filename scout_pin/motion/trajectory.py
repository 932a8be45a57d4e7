"""Task motion → joint motion of the biped."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.kinematics import one_sample
from scout_pin.kinematics.rates import solve
from scout_pin.kinematics.screws import LegScrews
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import JOINT_NAMES, SIDES
from thesis_pin.errors import Unreachable
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import LONG, Samples, blocks
from thesis_pin.numeric.long import LongTrajectory
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory
from thesis_pin.numeric.turns import TURN, started, unwound
from thesis_pin.tolerances import TOLERANCES

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
        branch: What to choose from, see :meth:`scout_pin.Scout.inverse_kinematics`; None
            for what the gait says, else the specification.
        reference: Angles [rad] the first sample is to be near, ``(12,)``; None for zero.
            Where a range is wider than a turn, its whole turns are taken.

    Raises:
        Unreachable: Some pose has no valid branch, or a joint turns out of its range.
        SingularPose: A leg's Jacobian loses rank on the way.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    instance("motion", motion, GaitMotion, "Gait.sample()")
    q = followed(robot, motion, branch, reference)
    if len(q) < LONG:
        return JointTrajectory(motion.time, q, *_rates(robot, motion, q))
    for side, mine in zip(SIDES, _LEGS, strict=True):
        for part in blocks(len(q)):
            if _rests(motion.part(part), side):
                continue
            LegScrews(robot.legs[side], q[part, mine]).refuse_singular(part.start)
    return LongTrajectory(motion.time, q, partial(_rates, robot, motion, q))


def followed(
    robot: Scout,
    motion: GaitMotion,
    branch: str | Sequence[str] | None = None,
    reference: ArrayLike | None = None,
) -> np.ndarray:
    """Angles of :func:`joint_trajectory` alone [rad], ``(n, 12)``; same arguments."""
    start = None if reference is None else vector("reference", reference, 12)
    asked = motion.branch if branch is None else branch
    q = robot.follow(motion.torso, motion.left_foot, motion.right_foot, start, branch=asked)
    if max(robot.upper.max(), -robot.lower.min()) > np.pi:
        q = _without_jumps(robot, motion.time, q, start)
    return q


def _without_jumps(
    robot: Scout, time: np.ndarray, q: np.ndarray, reference: np.ndarray | None
) -> np.ndarray:
    """Angles that go on where a range holds more than a turn, ``(n, 12)``."""
    q = unwound(q)
    if reference is not None:
        q = q + TURN * np.rint((reference - q[0]) / TURN)
    else:
        q = started(q, robot.lower, robot.upper)
    outside = np.maximum(robot.lower - q, q - robot.upper) > TOLERANCES.joint_limit
    if outside.any():
        k, joint = (int(i) for i in np.argwhere(outside)[0])
        least, most, low, high = np.degrees(
            [q[:, joint].min(), q[:, joint].max(), robot.lower[joint], robot.upper[joint]]
        )
        raise Unreachable(
            f"{JOINT_NAMES[joint]} turns out of its limits: {np.degrees(q[k, joint]):.2f}°, "
            f"outside {low:g}° to {high:g}°",
            where=f"t = {time[k]:.6g} s",
            allowed=f"a motion that fits them from some start; this goes from {least:.2f}° to "
            f"{most:.2f}°",
            remedy="Turn the feet less",
        )
    return q


def _rates(
    robot: Scout, motion: GaitMotion, q: np.ndarray, samples: Samples | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Joint rates and accelerations at some samples or all, each ``(m, 12)``."""
    if samples is not None:
        motion, q = motion.part(samples), q[samples]
    v, a = np.empty((2, 12, len(q)))
    for part, here in motion.blocks():
        fill_rates(robot, here, q[part], (v[:, part], a[:, part]), part.start)
    return v.T, a.T


def fill_rates(
    robot: Scout,
    motion: GaitMotion,
    q: np.ndarray,
    out: tuple[np.ndarray, np.ndarray],
    first: int = 0,
) -> tuple[LegScrews | None, LegScrews | None]:
    """Write rates and accelerations of one block of samples into arrays ``(12, n)``.

    Args:
        robot: The biped.
        motion: The block's motion.
        q: Its joint angles [rad], shape ``(n, 12)``.
        out: Where rates and accelerations go, joints first.
        first: Number of its first sample, for messages.

    Returns:
        Each leg's screws; None where it rests.

    Raises:
        SingularPose: A leg's Jacobian has lost rank.
    """
    if len(q) == 1:
        return _fill_one(robot, motion, q[0].tolist(), out, first)
    screws: list[LegScrews | None] = []
    for side, mine in zip(SIDES, _LEGS, strict=True):
        if _rests(motion, side):
            screws.append(None)
            for rows in out:
                rows[mine] = 0.0
            continue
        leg = LegScrews(robot.legs[side], q[:, mine])
        leg.refuse_singular(first)
        screws.append(leg)
        for rows, found in zip(out, solve(leg, _foot(motion, side), motion.torso), strict=True):
            for row, joint in zip(rows[mine], found, strict=True):
                row[:] = joint
    return screws[0], screws[1]


def _fill_one(
    robot: Scout,
    motion: GaitMotion,
    q: Sequence[float],
    out: tuple[np.ndarray, np.ndarray],
    first: int,
) -> tuple[LegScrews | None, LegScrews | None]:
    """:func:`fill_rates` of a single sample, a fifth of the time by floats."""
    torso = one_sample.numbers(motion.torso)
    still, screws = one_sample.rests(torso), list[LegScrews | None]()
    for side, mine in zip(SIDES, _LEGS, strict=True):
        foot = one_sample.numbers(_foot(motion, side))
        if still and one_sample.rests(foot):
            screws.append(None)
            for rows in out:
                rows[mine] = 0.0
            continue
        leg = LegScrews.single(robot.legs[side], q[mine])
        leg.refuse_singular(first)
        screws.append(leg)
        rate, second = one_sample.solve(leg, foot, torso)
        out[0][mine, 0], out[1][mine, 0] = rate, second
    return screws[0], screws[1]


def _foot(motion: GaitMotion, side: str) -> BodyMotion:
    return motion.left_foot if side == "left" else motion.right_foot


def _rests(motion: GaitMotion, side: str) -> bool:
    """Whether torso and a foot rest throughout: so do the joints, at singular poses too."""
    return not any(
        body.velocity.any()
        or body.omega.any()
        or body.acceleration.any()
        or body.alpha.any()
        or np.ptp(body.position, axis=0).any()
        or np.ptp(body.rotation, axis=0).any()
        for body in (motion.torso, _foot(motion, side))
    )
