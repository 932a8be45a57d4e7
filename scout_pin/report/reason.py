"""Why a gait's samples carry no verdict, and what they leave open of the numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scout_pin.dynamics.variants import Judged
from scout_pin.motion.variants import Variants
from scout_pin.report import verdict
from scout_pin.report.decision import can_walk, few_draws, servos_carry, within_limits
from scout_pin.report.numbers import GaitNumbers
from scout_pin.report.uncertainty.blame import blame
from scout_pin.report.uncertainty.headlines import Headlines
from scout_pin.specification import JOINT_NAMES
from thesis_pin.report.resolution import millimetres, newton_metres, percent
from thesis_pin.report.uncertainty.reason import FEW, no_verdict, why, with_left_open
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.resolution import Resolution

Array = NDArray[np.float64]


def sentences(numbers: GaitNumbers) -> list[str]:
    """The verdict in plain sentences; first why there is none, if there is none."""
    held = numbers.headlines
    if held is None:
        return verdict.sentences(numbers)
    walks, carried = can_walk(numbers) is not None, servos_carry(numbers) is not None
    said = verdict.sentences(numbers, walking=walks, servos=carried)
    why_not = reason(numbers)
    return with_left_open(said, why_not, [_left_open(numbers, held)])


def reason(numbers: GaitNumbers) -> str | None:
    """Why there is no verdict: what straddles its limit, and what makes most of that."""
    held, variants = numbers.headlines, numbers.gait.variants
    if held is None or variants is None or within_limits(numbers) is not None:
        return None
    if few_draws(numbers):
        return FEW
    found, rate = _straddling(numbers, held), variants.rate / numbers.time_unit
    most = why(_culprit(numbers, variants, found), rate, found.held, found.limit)
    return no_verdict(found.text, most)


def _left_open(numbers: GaitNumbers, held: Headlines) -> str:
    peak, use = numbers.actuators.peak_torque, numbers.servo_use
    j, k = int(np.argmax(peak)), int(np.argmax(use))
    worst, last = int(numbers.margin.argmin()), len(numbers.margin) - 1
    end = {0: " (worst at the start, where", last: " (worst at the end, where"}.get(worst, "")
    end += " samples say least)" if end else ""
    return (
        f"The samples' resolution leaves open: margin {millimetres(held.margin)}{end}; peak torque "
        f"({JOINT_NAMES[j]}) {newton_metres(held.peak_torque[j])}; torque-speed line "
        f"({JOINT_NAMES[k]}) {percent(held.servo_use[k])}."
    )


@dataclass(frozen=True)
class _Straddling:
    """A number whose interval holds its limit.

    Attributes:
        text: The number and its interval.
        held: The interval.
        limit: The limit.
        sample: Where it is worst.
        of: The number of what was judged.
    """

    text: str
    held: Interval
    limit: float
    sample: int
    of: Callable[[Judged], Array]


def _straddling(numbers: GaitNumbers, held: Headlines) -> _Straddling:
    dynamics = numbers.dynamics
    if can_walk(numbers) is not None:
        return _servo(numbers, held)
    if held.margin.side(0.0) == 0:
        sample = int(numbers.margin.argmin())
        text = f"the margin is {millimetres(held.margin)}"
        return _Straddling(text, held.margin, 0.0, sample, lambda one: one.margin)
    if held.contact is not None and held.contact.side(0.0) == 0:
        single = np.where(dynamics.support, dynamics.contact_margin, np.inf).min(axis=1)
        text = f"the standing foot's wrench lies {newton_metres(held.contact)}, inside its cone"
        sample = int(single.argmin())
        return _Straddling(text, held.contact, 0.0, sample, lambda one: one.contact)
    sample = int(np.nan_to_num(dynamics.double_violation).argmax())
    text = f"two feet lack {newton_metres(held.violation)}, of the wrench they need"
    return _Straddling(text, held.violation, 0.0, sample, lambda one: one.violation)


def _servo(numbers: GaitNumbers, held: Headlines) -> _Straddling:
    uses = numbers.servo_use
    open_ = [k for k, one in enumerate(held.servo_use) if one.side(1.0) == 0]
    k = max(open_, key=lambda joint: float(uses[joint]))
    stall, free = numbers.robot.stall_torque[k], numbers.robot.no_load_speed[k]

    def use(torque: Array, speed: Array) -> Array:
        return np.asarray(np.abs(torque[..., k]) / stall + np.abs(speed[..., k]) / free)

    return _Straddling(
        f"the servo of {JOINT_NAMES[k]} uses {percent(held.servo_use[k])} of its line",
        held.servo_use[k],
        1.0,
        int(use(numbers.dynamics.torque, numbers.joints.v).argmax()),
        lambda one: use(one.torque, one.speed),
    )


def _culprit(
    numbers: GaitNumbers, variants: Variants, found: _Straddling
) -> tuple[Resolution, float] | None:
    here = np.array([found.sample])
    motion, joints = numbers.motion.part(here), numbers.joints.part(here)
    return blame(numbers.robot, variants, motion, joints, numbers.time_unit, found.of)
