"""A robot moved by one coordinate: held where it is told, all else solved from where it stands."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, pi

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import ThesisPinError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close_stack
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.moving.coordinates import Coordinate

Array = NDArray[np.float64]
Places = NDArray[np.intp]

STEP = 0.05
"""Longest step of the coordinate [rad], or relative to the robot's size: loops are closed from one
to the next, so that the robot stays in its assembly."""

MOST_STEPS = 64
"""Steps of one move; longer ways take longer steps."""

_JUMP = 0.5  # what another joint may turn in one step, or slide relative to the robot's size
_HALVINGS = 4  # times that a step is halved which can't be closed
_NEWTON = 20  # steps of closing: a short way takes five


@dataclass(frozen=True, eq=False)
class Moved:
    """Where a robot stands after a move.

    Attributes:
        q: Its configuration, shape ``(nq,)``: closed, as near to what was asked as it could be
            brought.
        reached: Whether the coordinate is where it was asked to be.
        why: Why not, in words.
    """

    q: Array
    reached: bool = True
    why: str = ""


def move(
    robot: ClosedRobot,
    q: Array,
    coordinate: Coordinate,
    value: float,
    *,
    precision: float | None = None,
) -> Moved:
    """Bring one coordinate to a value and keep the loops closed.

    If it is a motor's, the other motors stand still as long as the motors are independent of each
    other; else all other joints move, as little as may be. A root that flies freely stays.

    Args:
        robot: A robot with loops, couplings, or none.
        q: A closed configuration, shape ``(nq,)``.
        coordinate: Which coordinate moves.
        value: Where to [rad], [m].
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Returns:
        The last closed configuration on the way from q to the value.
    """
    if not robot.equations:
        return Moved(coordinate.placed(q, value))
    way, here = coordinate.way(q, value), coordinate.value(q)
    size = robot.scale.length if coordinate.unit == "m" else 1.0
    count = min(max(ceil(abs(way) / (STEP * size)), 1), MOST_STEPS)
    data, movable = robot.model.createData(), _movable(robot, q, coordinate, precision)
    done, step, halvings, why = 0.0, 1.0 / count, 0, ""
    while done < 1.0 and halvings <= _HALVINGS:
        part = min(done + step, 1.0)
        if 1.0 - part < step / 2:
            part = 1.0
        target = value if part == 1.0 else here + part * way
        placed = coordinate.placed(q, target)
        try:
            settled, reasons = close_stack(robot, data, placed[None], movable, _NEWTON, precision)
            why = reasons[0] or _jump(robot, q, settled.q[0], movable)
        except ThesisPinError as error:
            why = str(error)
        if why:
            step, halvings = step / 2, halvings + 1
        else:
            q, done, why = settled.q[0], part, ""
    return Moved(q, done >= 1.0, why)


def _movable(
    robot: ClosedRobot, q: Array, coordinate: Coordinate, precision: float | None
) -> Places:
    """Velocities that may change while the coordinate is held."""
    free = np.ones(robot.model.nv, dtype=bool)
    free[robot.base] = False
    free[list(coordinate.v)] = False
    if len(coordinate.v) == 1 and coordinate.v[0] in robot.actuated:
        try:
            survey = surveyed(robot, q, precision)
        except ThesisPinError:
            return np.flatnonzero(free)
        if survey.passive_rank == survey.rank:
            free[robot.actuated] = False
    return np.flatnonzero(free)


def _jump(robot: ClosedRobot, before: Array, after: Array, movable: Places) -> str:
    """Why a step isn't one within the assembly: something else leapt; empty if nothing did."""
    change = np.asarray(pin.difference(robot.model, before, after)) / robot.scale.columns
    if np.abs(change[movable]).max(initial=0.0) <= _JUMP:
        return ""
    return "the loops would close in another assembly only"


def ways(coordinates: tuple[Coordinate, ...], length: float) -> Iterator[tuple[float, float]]:
    """The ends between which each coordinate is moved: its range, or what is usual without one.

    Args:
        coordinates: The coordinates.
        length: The robot's size [m].

    Yields:
        Least and greatest value: half a turn either way without a range (of a pitch a quarter),
        and the robot's size of what slides.
    """
    for one in coordinates:
        usual = length if one.unit == "m" else pi
        if one.kind == "angle" and one.part == 1:
            usual = pi / 2
        low = one.low if np.isfinite(one.low) else min(-usual, one.high - usual)
        high = one.high if np.isfinite(one.high) else max(usual, low + usual)
        yield low, high
