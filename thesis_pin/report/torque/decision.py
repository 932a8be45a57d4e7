"""Whether samples of finite resolution carry a verdict on a motion, and why not.

A yes or no counts where the whole interval of each number that decides lies on one side of
its limit. Exact motions are decided by their numbers alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.resolution import measured, percent
from thesis_pin.report.torque import verdict
from thesis_pin.report.torque.drawn import Judged, judged
from thesis_pin.report.torque.numbers import TorqueNumbers
from thesis_pin.report.torque.uncertainty import Headlines, shares
from thesis_pin.report.uncertainty.numbers import few_draws, within
from thesis_pin.report.uncertainty.reason import DRAWS, FEW, culprit, undecided, with_left_open
from thesis_pin.smoothing.resolution import Resolution

Array = NDArray[np.float64]


def within_limits(numbers: TorqueNumbers) -> bool | None:
    """As :func:`thesis_pin.report.torque.verdict.within_limits`; None if samples can't say."""
    held = numbers.headlines
    if held is None:
        return verdict.within_limits(numbers)
    if not verdict.carried(numbers) or numbers.outside:
        return False
    return within((*held.effort_use, *held.speed_use), _few(numbers))


def sentences(numbers: TorqueNumbers) -> list[str]:
    """The verdict in plain sentences; first why there is none, if there is none."""
    held = numbers.headlines
    if held is None:
        return verdict.sentences(numbers)
    why_not = reason(numbers)
    said = verdict.sentences(numbers, motors=why_not is None)
    return with_left_open(said, why_not, _left_open(numbers, held))


def reason(numbers: TorqueNumbers) -> str | None:
    """Why there is no verdict: what straddles its limit, and what makes most of that."""
    held, variants = numbers.headlines, numbers.motion.variants
    if held is None or variants is None or within_limits(numbers) is not None:
        return None
    if _few(numbers):
        return FEW
    return undecided(
        {"torque": held.effort_use, "speed": held.speed_use},
        [f"motor {name}" for name in numbers.names],
        variants.rate,
        lambda name, motor: _culprit(numbers, name, motor),
    )


def _few(numbers: TorqueNumbers) -> bool:
    drawn = numbers.drawn
    if drawn is None:
        return False
    return few_draws(drawn.lost, 0 if drawn.draws is None else len(drawn.draws.torque))


def _culprit(numbers: TorqueNumbers, name: str, motor: int) -> tuple[Resolution, float] | None:
    variants = numbers.motion.variants
    assert variants is not None

    def use(one: Judged) -> Array:
        if name == "torque":
            return shares(one.torque, numbers.effort_limits)[..., motor]
        return np.asarray(np.abs(one.speed)[..., motor])

    own = Judged(numbers.dynamics.torque, numbers.speed, numbers.loop_force_size)
    sample = np.array([int(use(own).argmax())])
    found = judged(numbers.way, sample, variants.one_at_a_time(DRAWS))
    alive = [use(one).ravel() for one in found if one is not None]
    if len(alive) < len(found):
        return None
    return culprit(variants.columns, np.array(alive).reshape(len(variants.columns), DRAWS))


def _left_open(numbers: TorqueNumbers, held: Headlines) -> list[str]:
    if not held.peak_torque:
        return []
    j = max(range(len(held.peak_torque)), key=lambda k: held.peak_torque[k].value)
    peak = measured(held.peak_torque[j], numbers.units[j], ".4g")
    said = f"The samples' resolution leaves open: peak of motor {numbers.names[j]} {peak}"
    uses = [
        (f"share of the {name} limit", one, numbers.names[k])
        for name, some in (("torque", held.effort_use), ("speed", held.speed_use))
        for k, one in enumerate(some)
        if one.high > 0
    ]
    if uses:
        what, one, name = max(uses, key=lambda use: use[1].value)
        said += f"; {what} of {name} {percent(one)}"
    return [said + "."]
