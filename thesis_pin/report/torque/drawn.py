"""What the samples of a motion leave open, carried through loops and dynamics.

Every variant of a smoothed motion (see :mod:`thesis_pin.loops.motion.variants`) is judged as the
motion itself is, at some of its samples.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import ThesisPinError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.motion.near import near_motions
from thesis_pin.loops.motion.smoothing import itself
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.loops.motion.whole import WholeMotion

Array = NDArray[np.float64]

SAMPLES = 101
"""Evenly spaced samples at which variants are judged, beside extremes: that bounds the cost."""


@dataclass(frozen=True, eq=False)
class Judged:
    """Numbers of some samples for each variant that could be worked out.

    Attributes:
        torque, speed: Of each motor, shape ``(variants, k, motors)``.
        loop_force: Size of the force in each loop [N], ``(variants, k, loops)``.
        v: Rates of all joints, ``(variants, k, nv)``.
    """

    torque: Array
    speed: Array
    loop_force: Array
    v: Array


@dataclass(frozen=True, eq=False)
class Drawn:
    """The variants of a motion beside its own curves, judged.

    Attributes:
        keep: Samples of the motion at which they are judged, shape ``(k,)``.
        rival: Order 3's curve, one variant; None if it couldn't be worked out.
        draws: The draws that could; None if none could.
        lost: How many draws couldn't.
    """

    keep: NDArray[np.intp]
    rival: Judged | None
    draws: Judged | None
    lost: int


@dataclass(frozen=True, eq=False)
class Way:
    """How a motion is carried.

    Attributes:
        robot: The robot.
        motion: The motion of some joints.
        whole: What all joints do in it.
        precision: See :func:`thesis_pin.loops.motion.whole.whole_motion`.
    """

    robot: ClosedRobot
    motion: JointMotion
    whole: WholeMotion
    precision: float | None


def drawn(way: Way, extremes: Sequence[int]) -> Drawn | None:
    """Judge the variants of a motion; None if it has none.

    Args:
        way: How it is carried.
        extremes: Samples at which the motion itself has its largest numbers.
    """
    variants = way.motion.variants
    if variants is None:
        return None
    last = len(way.motion.time) - 1
    even = np.linspace(0, last, min(last + 1, SAMPLES)).round().astype(np.intp)
    keep = np.union1d(even, np.asarray(extremes, dtype=np.intp))
    found = judged(way, keep, variants.others())
    draws = [one for one in found[1:] if one is not None]
    return Drawn(keep, found[0], _stacked(draws) if draws else None, len(found) - 1 - len(draws))


def judged(way: Way, keep: NDArray[np.intp], pick: NDArray[np.intp]) -> list[Judged | None]:
    """Numbers of some variants at some samples; None for those that can't be worked out.

    Args:
        way: How the motion is carried.
        keep: The samples, shape ``(k,)``.
        pick: Which curve of each column in each variant, ``(curves, variants)``.
    """
    motion, variants = way.motion, way.motion.variants
    assert variants is not None
    moved = variants.moved(itself(motion, keep), motion.time[keep] - motion.time[0], pick)
    *whole, good = near_motions(way.robot, way.whole, keep, moved, way.precision)
    found: list[Judged | None] = [None] * len(good)
    alive = np.flatnonzero(good)
    try:
        every = _dynamics(way, *(x[alive] for x in whole)) if len(alive) else None
    except ThesisPinError:
        every = None
    for place, k in enumerate(alive):
        if every is not None:
            found[k] = Judged(**{name: x[place : place + 1] for name, x in vars(every).items()})
            continue
        with suppress(ThesisPinError):
            found[k] = _dynamics(way, *(x[k : k + 1] for x in whole))
    return found


def _dynamics(way: Way, q: Array, v: Array, a: Array) -> Judged:
    dynamics = inverse_dynamics(way.robot, q, v, a, precision=way.precision)
    force = np.linalg.norm(dynamics.force, axis=-1)
    return Judged(dynamics.torque, v[..., way.robot.actuated], force, v)


def _stacked(found: Sequence[Judged]) -> Judged:
    names = vars(found[0])
    return Judged(**{name: np.concatenate([getattr(one, name) for one in found]) for name in names})
