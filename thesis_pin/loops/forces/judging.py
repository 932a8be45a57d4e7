"""Is a pose generic, and how much may its torques be off: what makes a result trustworthy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, SingularPose
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.system.equations import Poses
from thesis_pin.loops.system.survey import Survey
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

REFUSED = 0.3
"""Relative uncertainty of a torque above which it isn't given [-]."""

DOUBTFUL = 1e-2
"""Relative uncertainty of a torque of which a report warns [-]."""


class Contradiction(SingularPose):
    """A pose has another number of independent equations than its assembly."""


def refuse_singular(robot: ClosedRobot, survey: Survey, matrix: Array, where: str) -> None:
    """Refuse a pose at which the equations or the motors have lost a direction.

    Args:
        robot: The robot.
        survey: Of the assembly.
        matrix: Scaled Jacobian, shape ``(equations, nv)``.
        where: Which sample.

    Raises:
        Contradiction: The pose seems to be of another assembly.
        SingularPose: It is singular.
    """
    equations, passive = robot.system, robot.passive
    values = np.append(equations.parts().values(matrix), 0.0)
    rank, noise = survey.rank, survey.noise
    last = float(values[rank - 1]) if rank else np.inf
    following = float(values[rank])
    if following > survey.threshold or last < survey.threshold:
        raise Contradiction(
            f"{rank} equations of the loops are independent elsewhere, here the weakest of "
            f"them has {last:.1e} rad and the next {following:.1e}: branches cross",
            where=where,
            remedy="Keep away from this pose",
        )
    if last < 10 * max(noise, following):
        raise SingularPose(
            f"the loops lose an equation: its weight is {last:.1e} rad, that of the file's "
            f"rounding {max(noise, following):.1e}",
            where=where,
            remedy="Keep away from this pose",
        )
    inner = equations.parts(passive).values(matrix[:, passive])
    count = survey.passive_rank
    if count and inner[count - 1] < 10 * noise:
        raise SingularPose(
            "the motors lose control: the other joints can move while they stand still",
            where=where,
            remedy="Keep away from this pose",
        )


def weakest_motion(robot: ClosedRobot, survey: Survey, scaled: Array) -> tuple[Array, Array]:
    """Weakest counting singular value and its motion, scaled: ``(n,)`` and ``(n, nv)``.

    Args:
        robot: The robot.
        survey: Of the assembly.
        scaled: Scaled Jacobians, shape ``(n, equations, nv)``.
    """
    directions = np.zeros((len(scaled), scaled.shape[2]))
    held, equations = np.arange(scaled.shape[2]), robot.system
    if survey.passive_rank == survey.rank:
        held = robot.passive
    _, values, right = equations.parts(held).svd(scaled[:, :, held])
    directions[:, held] = right[:, survey.rank - 1]
    return values[:, survey.rank - 1], directions


def refuse_opening(
    robot: ClosedRobot,
    survey: Survey,
    poses: Poses,
    matrices: Array,
    v: Array,
    a: Array,
    first: int,
) -> None:
    """Refuse motions that open the loops by more than rounding does.

    Args:
        robot: The robot.
        survey: Of the assembly.
        poses: Of the samples, with velocities.
        matrices: Jacobians there, shape ``(n, equations, nv)``.
        v: Rates, shape ``(n, nv)``.
        a: Accelerations, same shape.
        first: Number of the first sample, for messages.

    Raises:
        BadInput: Some sample does.
    """
    equations, rows = robot.system, robot.scale.rows
    speed, push = np.abs(v).max(axis=1, initial=0.0), np.abs(a).max(axis=1, initial=0.0)
    if not survey.freedom or not survey.moves:
        moving = (speed > 0) | (push > 0)
        if moving.any():
            how = "only infinitesimally" if survey.freedom else "not at all"
            raise BadInput(
                f"the robot moves {how}, but rates or accelerations are given",
                where=f"sample {first + int(np.argmax(moving))}",
                allowed="zero",
                remedy="Give a precision if equations that nearly agree aren't to count"
                if survey.freedom or survey.cut < 1e-4
                else "",
            )
    gap = equations.gap(poses)
    opening = (
        np.where(np.abs(gap) <= TOLERANCES.loop_closure, 0.0, rows * gap),
        rows * (matrices @ v[..., None])[..., 0],
        rows * ((matrices @ a[..., None])[..., 0] + equations.drift(poses, v)),
    )
    limit = max(TOLERANCES.loop_motion, survey.threshold)
    limits = (
        np.full(len(v), survey.threshold),
        limit * (1.0 + speed),
        limit * (1.0 + speed**2 + push),
    )
    for what, gaps, allowed in zip(("", " rate", " acceleration"), opening, limits, strict=True):
        worst = np.abs(gaps).max(axis=1, initial=0.0)
        bad = worst > allowed
        if bad.any():
            k = int(np.argmax(bad))
            remedy = "Give the motors' motion alone: the other joints follow from the loops"
            if not what:
                remedy = (
                    f"Close it: thesis_pin.loops.configurations.closing.close(robot, q). {remedy}"
                )
            raise BadInput(
                f"the {'motion' if what else 'pose'} opens the loops: their opening{what} is "
                f"{worst[k]:.2e} of their size",
                where=f"sample {first + k}",
                allowed=f"{allowed[k]:.1e}",
                remedy=remedy,
            )


def is_uncertain(survey: Survey, weakest: Array) -> NDArray[np.bool_]:
    """Where the file's noise may move torques by more than it is large, ``(n,)``."""
    return np.asarray(survey.blur > 1e-3 * weakest**2)
