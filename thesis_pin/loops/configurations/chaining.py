"""Closed configurations one from another, a block of samples at a time.

A sample is closed from the one before it, which keeps the robot in one assembly. That is a
chain; but whether all links of a guessed chain hold can be tried side by side. A block is
closed from the configuration before it, then every sample again from its neighbour: those
that come out the same are what the chain would have given.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close_stack, place_motors

Array = NDArray[np.float64]

MOST = 256
"""Samples of a block at most."""

_SAME = 1e-6  # coordinates that differ by less belong to one assembly [rad], [m]
_WAY = 1.0  # how far motors may go within a block [rad], or relative to the robot's size
_STEPS = 60  # Newton steps at most


def chained(
    robot: ClosedRobot,
    data: pin.Data,
    before: Array,
    motors: Array,
    base: Array,
    precision: float | None,
    alone: bool,
) -> tuple[Array, str]:
    """Closed configurations of as many samples as agree with the chain, at least one.

    Args:
        robot: The robot.
        data: Pinocchio's data, overwritten.
        before: Configuration from which the first one is closed, shape ``(nq,)``.
        motors: Positions of the motors, shape ``(n, motors)``.
        base: Poses of a free flyer, shape ``(n, 7)``; not used without one.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        alone: Close one sample after another: where rods idle, how far each has turned hangs
            on the whole way.

    Returns:
        Configurations, shape ``(k, nq)``, and why the first one isn't closed; empty if it is.
    """
    way = np.abs(motors - motors[0]) / robot.scale.columns[robot.actuated]
    near = _leading(way.max(axis=1, initial=0.0) <= _WAY)
    motors, base = motors[:near], base[:near]

    def closed(starts: Array) -> tuple[Array, list[str]]:
        count = len(starts)
        placed = place(robot, starts, motors[:count], base[:count])
        found, reasons = close_stack(robot, data, placed, robot.passive, _STEPS, precision)
        return found.q, reasons

    if alone:
        rows: list[Array] = []
        for k in range(near):
            placed = place(robot, before[None], motors[k : k + 1], base[k : k + 1])
            found, why = close_stack(robot, data, placed, robot.passive, _STEPS, precision)
            if why[0]:
                return np.array(rows or [found.q[0]]), "" if rows else why[0]
            before = found.q[0]
            rows.append(before)
        return np.array(rows), ""
    first, reasons = closed(np.tile(before, (near, 1)))
    count = _leading(np.array([not reason for reason in reasons]))
    if near == 1 or not count:
        return first[:1], reasons[0]
    again, whys = closed(np.concatenate([before[None], first[: count - 1]]))
    apart = np.abs(again - first[:count]).max(axis=1)
    agree = (apart <= _SAME) & np.array([not why for why in whys])
    return again[: max(_leading(agree), 1)], ""


def place(robot: ClosedRobot, q: Array, motors: Array, base: Array) -> Array:
    """Configurations ``(n, nq)`` with motors ``(n, motors)`` and base ``(n, 7)`` as told."""
    placed = place_motors(robot, q, motors)
    if len(robot.base):
        placed[:, :7] = base
    return placed


def _leading(true: NDArray[np.bool_]) -> int:
    """How many of the first are true without a break."""
    return len(true) if true.all() else int(np.argmin(true))
