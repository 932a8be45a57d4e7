"""What the samples of a motion leave open, carried through loops and dynamics.

Every variant of a smoothed motion (see :mod:`thesis_pin.loops.motion.variants`) is judged as the
motion itself is, at some of its samples.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import ThesisPinError
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.motion.near import near_motions
from thesis_pin.loops.motion.smoothing import itself
from thesis_pin.report.torque.nearby import Way, near_ways, since_start

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Judged:
    """Numbers of some samples for each variant that could be worked out.

    Attributes:
        torque, speed: Of each motor, shape ``(variants, k, motors)``.
        loop_force: Size of the force in each loop [N], ``(variants, k, loops)``.
    """

    torque: Array
    speed: Array
    loop_force: Array


@dataclass(frozen=True, eq=False)
class Drawn:
    """The variants of a motion beside its own curves, judged.

    Attributes:
        keep: Samples of the motion at which they are judged, shape ``(k,)``.
        rival: Order 3's curve, one variant; None if it couldn't be worked out.
        draws: The draws that could; None if none could.
        lost: How many draws couldn't.
        sliding: Which way each joint's friction is overcome where its rate is known to differ
            from zero, at all samples of the motion, ``(n, nv)``; None without friction.
        unknown: Friction of which nobody knows whether it counts, at the samples that are
            judged [N·m] or [N], ``(k, motors)``.
    """

    keep: NDArray[np.intp]
    rival: Judged | None
    draws: Judged | None
    lost: int
    sliding: Array | None
    unknown: Array


def drawn(way: Way, extremes: Sequence[int]) -> Drawn | None:
    """Judge the variants of a motion; None if it has none.

    Args:
        way: How it is carried.
        extremes: Samples at which the motion itself has its largest numbers.
    """
    near = near_ways(way, extremes, partial(_torque, way))
    if near is None:
        return None
    found = _judged(way, near.whole, near.good, near.here)
    draws = [one for one in found[1:] if one is not None]
    lost = len(found) - 1 - len(draws)
    return Drawn(near.keep, found[0], stacked(draws), lost, near.sliding, near.unknown)


def _torque(
    way: Way, q: Array, v: Array, a: Array, sliding: Array, rows: NDArray[np.intp]
) -> Array:
    found = inverse_dynamics(
        way.robot, q, v, a, sliding=sliding, precision=way.precision, check=False
    )
    return np.asarray(found.torque)


def judged(way: Way, keep: NDArray[np.intp], pick: NDArray[np.intp]) -> list[Judged | None]:
    """Numbers of some variants at some samples; None for those that can't be worked out.

    Args:
        way: How the motion is carried.
        keep: The samples, shape ``(k,)``.
        pick: Which curve of each column in each variant, ``(curves, variants)``.
    """
    variants = way.motion.variants
    assert variants is not None
    moved = variants.moved(itself(way.motion, keep), since_start(way)[keep], pick)
    *whole, good = near_motions(way.robot, way.whole, keep, moved, way.precision)
    return _judged(way, whole, good, None)


def _judged(
    way: Way, whole: Sequence[Array], good: NDArray[np.bool_], sliding: Array | None
) -> list[Judged | None]:
    found: list[Judged | None] = [None] * len(good)
    alive = np.flatnonzero(good)
    try:
        every = _dynamics(way, [x[alive] for x in whole], sliding) if len(alive) else None
    except ThesisPinError:
        every = None
    for place, k in enumerate(alive):
        if every is not None:
            found[k] = Judged(**{name: x[place : place + 1] for name, x in vars(every).items()})
            continue
        with suppress(ThesisPinError):
            found[k] = _dynamics(way, [x[k : k + 1] for x in whole], sliding)
    return found


def _dynamics(way: Way, whole: Sequence[Array], sliding: Array | None) -> Judged:
    q, v, a = whole
    dynamics = inverse_dynamics(
        way.robot,
        q,
        v,
        a,
        precision=way.precision,
        external=way.external,
        sliding=sliding,
    )
    force = np.linalg.norm(dynamics.force, axis=-1)
    return Judged(dynamics.torque, v[..., way.robot.actuated], force)


def stacked(found: Sequence[Judged]) -> Judged | None:
    """Some variants as one stack; None of none."""
    if not found:
        return None
    names = vars(found[0])
    return Judged(**{name: np.concatenate([getattr(one, name) for one in found]) for name in names})
