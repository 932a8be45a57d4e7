"""Which column of samples makes most of what is open."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import POSE_NAMES
from scout_pin.dynamics.variants import Judged, judged, stacked
from scout_pin.model import Scout
from scout_pin.motion.gait import BODIES, GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.motion.variants import Variants
from thesis_pin.errors import ThesisPinError
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.report.uncertainty.reason import DRAWS, culprit
from thesis_pin.smoothing.resolution import Resolution

Array = NDArray[np.float64]


def blame(
    robot: Scout,
    variants: Variants,
    at: GaitMotion,
    joints: JointTrajectory,
    unit: float,
    of: Callable[[Judged], Array],
) -> tuple[Resolution, float] | None:
    """The column that makes most of a number's interval, and its share; None if it can't be told.

    One column at a time is drawn anew at the sample where the number is worst.

    Args:
        robot: The biped.
        variants: What its gait leaves open.
        at: The gait's own motion at that sample alone.
        joints: Its joints there.
        unit: Seconds in the gait's unit of t.
        of: The number from what was judged, ``(columns, draws)``.
    """
    columns, draws = variants.columns, min(DRAWS, variants.count - 2)
    values = _one_at_a_time(variants, at.t, unit, draws)
    many = len(columns) * draws
    motion = stacked(values, np.repeat(at.t, many), np.repeat(at.support, many, axis=0), unit)
    try:
        followed = joint_trajectory(robot, motion, reference=joints.q[0])
        found = of(judged(robot, motion, followed, len(columns)))
    except ThesisPinError:
        return None
    return culprit(columns, found.reshape(len(columns), draws))


def _one_at_a_time(variants: Variants, t: Array, unit: float, draws: int) -> dict[str, Array]:
    """The gait's coordinates, in turn with one column drawn, ``(3, 6, columns · draws)``."""
    columns = variants.columns
    result = {}
    for name in BODIES:
        found = np.zeros((3, 6, len(columns), draws))
        for k, curve in enumerate(variants.curves[name]):
            mine: Sequence[bool] = [one.name == f"{name}_{POSE_NAMES[k]}" for one in columns]
            for order in range(min(3, len(curve.c))):
                each = curve(t, order)[0] / unit**order
                found[order, k] = each[0]
                found[order, k, np.array(mine)] = each[2 : 2 + draws]
        result[name] = found.reshape(3, 6, -1)
    return result
