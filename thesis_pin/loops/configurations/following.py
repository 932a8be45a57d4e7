"""Following motors through a motion: whole with errors, or with a mask."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.errors import BadInput, SingularPose, ThesisPinError, Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.chaining import MOST, chained, place
from thesis_pin.loops.configurations.rates import passive_rates
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.numeric.arrays import finite_array, vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Base: TypeAlias = tuple[ArrayLike, ArrayLike, ArrayLike]
"""How a free flyer moves: poses ``(n, 7)`` (position, quaternion x, y, z, w), rates and
accelerations ``(n, 6)`` in its own axes."""


@dataclass(frozen=True, eq=False)
class Following:
    """A motion of all joints from that of the motors.

    Attributes:
        motion: It; where it failed the configuration with the smallest gap, and NaN for
            rates and accelerations.
        valid: Which samples didn't fail, shape ``(n,)``.
        reasons: Why the others did, one a sample; empty where it didn't.
    """

    motion: JointTrajectory
    valid: NDArray[np.bool_]
    reasons: tuple[str, ...]


def follow(
    robot: ClosedRobot,
    time: ArrayLike,
    motors: ArrayLike,
    rates: ArrayLike,
    accelerations: ArrayLike,
    guess: ArrayLike,
    *,
    base: Base | None = None,
    precision: float | None = None,
    where: Callable[[int], str] = "sample {}".format,
) -> JointTrajectory:
    """Motion of all joints from that of the motors.

    Motions that no motor holds are at rest if they do no harm (rods that spin about
    themselves).

    Args:
        robot: A robot whose motors hold all else.
        time: Sample times [s], shape ``(n,)``.
        motors: Positions of the motors, shape ``(n, motors)``.
        rates: Their rates, same shape.
        accelerations: Their accelerations, same shape.
        guess: Configuration near the first sample, shape ``(nq,)``.
        base: How a free flyer moves; None leaves it at rest at ``guess``.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        where: What a sample is called in messages, by its number.

    Returns:
        Closed configurations, rates and accelerations; each sample starts from the
        one before, so the motion stays in one assembly mode.

    Raises:
        Unreachable: A sample can't be closed.
        SingularPose: The motors don't determine the passive joints at a sample, or are
            asked to move as the loops forbid.
    """
    drive = (time, motors, rates, accelerations)
    return _followed(robot, drive, guess, base, precision, where=where).motion


def follow_each(
    robot: ClosedRobot,
    time: ArrayLike,
    motors: ArrayLike,
    rates: ArrayLike,
    accelerations: ArrayLike,
    guess: ArrayLike,
    *,
    base: Base | None = None,
    precision: float | None = None,
) -> Following:
    """The same where some samples may fail: says which, and why; see :func:`follow`."""
    drive = (time, motors, rates, accelerations)
    return _followed(robot, drive, guess, base, precision, where=None)


def _followed(
    robot: ClosedRobot,
    drive: tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike],
    guess: ArrayLike,
    base: Base | None,
    precision: float | None,
    *,
    where: Callable[[int], str] | None,
) -> Following:
    """Samples that fail raise, with their place, if ``where`` says it; else they are masked."""
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    count = len(robot.actuators)
    times = finite_array("time", drive[0], None)
    columns = [
        finite_array(name, value, None, count)
        for name, value in zip(("motors", "rates", "accelerations"), drive[1:], strict=True)
    ]
    shapes = [x.shape for x in (times, *columns)]
    if shapes != [(len(times),), *[(len(times), count)] * 3] or not len(times):
        raise BadInput(
            f"time, motors, rates and accelerations have shapes {', '.join(map(str, shapes))}",
            allowed=f"(n,), then three times (n, {count}), n at least 1",
        )
    current = vector("guess", guess, model.nq).copy()
    flying = _base(robot, base, len(times), current)
    q, (v, a) = np.empty((len(times), model.nq)), np.zeros((2, len(times), model.nv))
    if len(robot.base):
        v[:, robot.base], a[:, robot.base] = flying[1:]
    v[:, robot.actuated], a[:, robot.actuated] = columns[1], columns[2]
    reasons, data = [""] * len(times), model.createData()
    if not (robot.equations or len(robot.passive)):  # a tree of motors: nothing to close
        q[:] = place(robot, np.tile(current, (len(times), 1)), columns[0], flying[0])
        return Following(JointTrajectory(times, q, v, a), np.ones(len(times), bool), tuple(reasons))
    k, many, alone = 0, 1, False  # the survey is made at the first sample
    while k < len(times):
        some = slice(k, k + many)
        try:
            closed, reason = chained(
                robot, data, current, columns[0][some], flying[0][some], precision, alone
            )
            done = slice(k, k + len(closed))
            q[done] = closed
            if reason:
                raise Unreachable(reason)
            survey = surveyed(robot, closed[0], precision)
            errors = passive_rates(robot, survey, data, closed, v[done], a[done])
            good = next((j for j, error in enumerate(errors) if error), len(closed))
            if good:
                current, k = closed[good - 1], k + good
            if good < len(closed):
                raise errors[good] or SingularPose("")
            many, alone = min(max(4 * good, many), MOST), bool(survey.idle)
        except ThesisPinError as error:
            if where is not None:
                raise _at(error, where(k)) from None
            v[k] = a[k] = np.nan
            reasons[k] = str(error)
            k, many = k + 1, 1
    valid = np.array([not reason for reason in reasons])
    return Following(JointTrajectory(times, q, v, a), valid, tuple(reasons))


def _at(error: ThesisPinError, where: str) -> ThesisPinError:
    if isinstance(error, Unreachable | SingularPose) and not error.where:
        return type(error)(error.what, where=where, allowed=error.allowed, remedy=error.remedy)
    return error


def _base(
    robot: ClosedRobot,
    base: Base | None,
    count: int,
    guess: Array,
) -> tuple[Array, Array, Array]:
    """Poses, rates and accelerations of the base, sample by sample."""
    if base is None:
        still = np.tile(guess[:7] if len(robot.base) else np.zeros(7), (count, 1))
        return still, np.zeros((count, 6)), np.zeros((count, 6))
    if not len(robot.base):
        raise BadInput("base is given for a robot that stands fixed", allowed="None")
    arrays = (
        finite_array("base poses", base[0], count, 7),
        finite_array("base rates", base[1], count, 6),
        finite_array("base accelerations", base[2], count, 6),
    )
    size = np.linalg.norm(arrays[0][:, 3:], axis=1)
    if np.abs(size - 1.0).max() > TOLERANCES.rotation_orthogonality:
        raise BadInput(
            f"base poses have a quaternion of length {size[np.argmax(np.abs(size - 1))]:g}",
            allowed="1",
        )
    return arrays
