"""Whether samples of finite resolution carry a verdict on a motion, and why not.

A yes or no counts where the whole interval of each number that decides lies on one side of
its limit. Exact motions are decided by their numbers alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.resolution import percent
from thesis_pin.report.torque import verdict
from thesis_pin.report.torque.drawn import Judged, judged
from thesis_pin.report.torque.numbers import TorqueNumbers
from thesis_pin.report.torque.uncertainty import Headlines, shares
from thesis_pin.report.uncertainty import culprit, few_draws, measured, why
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.resolution import Resolution

Array = NDArray[np.float64]

_DRAWS = 8


def within_limits(numbers: TorqueNumbers) -> bool | None:
    """As :func:`thesis_pin.report.torque.verdict.within_limits`; None if samples can't say."""
    held = numbers.headlines
    if held is None:
        return verdict.within_limits(numbers)
    sides = [use.side(1.0) for use in (*held.effort_use, *held.speed_use)]
    if 1 in sides or not verdict.carried(numbers) or numbers.outside:
        return False
    return True if all(side < 0 for side in sides) and not _few(numbers) else None


def sentences(numbers: TorqueNumbers) -> list[str]:
    """The verdict in plain sentences; first why there is none, if there is none."""
    held = numbers.headlines
    if held is None:
        return verdict.sentences(numbers)
    why_not = reason(numbers)
    said = verdict.sentences(numbers, motors=why_not is None)
    if why_not is None:
        return [*said[:1], *_left_open(numbers, held), *said[1:]]
    return [why_not, *_left_open(numbers, held), *said]


def reason(numbers: TorqueNumbers) -> str | None:
    """Why there is no verdict: what straddles its limit, and what makes most of that."""
    held, variants = numbers.headlines, numbers.motion.variants
    if held is None or variants is None or within_limits(numbers) is not None:
        return None
    if _few(numbers):
        return (
            "The samples can't carry a verdict: most motions that they leave open can't be "
            "worked out. Finer samples are needed."
        )
    named: list[tuple[Interval, int, str]] = [
        (one, k, name)
        for name, uses in (("torque", held.effort_use), ("speed", held.speed_use))
        for k, one in enumerate(uses)
        if one.side(1.0) == 0
    ]
    one, k, name = max(named, key=lambda found: found[0].high)
    most = why(_culprit(numbers, name, k), variants.rate, one, 1.0)
    return (
        f"The samples can't carry a verdict: motor {numbers.names[k]} uses {percent(one)} of its "
        f"{name}; {most}."
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
    found = judged(numbers.way, sample, variants.one_at_a_time(_DRAWS))
    alive = [use(one).ravel() for one in found if one is not None]
    if len(alive) < len(found):
        return None
    return culprit(variants.columns, np.array(alive).reshape(len(variants.columns), _DRAWS))


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
