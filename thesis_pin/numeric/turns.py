"""Angles up to whole turns: those that joint limits hold, and motions without jumps.

A revolute joint at 179.99° and one at −180.01° place their body alike; a range of −200° to 70°
holds the second only.
"""

from __future__ import annotations

import numpy as np

from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.elementwise import intervals
from thesis_pin.tolerances import TOLERANCES

TURN = 2 * np.pi


def fitted(angle: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """Angles, turned by whole turns where only so they lie inside their limits.

    Args:
        angle: [rad], any shape that the limits broadcast to; NaN stays.
        lower: Lower limits [rad].
        upper: Upper limits [rad].

    Returns:
        Same shape; what is inside already, or with no turn, stays as it is.
    """
    outside = np.maximum(lower - angle, angle - upper) > TOLERANCES.joint_limit
    if not outside.any():
        return angle
    middle = (lower + upper) / 2
    turned = middle + wrap(angle - middle)  # as near to the limits as any
    held = np.maximum(lower - turned, turned - upper) <= TOLERANCES.joint_limit
    return np.where(outside & held, turned, angle)


def need_turns(lower: np.ndarray, upper: np.ndarray) -> bool:
    """Whether some limits hold an angle of (−π, π] only whole turns from it."""
    all_of_it = (lower <= -np.pi) & (upper >= np.pi)
    none_beyond = (lower > -np.pi + TOLERANCES.joint_limit) & (upper <= np.pi)
    return bool((~(all_of_it | none_beyond)).any())


def unwound(q: np.ndarray) -> np.ndarray:
    """Angles over time without jumps of a whole turn, ``(n, joints)``, next to the first."""
    found, turned = q, np.zeros(q.shape[1])
    for part in intervals(len(q)):
        turns = turned + np.cumsum(np.rint(np.diff(q[part], axis=0) / TURN), axis=0)
        if turns.any():
            found = q.copy() if found is q else found
            found[part.start + 1 : part.stop] -= TURN * turns
            turned = turns[-1]
    return found


def started(q: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """Motions begun some turns back or on where only so their limits hold all of them.

    Args:
        q: Angles over time without jumps [rad], shape ``(n, joints)``.
        lower: Lower limits [rad], shape ``(joints,)``.
        upper: Upper limits [rad], shape ``(joints,)``.

    Returns:
        Same shape; a joint that fits as it is, or that no start makes fit, stays.
    """
    least, most, slack = q.min(axis=0), q.max(axis=0), TOLERANCES.joint_limit
    on = np.ceil((lower - slack - least) / TURN)  # turns that bring the least inside …
    back = np.floor((upper + slack - most) / TURN)  # … and the most
    turns = np.where(on <= back, np.clip(0.0, on, np.maximum(on, back)), 0.0)
    return q + TURN * turns if turns.any() else q
