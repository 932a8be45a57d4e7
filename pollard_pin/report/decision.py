"""Whether samples of finite resolution carry a verdict, and which.

A yes or no counts where the whole interval of each number that decides lies on one side of
its limit. Exact paths are decided by their numbers alone.
"""

from __future__ import annotations

from pollard_pin.report import verdict
from pollard_pin.report.numbers import TrajectoryNumbers


def within_limits(numbers: TrajectoryNumbers) -> bool | None:
    """As the verdict's :func:`within_limits`; None where the samples can't say."""
    held = numbers.headlines
    if held is None:
        return verdict.within_limits(numbers)
    from thesis_pin.report.uncertainty import numbers as uncertainty

    return uncertainty.within((*held.torque_use, *held.speed_use), few_draws(numbers))


def few_draws(numbers: TrajectoryNumbers) -> bool:
    """Whether most motions that the samples leave open can't be worked out."""
    drawn = numbers.drawn
    if drawn is None:
        return False
    from thesis_pin.report.uncertainty import numbers as uncertainty

    return uncertainty.few_draws(drawn.lost, len(drawn.draws.torque))
