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
from thesis_pin.loops.system.newton import WIDE, Settled, Stack, settle
from thesis_pin.loops.system.survey import Survey
from thesis_pin.numeric.arrays import finite_array, together
from thesis_pin.numeric.checks import instance, whole
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Places = NDArray[np.intp]

_CHUNK = 1024  # configurations closed at once, so that memory stays bounded
_CLOSED = 1e-12  # scaled gap that finer steps needn't make smaller [rad]


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
    placed = flat[0] if motors is None else place_motors(robot, *flat)
    q, reasons = np.empty_like(placed), list[str]()
    gaps = np.empty((len(q), len(robot.loops), 2))
    for first in range(0, len(q), _CHUNK):
        some = slice(first, first + _CHUNK)
        settled, why = close_stack(robot, data, placed[some], movable, iterations, precision)
        q[some], gaps[some] = settled.q, loop_gaps(robot, settled.gap)
        reasons += why
    closed = np.array([not reason for reason in reasons]).reshape(stack)
    return Closing(
        q.reshape(*stack, -1), closed, gaps.reshape(*stack, *gaps.shape[1:]), tuple(reasons)
    )


def close_one(
    robot: ClosedRobot,
    data: pin.Data,
    q: Array,
    iterations: int,
    precision: float | None,
    patience: int | None = None,
) -> tuple[Settled, str]:
    """:func:`close_stack` of one configuration ``(nq,)`` of which every joint may move."""
    every = np.arange(robot.model.nv, dtype=np.intp)
    found, reasons = close_stack(robot, data, q[None], every, iterations, precision, patience)
    return found.one(0), reasons[0]


def close_stack(
    robot: ClosedRobot,
    data: pin.Data,
    q: Array,
    movable: Places,
    iterations: int,
    precision: float | None,
    patience: int | None = None,
) -> tuple[Stack, list[str]]:
    """Where steps from each of q ``(n, nq)`` end, and why that isn't closed; empty if it is.

    With patience (see :func:`settle`) a wide gap from which a survey would take the same
    steps again is left open at once.
    """
    equations, scale = robot.system, robot.scale
    settled = settle(equations, scale, data, q, movable, iterations=iterations, patience=patience)
    reasons = [""] * len(q)
    near = np.abs(settled.gap).max(axis=1, initial=0.0) <= TOLERANCES.loop_closure
    hopeless = ~near & (settled.scaled > WIDE)
    if patience is None or precision is not None or robot.surveys:
        hopeless[:] = False
    survey = None
    for k in np.argsort(~near, kind="stable"):  # where the loops are closed is their assembly
        if not hopeless[k]:
            try:
                survey = surveyed(robot, settled.q[k] if near[k] else q[k], precision)
                break
            except Unreachable as error:
                if near[k]:
                    raise
                steps = settled.iterations[k]
                reasons[k] = f"{error.what}, at the least, after {steps} Newton steps"
    if survey is not None:
        _finer(robot, data, survey, settled, q, movable, iterations)
    for k in range(len(q)):
        if not reasons[k] and not (survey and is_closed(robot, survey, settled.gap[k])):
            reasons[k] = (
                f"the loops stay open after {settled.iterations[k]} Newton steps: "
                f"{describe_gap(equations, settled.gap[k])}"
            )
    return settled, reasons


def _finer(
    robot: ClosedRobot,
    data: pin.Data,
    survey: Survey,
    settled: Stack,
    q: Array,
    movable: Places,
    iterations: int,
) -> None:
    """Go on, from where the steps ended and from the start, with all that is no noise."""
    rank = survey.rank if len(movable) == robot.model.nv else survey.passive_rank
    for start in (settled.q, q):
        todo = settled.scaled > _CLOSED
        if start is q:
            todo &= [not is_closed(robot, survey, gap) for gap in settled.gap]
        if not todo.any():
            return
        places = np.flatnonzero(todo)
        found = settle(
            robot.system,
            robot.scale,
            data,
            start[places],
            movable,
            10 * survey.noise,
            iterations,
            rank,
        )
        better = found.scaled < settled.scaled[places]
        if start is not q:
            better |= found.converged
        settled.replace(places, found, better)


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
    """Configurations ``(n, nq)`` with their motors turned to positions ``(n, motors)``."""
    q = q.copy()
    for k, (place, joint_v) in enumerate(zip(robot.actuated_q, robot.actuated, strict=True)):
        if robot.turning[joint_v]:
            q[:, place], q[:, place + 1] = np.cos(positions[:, k]), np.sin(positions[:, k])
        else:
            q[:, place] = positions[:, k]
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
