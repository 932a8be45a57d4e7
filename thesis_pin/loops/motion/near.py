"""Motions beside one that is known: each sample is closed from its own place in that one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.chaining import place
from thesis_pin.loops.configurations.closing import close_stack, motor_positions
from thesis_pin.loops.configurations.rates import passive_rates
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.motion.tool import inverted, lifted
from thesis_pin.loops.motion.variants import Moved
from thesis_pin.loops.motion.whole import WholeMotion, driven_by, flown

Array = NDArray[np.float64]

_CHUNK = 512  # samples closed at once
_STEPS = 60  # Newton steps at most


def near_motions(
    robot: ClosedRobot,
    whole: WholeMotion,
    rows: NDArray[np.intp],
    moved: Moved,
    precision: float | None = None,
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """What all joints do in motions that differ a little from a known one.

    Args:
        robot: The robot.
        whole: What all joints do in the known one.
        rows: Its samples at which they are given, shape ``(k,)``.
        moved: These motions.
        precision: See :func:`thesis_pin.loops.motion.whole.whole_motion`.

    Returns:
        Configurations ``(motions, k, nq)``, rates and accelerations ``(motions, k, nv)``, and
        which motions can be closed all along, ``(motions,)``.
    """
    view = whole.view or driven_by(robot, whole.driving)
    many, count, told = moved.position.shape
    starts = np.tile(lifted(view, whole.joints.q[rows]), (many, 1))
    still = np.tile(
        motor_positions(view, lifted(view, whole.joints.q[:1])[0])[told:], (len(starts), 1)
    )
    drive = np.column_stack([moved.position.reshape(len(starts), told), still])
    v, a = np.zeros((2, len(starts), view.model.nv))
    base = np.tile(starts[:1, :7], (len(starts), 1))
    if moved.base is not None:
        value, first, second = (x.reshape(-1, x.shape[-1]) for x in moved.base)
        led = flown(value, first, second)
        if whole.tool is not None:
            led = inverted(whole.tool, value, first, second)
        base, v[:, view.base], a[:, view.base] = led
    elif len(view.base):
        base = starts[:, :7]
    v[:, view.actuated[:told]] = moved.rate.reshape(len(starts), told)
    a[:, view.actuated[:told]] = moved.acceleration.reshape(len(starts), told)
    q, good = place(view, starts, drive, base), np.ones(len(starts), dtype=bool)
    if view.equations or len(view.passive):
        data = view.model.createData()
        for first_row in range(0, len(q), _CHUNK):
            some = slice(first_row, first_row + _CHUNK)
            found, reasons = close_stack(view, data, q[some], view.passive, _STEPS, precision)
            q[some] = found.q
            survey = surveyed(view, q[some][0], precision)
            errors = passive_rates(view, survey, data, q[some], v[some], a[some])
            failed = [
                bool(why) or error is not None for why, error in zip(reasons, errors, strict=True)
            ]
            good[some] = ~np.array(failed)
    whether = np.asarray(good.reshape(many, count).all(axis=1))
    own = (
        x[:, -size:] for x, size in ((q, robot.model.nq), (v, robot.model.nv), (a, robot.model.nv))
    )
    whole_q, whole_v, whole_a = (x.reshape(many, count, -1) for x in own)
    return whole_q, whole_v, whole_a, whether
