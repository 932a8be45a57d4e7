"""What the samples of a motion leave open, carried through contacts: other motions, judged."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.result import FootDynamics
from thesis_pin.contacts.balance.sharing import tolerance
from thesis_pin.errors import ThesisPinError
from thesis_pin.loops.motion.near import near_motions
from thesis_pin.loops.motion.smoothing import itself
from thesis_pin.report.torque.drawn import SAMPLES, Drawn, Judged, Way
from thesis_pin.report.uncertainty.numbers import few_draws
from thesis_pin.smoothing.intervals import Interval, largest_value
from thesis_pin.smoothing.rates import resting
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]


def border(found: FootDynamics) -> float:
    """What may be missing of the floor's wrench in a verdict [N·m]."""
    return max(tolerance(found.scale), TOLERANCES.balance * found.scale / found.length)


Judge = Callable[[Array, Array, Array, Array | None, NDArray[np.intp]], FootDynamics]
"""Configurations, rates, accelerations, directions of friction, samples → contact forces."""


@dataclass(frozen=True, eq=False)
class JudgedBalance:
    """One motion beside the report's own, at some of its samples.

    Attributes:
        margin: Of the zero-moment point [m], shape ``(k,)``.
        violation: Largest part of its load that the floor can't give [N·m].
        motors: Torques, speeds and loop forces, one variant.
    """

    margin: Array
    violation: float
    motors: Judged


@dataclass(frozen=True, eq=False)
class DrawnBalance:
    """Motions as probable as the samples leave them.

    Attributes:
        rival: Order 3's curve; None if it couldn't be worked out.
        draws: Those that could.
        lost: How many couldn't.
        motors: The same for the motors' report.
    """

    rival: JudgedBalance | None
    draws: tuple[JudgedBalance, ...]
    lost: int
    motors: Drawn

    def violation(self, own: float) -> Interval:
        """Between which values the largest violation lies [N·m]; own is the motion's."""
        rival = own if self.rival is None else self.rival.violation
        return largest_value(own, rival, np.array([one.violation for one in self.draws]))

    @property
    def few(self) -> bool:
        """Whether too few could be worked out to decide anything."""
        return few_draws(self.lost, len(self.draws))


def drawn(way: Way, extremes: list[int], judge: Judge) -> DrawnBalance | None:
    """Judge the variants of a motion; None if it has none.

    Args:
        way: How the motion is carried.
        extremes: Samples at which the motion itself has its largest numbers.
        judge: Works a motion out, at some samples.
    """
    variants = way.motion.variants
    if variants is None:
        return None
    last = len(way.motion.time) - 1
    even = np.linspace(0, last, min(last + 1, SAMPLES)).round().astype(np.intp)
    keep = np.union1d(even, np.asarray(extremes, dtype=np.intp))
    time = np.asarray(way.motion.time - way.motion.time[0])
    moved = variants.moved(itself(way.motion, keep), time[keep], variants.others())
    *whole, good = near_motions(way.robot, way.whole, keep, moved, way.precision)
    sliding, unknown = None, np.zeros((len(keep), len(way.robot.actuators)))
    if way.robot.model.upperDryFrictionLimit.any():
        v, rates = way.whole.joints.v, whole[1]
        rival = rates[0] if good[0] else None
        still, creeping = resting(way.motion.time, keep, v, rates[1:][good[1:]], rival)
        sliding = np.where(still, 0.0, np.sign(v))
        unknown = _unknown(way, keep, sliding[keep], creeping[keep], judge)
    here = None if sliding is None else sliding[keep]
    found: list[JudgedBalance | None] = [None] * len(good)
    for k in np.flatnonzero(good).tolist():
        with suppress(ThesisPinError):
            dynamics = judge(whole[0][k], whole[1][k], whole[2][k], here, keep)
            speed = whole[1][k][:, way.robot.actuated]
            found[k] = _judged(dynamics, speed)
    draws = tuple(one for one in found[1:] if one is not None)
    motors = [one.motors for one in draws]
    stacked = None
    if motors:
        names = vars(motors[0])
        stacked = Judged(
            **{name: np.concatenate([getattr(one, name) for one in motors]) for name in names}
        )
    lost, rival_of = len(found) - 1 - len(draws), found[0]
    own = None if rival_of is None else rival_of.motors
    return DrawnBalance(rival_of, draws, lost, Drawn(keep, own, stacked, lost, sliding, unknown))


def _judged(dynamics: FootDynamics, speed: Array) -> JudgedBalance:
    force = np.linalg.norm(dynamics.loops.force, axis=-1)
    motors = Judged(dynamics.torque[None], speed[None], force[None])
    return JudgedBalance(dynamics.margin, float(dynamics.violation.max()), motors)


def _unknown(
    way: Way, keep: NDArray[np.intp], sliding: Array, creeping: NDArray[np.bool_], judge: Judge
) -> Array:
    """What friction of joints that may move either way can add to each motor's torque."""
    joints, total = way.whole.joints, np.zeros((len(keep), len(way.robot.actuators)))
    state = joints.q[keep], joints.v[keep], joints.a[keep]
    rubs = (way.robot.model.upperDryFrictionLimit > 0) & creeping.any(axis=0)
    if not rubs.any():
        return total
    without = judge(*state, sliding, keep).torque
    for joint in np.flatnonzero(rubs):
        one = sliding.copy()
        one[creeping[:, joint], joint] = 1.0
        total += np.abs(judge(*state, one, keep).torque - without)
    return total
