"""Which column of samples makes most of what is open, and how fine it would have to be."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import POSE_NAMES
from scout_pin.dynamics.variants import Judged, judged, stacked
from scout_pin.model import Scout
from scout_pin.motion.gait import BODIES, GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.motion.variants import Resolution, Variants
from thesis_pin.errors import ThesisPinError
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.smoothing.curve import ORDER
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.noise import ROUNDING

Array = NDArray[np.float64]

_DRAWS = 8
_FINEST = 1e-9  # below, more digits are no answer


@dataclass(frozen=True)
class Blame:
    """A column's part in what is open.

    Attributes:
        column: The column.
        share: Its share of the variance.
        needed: Resolution that would settle it, if all columns had the like [m] or [rad].
    """

    column: Resolution
    share: float
    needed: float


def blame(
    robot: Scout,
    variants: Variants,
    at: GaitMotion,
    joints: JointTrajectory,
    unit: float,
    of: Callable[[Judged], Array],
    open_: tuple[Interval, float],
) -> Blame | None:
    """The column that makes most of a number's interval; None if it can't be told.

    One column at a time is drawn anew at the sample where the number is worst.

    Args:
        robot: The biped.
        variants: What its gait leaves open.
        at: The gait's own motion at that sample alone.
        joints: Its joints there.
        unit: Seconds in the gait's unit of t.
        of: The number from what was judged, ``(columns, draws)``.
        open_: Its interval, and the limit that it straddles.
    """
    columns, draws = variants.columns, min(_DRAWS, variants.count - 2)
    values = _one_at_a_time(variants, at.t, unit, draws)
    many = len(columns) * draws
    motion = stacked(values, np.repeat(at.t, many), np.repeat(at.support, many, axis=0), unit)
    try:
        followed = joint_trajectory(robot, motion, reference=joints.q[0])
        found = of(judged(robot, motion, followed, len(columns)))
    except ThesisPinError:
        return None
    variance = found.reshape(len(columns), draws).var(axis=1)
    if not variance.sum() > 0:
        return None
    k = int(np.argmax(variance))
    return Blame(columns[k], float(variance[k] / variance.sum()), _needed(columns[k], *open_))


def _one_at_a_time(variants: Variants, t: Array, unit: float, draws: int) -> dict[str, Array]:
    """The gait's coordinates, in turn with one column drawn, ``(3, 6, columns · draws)``."""
    columns = variants.columns
    result = {}
    for name in BODIES:
        found = np.zeros((3, 6, len(columns), draws))
        for k, curve in enumerate(variants.curves[name]):
            mine: Sequence[bool] = [
                one.body == name and one.coordinate == POSE_NAMES[k] for one in columns
            ]
            for order in range(min(3, len(curve.c))):
                each = curve(t, order)[0] / unit**order
                found[order, k] = each[0]
                found[order, k, np.array(mine)] = each[2 : 2 + draws]
        result[name] = found.reshape(3, 6, -1)
    return result


def _needed(column: Resolution, held: Interval, limit: float) -> float:
    """Resolution at which the interval would end at the limit, and one digit more.

    The posterior's standard deviation of x'' goes with σ to the power of (2m − 5)/2m.
    """
    beyond = held.high - held.value if held.value < limit else held.value - held.low
    ratio = abs(held.value - limit) / max(beyond, 1e-300)
    now = max(column.quantum, column.noise / ROUNDING)
    wanted = now * min(ratio, 1.0) ** (2 * ORDER / (2 * ORDER - 5)) / 10.0
    return max(10.0 ** math.floor(math.log10(max(wanted, 1e-300)) + 1e-9), _FINEST)
