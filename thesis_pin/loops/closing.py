"""Closing loops, and following motors through a motion: alone with errors, in stacks with masks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.errors import BadInput, ThesisPinError, Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.newton import Settled, settle
from thesis_pin.loops.rates import passive_rates
from thesis_pin.loops.survey import Survey, describe_gap, split_gap
from thesis_pin.loops.surveying import surveyed
from thesis_pin.numeric.arrays import finite_array, together, vector
from thesis_pin.numeric.checks import instance, whole
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Places = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Closing:
    """Configurations that were to be closed.

    Attributes:
        q: The configurations with the smallest gaps found, shape ``(..., nq)``.
        closed: Which of them are closed, shape ``(...)``.
        gaps: Of every loop [m], [rad], shape ``(..., loops, 2)``.
        reasons: Why not, one a configuration in their order; empty where it is closed.
    """

    q: Array
    closed: NDArray[np.bool_]
    gaps: Array
    reasons: tuple[str, ...]


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


def close(
    robot: ClosedRobot,
    guess: ArrayLike,
    motors: ArrayLike | None = None,
    *,
    iterations: int = 60,
    precision: float | None = None,
) -> Array:
    """Close the loops by Newton steps from a guess.

    Args:
        robot: The robot.
        guess: Configuration to start from, shape ``(..., nq)``; picks the assembly mode.
        motors: Positions of the motors, which then stay put, shape ``(..., motors)``;
            ``None`` lets every joint move.
        iterations: Most Newton steps.
        precision: See :func:`thesis_pin.loops.surveying.surveyed`.

    Returns:
        Closed configuration, shape ``(..., nq)``. Its residual is usually near 1e-15; where
        dependent equations differ by the rounding of the file, it is that.

    Raises:
        Unreachable: The steps don't end in a closed configuration, for one guess or one of
            a stack; see :func:`close_each` for those that do.
        ModelError: See :func:`thesis_pin.loops.surveying.surveyed`.
    """
    found = close_each(robot, guess, motors, iterations=iterations, precision=precision)
    if not found.closed.all():
        first = int(np.argmin(found.closed.ravel()))
        where = f"sample {first}" if found.closed.ndim else ""
        raise Unreachable(
            found.reasons[first],
            where=where,
            remedy="Start nearer to a closed configuration, or move the motors",
        )
    return found.q


def close_each(
    robot: ClosedRobot,
    guess: ArrayLike,
    motors: ArrayLike | None = None,
    *,
    iterations: int = 60,
    precision: float | None = None,
) -> Closing:
    """The same for stacks of which some can't be closed: says which, and why.

    Raises:
        ModelError: See :func:`thesis_pin.loops.surveying.surveyed`.
    """
    iterations = whole("iterations", iterations, 1)
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    given = {"guess": finite_array("guess", guess, model.nq)}
    movable = np.arange(model.nv, dtype=np.intp)
    if motors is not None:
        given["motors"] = finite_array("motors", motors, len(robot.actuators))
        movable = robot.passive
    arrays = together(**given)
    stack = arrays[0].shape[:-1]
    flat = [x.reshape(-1, x.shape[-1]) for x in arrays]
    if not len(flat[0]):
        raise BadInput("the stack is empty", allowed="at least one sample")
    data = model.createData()
    q, reasons = np.empty((len(flat[0]), model.nq)), []
    gaps = np.empty((len(q), len(robot.loops), 2))
    for k, start in enumerate(flat[0]):
        placed = start if motors is None else place_motors(robot, start, flat[1][k])
        settled, reason = _closed(robot, data, placed, movable, iterations, precision)
        q[k], gaps[k] = settled.q, loop_gaps(robot, settled.gap)
        reasons.append(reason)
    closed = np.array([not reason for reason in reasons]).reshape(stack)
    return Closing(
        q.reshape(*stack, -1), closed, gaps.reshape(*stack, *gaps.shape[1:]), tuple(reasons)
    )


def _closed(
    robot: ClosedRobot,
    data: pin.Data,
    q: Array,
    movable: Places,
    iterations: int,
    precision: float | None,
) -> tuple[Settled, str]:
    """Where steps from q end, and why that isn't closed; empty if it is."""
    equations, scale = robot.system, robot.scale
    settled = settle(equations, scale, data, q, movable, iterations=iterations)
    near = np.abs(settled.gap).max(initial=0.0) <= TOLERANCES.loop_closure
    try:
        survey = surveyed(robot, settled.q if near else q, precision)
    except Unreachable as error:
        if not near:
            return settled, f"{error.what}, at the least, after {settled.iterations} Newton steps"
        raise
    rank = survey.rank if len(movable) == robot.model.nv else survey.passive_rank
    for start in (settled.q, q):
        if settled.scaled <= 1e-12 or (start is q and is_closed(robot, survey, settled.gap)):
            break
        cut = 10 * survey.noise
        finer = settle(equations, scale, data, start, movable, cut, iterations, rank)
        if finer.scaled < settled.scaled or (start is not q and finer.converged):
            settled = finer
    if is_closed(robot, survey, settled.gap):
        return settled, ""
    reason = describe_gap(equations, settled.gap)
    return settled, f"the loops stay open after {settled.iterations} Newton steps: {reason}"


def is_closed(robot: ClosedRobot, survey: Survey, gap: Array) -> bool:
    """Whether openings ``(equations,)`` are none, or no more than the file's rounding."""
    scaled = np.abs(robot.scale.rows * gap).max(initial=0.0)
    return bool(
        np.abs(gap).max(initial=0.0) <= TOLERANCES.loop_closure or scaled <= survey.threshold
    )


def loop_gaps(robot: ClosedRobot, gap: Array) -> Array:
    """Distance [m] and angle [rad] by which each loop is open.

    Args:
        robot: The robot.
        gap: Opening of every equation, shape ``(..., equations)``.

    Returns:
        Shape ``(..., loops, 2)``.
    """
    result = np.empty((*gap.shape[:-1], len(robot.loops), 2))
    for k, (loop, rows) in enumerate(zip(robot.loops, robot.system.rows, strict=True)):
        result[..., k, :] = split_gap(loop, gap[..., rows])
    return result


def place_motors(robot: ClosedRobot, q: Array, positions: Array) -> Array:
    """A configuration ``(nq,)`` with its motors turned to positions ``(motors,)``."""
    q = q.copy()
    for place, joint_v, position in zip(robot.actuated_q, robot.actuated, positions, strict=True):
        if robot.turning[joint_v]:
            q[place : place + 2] = np.cos(position), np.sin(position)
        else:
            q[place] = position
    return q


def motor_positions(robot: ClosedRobot, q: Array) -> Array:
    """Where the motors stand in configurations ``(..., nq)``: ``(..., motors)``.

    Continuous joints are counted from −π to π.
    """
    result = np.empty((*q.shape[:-1], len(robot.actuators)))
    for k, (place, joint_v) in enumerate(zip(robot.actuated_q, robot.actuated, strict=True)):
        result[..., k] = q[..., place]
        if robot.turning[joint_v]:
            result[..., k] = np.arctan2(q[..., place + 1], q[..., place])
    return result


def follow(
    robot: ClosedRobot,
    time: ArrayLike,
    motors: ArrayLike,
    rates: ArrayLike,
    accelerations: ArrayLike,
    guess: ArrayLike,
    *,
    base: tuple[ArrayLike, ArrayLike, ArrayLike] | None = None,
    precision: float | None = None,
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
        base: Of a free flyer: poses ``(n, 7)`` (position, quaternion x, y, z, w), rates and
            accelerations ``(n, 6)`` in its own axes; None leaves it at rest at ``guess``.
        precision: See :func:`thesis_pin.loops.surveying.surveyed`.

    Returns:
        Closed configurations, rates and accelerations; each sample starts from the
        one before, so the motion stays in one assembly mode.

    Raises:
        Unreachable: A sample can't be closed.
        SingularPose: The motors don't determine the passive joints at a sample, or are
            asked to move as the loops forbid.
    """
    found = _followed(robot, time, motors, rates, accelerations, guess, base, precision, True)
    return found.motion


def follow_each(
    robot: ClosedRobot,
    time: ArrayLike,
    motors: ArrayLike,
    rates: ArrayLike,
    accelerations: ArrayLike,
    guess: ArrayLike,
    *,
    base: tuple[ArrayLike, ArrayLike, ArrayLike] | None = None,
    precision: float | None = None,
) -> Following:
    """The same where some samples may fail: says which, and why; see :func:`follow`."""
    return _followed(robot, time, motors, rates, accelerations, guess, base, precision, False)


def _followed(
    robot: ClosedRobot,
    time: ArrayLike,
    motors: ArrayLike,
    rates: ArrayLike,
    accelerations: ArrayLike,
    guess: ArrayLike,
    base: tuple[ArrayLike, ArrayLike, ArrayLike] | None,
    precision: float | None,
    strict: bool,
) -> Following:
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    count = len(robot.actuators)
    times = finite_array("time", time, None)
    columns = [
        finite_array(name, value, None, count)
        for name, value in (("motors", motors), ("rates", rates), ("accelerations", accelerations))
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
    reasons, data = [], model.createData()
    for k in range(len(times)):
        if len(robot.base):
            current[:7] = flying[0][k]
            v[k, robot.base], a[k, robot.base] = flying[1][k], flying[2][k]
        v[k, robot.actuated], a[k, robot.actuated] = columns[1][k], columns[2][k]
        placed = place_motors(robot, current, columns[0][k])
        try:
            settled, reason = _closed(robot, data, placed, robot.passive, 60, precision)
            q[k] = settled.q
            if reason:
                raise Unreachable(reason)
            survey = surveyed(robot, settled.q, precision)
            passive_rates(robot, survey, data, q[k], v[k], a[k])
            current, reason = q[k].copy(), ""
        except ThesisPinError as error:
            if strict:
                raise _at(error, k) from None
            v[k] = a[k] = np.nan
            reason = str(error)
        reasons.append(reason)
    valid = np.array([not reason for reason in reasons])
    return Following(JointTrajectory(times, q, v, a), valid, tuple(reasons))


def _at(error: ThesisPinError, sample: int) -> ThesisPinError:
    if isinstance(error, BadInput) and type(error) is not BadInput and not error.where:
        return type(error)(
            error.what, where=f"sample {sample}", allowed=error.allowed, remedy=error.remedy
        )
    return error


def _base(
    robot: ClosedRobot,
    base: tuple[ArrayLike, ArrayLike, ArrayLike] | None,
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
