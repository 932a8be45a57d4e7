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
from thesis_pin.report.torque.drawn import Drawn, Judged, stacked
from thesis_pin.report.torque.nearby import Way, near_ways
from thesis_pin.report.uncertainty.numbers import few_draws
from thesis_pin.smoothing.intervals import SPREAD, Interval, largest_value
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
        speed: Of each foot while it bears load [m/s], ``(k, feet)``; NaN else.
        motors: Torques, speeds and loop forces, one variant.
    """

    margin: Array
    violation: float
    speed: Array
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
    def loose(self) -> Array | None:
        """What the samples leave open of each foot's speed while it bears load [m/s]."""
        if len(self.draws) < 2:
            return None
        apart = SPREAD * np.std([one.speed for one in self.draws], axis=0, ddof=1)
        known = np.isfinite(apart)
        mean = np.nansum(apart**2, axis=0) / np.maximum(known.sum(axis=0), 1)
        return np.asarray(np.sqrt(mean))

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
    near = near_ways(way, extremes, lambda *motion: judge(*motion).torque)
    if near is None:
        return None
    found: list[JudgedBalance | None] = [None] * len(near.good)
    for k in np.flatnonzero(near.good).tolist():
        q, v, a = (x[k] for x in near.whole)
        with suppress(ThesisPinError):
            found[k] = _judged(judge(q, v, a, near.here, near.keep), v[:, way.robot.actuated])
    rival, draws = found[0], tuple(one for one in found[1:] if one is not None)
    lost = len(found) - 1 - len(draws)
    own, motors = None if rival is None else rival.motors, stacked([one.motors for one in draws])
    every = Drawn(near.keep, own, motors, lost, near.sliding, near.unknown)
    return DrawnBalance(rival, draws, lost, every)


def _judged(dynamics: FootDynamics, speed: Array) -> JudgedBalance:
    force = np.linalg.norm(dynamics.loops.force, axis=-1)
    motors = Judged(dynamics.torque[None], speed[None], force[None])
    feet = np.where(dynamics.support, dynamics.stance.speed, np.nan)
    return JudgedBalance(dynamics.margin, float(dynamics.violation.max()), feet, motors)
