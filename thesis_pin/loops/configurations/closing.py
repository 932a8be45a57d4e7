"""Closing loops: alone with errors, in stacks with masks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.errors import BadInput, Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.system.gaps import describe_gap, split_gap
from thesis_pin.loops.system.newton import WIDE, Settled, settle
from thesis_pin.loops.system.survey import Survey
from thesis_pin.numeric.arrays import finite_array, together
from thesis_pin.numeric.checks import instance, whole
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
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Returns:
        Closed configuration, shape ``(..., nq)``. Its residual is usually near 1e-15; where
        dependent equations differ by the rounding of the file, it is that.

    Raises:
        Unreachable: The steps don't end in a closed configuration, for one guess or one of
            a stack; see :func:`close_each` for those that do.
        ModelError: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
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
        ModelError: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
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
        settled, reason = close_one(robot, data, placed, movable, iterations, precision)
        q[k], gaps[k] = settled.q, loop_gaps(robot, settled.gap)
        reasons.append(reason)
    closed = np.array([not reason for reason in reasons]).reshape(stack)
    return Closing(
        q.reshape(*stack, -1), closed, gaps.reshape(*stack, *gaps.shape[1:]), tuple(reasons)
    )


def close_one(
    robot: ClosedRobot,
    data: pin.Data,
    q: Array,
    movable: Places,
    iterations: int,
    precision: float | None,
    patience: int | None = None,
) -> tuple[Settled, str]:
    """Where steps from q end, and why that isn't closed; empty if it is.

    With patience (see :func:`settle`) a wide gap from which a survey would take the same
    steps again is left open at once.
    """
    equations, scale = robot.system, robot.scale
    settled = settle(equations, scale, data, q, movable, iterations=iterations, patience=patience)
    near = np.abs(settled.gap).max(initial=0.0) <= TOLERANCES.loop_closure
    surveyable = precision is not None or robot.surveys or settled.scaled <= WIDE
    if patience is not None and not near and not surveyable:
        return settled, _stays_open(robot, settled)
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
    return settled, _stays_open(robot, settled)


def _stays_open(robot: ClosedRobot, settled: Settled) -> str:
    reason = describe_gap(robot.system, settled.gap)
    return f"the loops stay open after {settled.iterations} Newton steps: {reason}"


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
