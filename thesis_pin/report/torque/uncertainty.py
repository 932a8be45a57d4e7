"""Intervals that samples of finite resolution leave a torque report's numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.motion.variants import Variants
from thesis_pin.report.tables import Table
from thesis_pin.report.torque.drawn import Drawn, Judged
from thesis_pin.report.uncertainty import document
from thesis_pin.report.uncertainty.numbers import band, peaks
from thesis_pin.smoothing.intervals import Interval

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Headlines:
    """Intervals that the samples leave a motion's numbers.

    Attributes:
        peak_torque: Largest |τ| of each motor [N·m] or [N].
        effort_use, speed_use: Largest share of each motor's limits; 0 without one.
        peak_loop_force: Largest force in each loop [N].
        time: Of the samples that were judged [s], shape ``(k,)``.
        torque_band: Torques at those times, from and to, ``(2, k, motors)``.
    """

    peak_torque: tuple[Interval, ...]
    effort_use: tuple[Interval, ...]
    speed_use: tuple[Interval, ...]
    peak_loop_force: tuple[Interval, ...]
    time: Array
    torque_band: Array


def shares(torque: Array, limits: Array) -> Array:
    """Share of the torque limits in use, ``(..., motors)``; 0 without a limit.

    Args:
        torque: [N·m] or [N], shape ``(..., motors)``.
        limits: Least and greatest torque of each motor, shape ``(2, motors)``; ±∞ without.
    """
    least, most = limits
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(torque >= 0, torque / most, torque / least)
    return np.asarray(np.nan_to_num(share, nan=0.0, posinf=np.inf))


def headlines(own: Judged, drawn: Drawn, time: Array, limits: tuple[Array, Array]) -> Headlines:
    """Work out the intervals of a report.

    Args:
        own: By the motion's own curves, one variant, where variants were judged.
        drawn: Its variants, judged.
        time: Of these samples [s].
        limits: Torques ``(2, motors)`` and speeds ``(motors,)`` that motors reach.
    """
    rival = own if drawn.rival is None else drawn.rival
    draws = own if drawn.draws is None else drawn.draws
    every, friction = (own, rival, draws), drawn.unknown

    def largest(values: Sequence[Array], more: Array | float = 0.0) -> tuple[Interval, ...]:
        mine, other, each = values
        return tuple(peaks(mine[0], other[0], each, more))

    return Headlines(
        peak_torque=largest([np.abs(one.torque) for one in every], friction),
        effort_use=largest(
            [shares(one.torque, limits[0]) for one in every],
            np.maximum(shares(friction, limits[0]), shares(-friction, limits[0])),
        ),
        speed_use=largest([np.abs(one.speed) / limits[1] for one in every]),
        peak_loop_force=largest([one.loop_force for one in every]),
        time=time,
        torque_band=band(own.torque[0], rival.torque[0], draws.torque, friction),
    )


def uncertainty(
    held: Headlines | None, drawn: Drawn | None, variants: Variants | None
) -> dict[str, object] | None:
    """Intervals of a report's numbers, JSON-ready; None of exact motions.

    Args:
        held: The intervals.
        drawn: What was judged.
        variants: What the samples left open.
    """
    if held is None or drawn is None or variants is None:
        return None
    return document.open_document(
        {
            "peak_torque": held.peak_torque,
            "effort_use": held.effort_use,
            "speed_use": held.speed_use,
            "peak_loop_force": held.peak_loop_force,
        },
        variants,
        (0 if drawn.draws is None else len(drawn.draws.torque), drawn.lost),
        held.time,
        {"torque": held.torque_band},
    )


def open_table(held: Headlines, names: Sequence[str]) -> Table:
    """Between which values each motor's peak torque and its share of the limit lie."""
    return document.open_table(
        ("motor", names),
        ("peak", held.peak_torque, ".4g"),
        ("of limit", held.effort_use),
        unlimited=True,
    )
