"""Why a path's samples carry no verdict, and what they leave open of the numbers."""

from __future__ import annotations

import numpy as np

from pollard_pin.dynamics.variants import Judged, Way, judged
from pollard_pin.report import verdict
from pollard_pin.report.decision import few_draws, within_limits
from pollard_pin.report.numbers import TrajectoryNumbers
from pollard_pin.report.uncertainty.headlines import Headlines
from pollard_pin.specification import ACTUATOR_SYMBOLS
from thesis_pin.errors import ThesisPinError
from thesis_pin.report.resolution import newton_metres, percent
from thesis_pin.report.uncertainty.reason import DRAWS, FEW, culprit, undecided, with_left_open
from thesis_pin.smoothing.resolution import Resolution


def sentences(numbers: TrajectoryNumbers) -> list[str]:
    """The verdict in plain sentences; first why there is none, if there is none."""
    held = numbers.headlines
    if held is None:
        return verdict.sentences(numbers)
    why_not = reason(numbers)
    said = verdict.sentences(numbers, motors=why_not is None)
    return with_left_open(said, why_not, [_left_open(held)])


def reason(numbers: TrajectoryNumbers) -> str | None:
    """Why there is no verdict: what straddles its limit, and what makes most of that."""
    held, variants = numbers.headlines, numbers.path.variants
    if held is None or variants is None or within_limits(numbers) is not None:
        return None
    if few_draws(numbers):
        return FEW
    return undecided(
        {"torque": held.torque_use, "speed": held.speed_use},
        ACTUATOR_SYMBOLS,
        variants.rate,
        lambda name, motor: _culprit(numbers, name, motor),
    )


def _culprit(numbers: TrajectoryNumbers, name: str, motor: int) -> tuple[Resolution, float] | None:
    variants = numbers.path.variants
    assert variants is not None
    values = numbers.torque if name == "torque" else numbers.speed
    sample = int(np.abs(values[:, motor]).argmax())
    here = numbers.motion.part(np.array([sample]))
    tool = variants.one_at_a_time(float(here.time[0]), DRAWS)
    count = len(variants.columns)
    near = np.repeat(here.pose[:, 3:], count * DRAWS, axis=0)
    way = Way(numbers.robot, numbers.branch, numbers.three is not None)
    try:
        found: Judged = judged(way, tool, near, count)
    except ThesisPinError:
        return None
    return culprit(variants.columns, getattr(found, name)[..., motor])


def _left_open(held: Headlines) -> str:
    j = max(range(6), key=lambda k: held.peak_torque[k].value)
    torque, speed = (
        max(range(6), key=lambda k: uses[k].value) for uses in (held.torque_use, held.speed_use)
    )
    return (
        f"The samples' resolution leaves open: peak torque ({ACTUATOR_SYMBOLS[j]}) "
        f"{newton_metres(held.peak_torque[j])}; share of the torque limit "
        f"({ACTUATOR_SYMBOLS[torque]}) {percent(held.torque_use[torque])}; of the speed limit "
        f"({ACTUATOR_SYMBOLS[speed]}) {percent(held.speed_use[speed])}."
    )
