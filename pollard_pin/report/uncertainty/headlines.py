"""Intervals of a report's headline numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pollard_pin.dynamics.variants import Drawn, Judged
from thesis_pin.report.uncertainty.numbers import band, peaks
from thesis_pin.smoothing.intervals import Interval, least_value

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Headlines:
    """Intervals that the samples leave a path's numbers.

    Attributes:
        peak_torque: Largest |τ| of each motor [N·m].
        torque_use, speed_use: Largest share of each motor's limits.
        peak_loop_force: Largest force in each ball joint [N].
        reach: Least reach margin [-].
        time: Of the samples that were judged [s], shape ``(k,)``.
        torque_band: Torques at those times, from and to, ``(2, k, 6)``.
    """

    peak_torque: tuple[Interval, ...]
    torque_use: tuple[Interval, ...]
    speed_use: tuple[Interval, ...]
    peak_loop_force: tuple[Interval, ...]
    reach: Interval
    time: Array
    torque_band: Array


def headlines(own: Judged, drawn: Drawn, time: Array, limits: tuple[Array, Array]) -> Headlines:
    """Work out the intervals of a report.

    Args:
        own: By the path's own curves, one variant, where variants were judged.
        drawn: Its variants, judged.
        time: Of these samples [s].
        limits: Torque [N·m] and speed [rad/s] of each motor, each ``(6,)``.
    """
    rival = own if drawn.rival is None else drawn.rival

    def largest(of: Callable[[Judged], Array], over: Array | float = 1.0) -> tuple[Interval, ...]:
        sizes = (np.abs(of(one)) / over for one in (own, rival, drawn.draws))
        mine, other, draws = sizes
        return tuple(peaks(mine[0], other[0], draws))

    return Headlines(
        peak_torque=largest(lambda one: one.torque),
        torque_use=largest(lambda one: one.torque, limits[0]),
        speed_use=largest(lambda one: one.speed, limits[1]),
        peak_loop_force=largest(lambda one: one.loop_force),
        reach=least_value(
            float(own.reach.min()), float(rival.reach.min()), drawn.draws.reach.min(axis=1)
        ),
        time=time,
        torque_band=band(own.torque[0], rival.torque[0], drawn.draws.torque),
    )
