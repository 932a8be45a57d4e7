"""Motions as probable as the samples of one leave it, and which friction counts in them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.motion.near import near_motions
from thesis_pin.loops.motion.smoothing import itself
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.loops.motion.whole import WholeMotion
from thesis_pin.smoothing.rates import resting

Array = NDArray[np.float64]
Rows = NDArray[np.intp]

SAMPLES = 101
"""Evenly spaced samples at which variants are judged, beside extremes: that bounds the cost."""


@dataclass(frozen=True, eq=False)
class Way:
    """How a motion is carried.

    Attributes:
        robot: The robot.
        motion: The motion of some joints.
        whole: What all joints do in it.
        precision: See :func:`thesis_pin.loops.motion.whole.whole_motion`.
        external: Constant wrenches from outside, see
            :func:`thesis_pin.loops.dynamics.inverse_dynamics`.
    """

    robot: ClosedRobot
    motion: JointMotion
    whole: WholeMotion
    precision: float | None
    external: Mapping[str, Array]


Torque = Callable[[Array, Array, Array, Array, Rows], Array]
"""Configurations, rates, accelerations, directions of friction, samples → the motors' torques."""


@dataclass(frozen=True, eq=False)
class Near:
    """The variants of a motion: order 3's curves first, then draws.

    Attributes:
        keep: Samples of the motion at which they are known, shape ``(k,)``.
        whole: Configurations ``(variants, k, nq)``, rates and accelerations ``(variants, k, nv)``.
        good: Which could be worked out, ``(variants,)``.
        sliding: Which way each joint's friction is overcome where its rate is known to differ
            from zero, at all samples of the motion, ``(n, nv)``; None without friction.
        unknown: Friction of which nobody knows whether it counts, at the samples that are
            known [N·m] or [N], ``(k, motors)``.
    """

    keep: Rows
    whole: tuple[Array, Array, Array]
    good: NDArray[np.bool_]
    sliding: Array | None
    unknown: Array

    @property
    def here(self) -> Array | None:
        """Directions of friction at the samples that are known, ``(k, nv)``."""
        return None if self.sliding is None else self.sliding[self.keep]


def near_ways(way: Way, extremes: Sequence[int], torque: Torque) -> Near | None:
    """Carry the variants of a motion through the robot; None if it has none.

    Args:
        way: How the motion is carried.
        extremes: Samples at which the motion itself has its largest numbers.
        torque: Works torques out, for what friction can add to them.
    """
    variants = way.motion.variants
    if variants is None:
        return None
    last = len(way.motion.time) - 1
    even = np.linspace(0, last, min(last + 1, SAMPLES)).round().astype(np.intp)
    keep = np.union1d(even, np.asarray(extremes, dtype=np.intp))
    moved = variants.moved(itself(way.motion, keep), since_start(way)[keep], variants.others())
    *whole, good = near_motions(way.robot, way.whole, keep, moved, way.precision)
    sliding, unknown = None, np.zeros((len(keep), len(way.robot.actuators)))
    if way.robot.model.upperDryFrictionLimit.any():
        v, rates = way.whole.joints.v, whole[1]
        rival = rates[0] if good[0] else None
        still, creeping = resting(way.motion.time, keep, v, rates[1:][good[1:]], rival)
        sliding = np.where(still, 0.0, np.sign(v))
        unknown = _unknown(way, keep, sliding[keep], creeping[keep], torque)
    return Near(keep, (whole[0], whole[1], whole[2]), good, sliding, unknown)


def since_start(way: Way) -> Array:
    """Times of a motion's samples, from its first on [s], shape ``(n,)``."""
    return np.asarray(way.motion.time - way.motion.time[0])


def _unknown(
    way: Way, keep: Rows, sliding: Array, creeping: NDArray[np.bool_], torque: Torque
) -> Array:
    """What friction of joints that may move either way can add to each motor's torque."""
    joints, total = way.whole.joints, np.zeros((len(keep), len(way.robot.actuators)))
    state = joints.q[keep], joints.v[keep], joints.a[keep]
    rubs = (way.robot.model.upperDryFrictionLimit > 0) & creeping.any(axis=0)
    if not rubs.any():
        return total
    without = torque(*state, sliding, keep)
    for joint in np.flatnonzero(rubs):
        one = sliding.copy()
        one[creeping[:, joint], joint] = 1.0
        total += np.abs(torque(*state, one, keep) - without)
    return total
