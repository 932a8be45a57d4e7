"""Intervals of a report's headline numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scout_pin.dynamics.variants import Drawn, Judged, judged, lowest_corners
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.motion.variants import Variants
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.errors import ThesisPinError
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.report.uncertainty.numbers import band
from thesis_pin.smoothing.intervals import Interval, largest_value, least_value

Array = NDArray[np.float64]

_MARGIN = 5e-5  # what the grid of samples may miss of a margin [m]
_PEAK = 1e-3  # and of a peak, relative


@dataclass(frozen=True)
class Headlines:
    """Intervals that the samples leave a gait's numbers.

    Attributes:
        margin: Least margin of the ZMP [m].
        peak_torque: Largest |τ| of each joint [N·m].
        servo_use: Worst use of each servo's torque-speed line.
        contact: Least distance of a single standing foot's wrench inside its cone [N·m];
            None without single support.
        violation: Largest wrench that double support misses [N·m].
        friction_used: Largest share of friction in use.
        lowest: Height of a swinging sole's lowest corner [m]; None if no foot swings.
        time: Of the samples that were judged [s], shape ``(k,)``.
        margin_band: Margins at those times, from and to, ``(2, k)``.
        torque_band: The same of the torques, ``(2, k, 12)``.
    """

    margin: Interval
    peak_torque: tuple[Interval, ...]
    servo_use: tuple[Interval, ...]
    contact: Interval | None
    violation: Interval
    friction_used: Interval
    lowest: Interval | None
    time: Array
    margin_band: Array
    torque_band: Array


@dataclass(frozen=True)
class Worked:
    """What the gait's own curves gave.

    Attributes:
        robot: The biped.
        motion: Sampled motion.
        joints: Joint trajectory.
        dynamics: Torques and floor wrenches.
        margin: Margins of the ZMP [m], shape ``(n,)``.
    """

    robot: Scout
    motion: GaitMotion
    joints: JointTrajectory
    dynamics: ContactDynamics
    margin: Array


def headlines(numbers: Worked, drawn: Drawn, variants: Variants) -> Headlines:
    """Work out the intervals of a report.

    Args:
        numbers: By the gait's own curves.
        drawn: Its variants, judged.
        variants: What they are.
    """
    own = _own(numbers, drawn)
    rival = own if drawn.rival is None else drawn.rival
    other, agreed = _other_support(numbers, drawn, variants, own)
    robot = numbers.robot
    creeping = drawn.creeping[drawn.keep]
    coulomb = robot.specification.assumptions.joint_friction.coulomb
    slack = np.where(creeping, coulomb, 0.0)
    stall, free = robot.stall_torque, robot.no_load_speed

    def size(one: Judged) -> Array:
        return np.abs(one.torque)

    def use(one: Judged) -> Array:
        return np.asarray(np.abs(one.torque) / stall + np.abs(one.speed) / free)

    def peaks(of: Callable[[Judged], Array], more: Array) -> tuple[Interval, ...]:
        value, beside = of(own)[0].max(axis=0), of(rival)[0].max(axis=0)
        most = np.maximum((of(own)[0] + more).max(axis=0), (of(other)[0] + more).max(axis=0))
        least = of(own)[0][agreed].max(axis=0)
        each = of(drawn.draws).max(axis=1)
        bounds = zip(value, beside, each.T, least, most, strict=True)
        return tuple(
            largest_value(float(v), float(r), d, float(a), float(b), slack=_PEAK)
            for v, r, d, a, b in bounds
        )

    def lowest(of: Callable[[Judged], Array], slack: float) -> Interval:
        value, least = float(of(own).min()), float(of(other).min())
        known = float(of(own)[0][agreed].min())
        each = of(drawn.draws).min(axis=1)
        return least_value(
            value, float(of(rival).min()), each, min(value, least), known, slack=slack
        )

    def highest(of: Callable[[Judged], Array]) -> Interval:
        value, known = float(of(own).max()), float(of(own)[0][agreed].max())
        each, most = of(drawn.draws).max(axis=1), max(value, float(of(other).max()))
        return largest_value(value, float(of(rival).max()), each, known, most, slack=_PEAK)

    swings = bool(np.isfinite(own.lowest[0][agreed]).any())
    single = bool(np.isfinite(own.contact[0][agreed]).any())
    return Headlines(
        margin=lowest(lambda one: one.margin, _MARGIN),
        peak_torque=peaks(size, slack),
        servo_use=peaks(use, slack / stall),
        contact=lowest(lambda one: one.contact, 0.0) if single else None,
        violation=highest(lambda one: one.violation),
        friction_used=highest(lambda one: one.friction_used),
        lowest=lowest(lambda one: one.lowest, 0.0) if swings else None,
        time=numbers.joints.time[drawn.keep],
        margin_band=band(own.margin[0], rival.margin[0], drawn.draws.margin),
        torque_band=band(own.torque[0], rival.torque[0], drawn.draws.torque, slack),
    )


def _own(numbers: Worked, drawn: Drawn) -> Judged:
    """The gait's own numbers where the variants were judged; its extremes are among them."""
    keep, dynamics = drawn.keep, numbers.dynamics.part(drawn.keep)
    double = dynamics.support.all(axis=1)
    single = np.where(dynamics.support, dynamics.contact_margin, np.inf).min(axis=1)
    values = {
        "torque": dynamics.torque,
        "speed": numbers.joints.part(keep).v,
        "margin": numbers.margin[keep],
        "contact": np.where(double, np.inf, single),
        "violation": np.where(double, dynamics.double_violation, 0.0),
        "friction_used": np.nan_to_num(dynamics.friction_used, nan=0.0).max(axis=1),
        "lowest": lowest_corners(numbers.robot, numbers.motion.part(keep)),
    }
    return Judged(**{name: value[None] for name, value in values.items()})


def _other_support(
    numbers: Worked, drawn: Drawn, variants: Variants, own: Judged
) -> tuple[Judged, NDArray[np.bool_]]:
    """The same where contact changes between two rows, had it changed at the other one.

    Returns:
        The numbers, and the samples at which the rows leave no doubt about who stands.
    """
    motion = numbers.motion.part(drawn.keep)
    support = variants.other_support(motion.t, motion.support)
    doubtful = np.flatnonzero((support != motion.support).any(axis=1))
    agreed = np.ones(len(drawn.keep), dtype=bool)
    agreed[doubtful] = False
    if not doubtful.size or not agreed.any():
        return own, np.ones(len(agreed), dtype=bool)
    part = replace(motion.part(doubtful), support=support[doubtful])
    try:
        found = judged(numbers.robot, part, numbers.joints.part(drawn.keep[doubtful]), 1)
    except ThesisPinError:
        return own, agreed
    merged = {}
    for name, values in vars(own).items():
        merged[name] = values.copy()
        merged[name][:, doubtful] = getattr(found, name)
    return Judged(**merged), agreed
