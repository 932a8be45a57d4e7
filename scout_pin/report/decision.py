"""Whether samples of finite resolution carry a verdict, and which.

A yes or no counts where the whole interval of each number that decides lies on one side of
its limit. Exact gaits are decided by their numbers alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from scout_pin.report import verdict
from scout_pin.report.numbers import GaitNumbers
from thesis_pin.tolerances import TOLERANCES

if TYPE_CHECKING:  # exact gaits leave nothing open
    from scout_pin.report.uncertainty.headlines import Headlines


def can_walk(numbers: GaitNumbers) -> bool | None:
    """As :func:`scout_pin.report.verdict.can_walk`; None where the samples can't say."""
    found, held = verdict.can_walk(numbers), numbers.headlines
    if held is None:
        return found
    if falls(held) or not verdict.feet_and_rates(numbers):
        return False
    return None if few_draws(numbers) or not stands(held) else found


def servos_carry(numbers: GaitNumbers) -> bool | None:
    """As :func:`scout_pin.report.verdict.servos_carry`; None where the samples can't say."""
    held = numbers.headlines
    if held is None:
        return verdict.servos_carry(numbers)
    from thesis_pin.report.uncertainty import numbers as uncertainty

    return uncertainty.within(held.servo_use, few_draws(numbers))


def within_limits(numbers: GaitNumbers) -> bool | None:
    """Both; None where neither is no and one is open."""
    both = can_walk(numbers), servos_carry(numbers)
    if False in both:
        return False
    return None if None in both else True


def falls(held: Headlines) -> bool:
    """Whether, whatever the samples leave open, the floor can't supply what it has to."""
    return (
        held.margin.high < 0
        or (held.contact is not None and held.contact.high < -TOLERANCES.wrench)
        or held.violation.low > TOLERANCES.wrench
    )


def stands(held: Headlines) -> bool:
    """Whether, whatever the samples leave open, the floor can supply it."""
    return (
        held.margin.low > 0
        and (held.contact is None or held.contact.low >= 0)
        and held.violation.high <= TOLERANCES.wrench
    )


def few_draws(numbers: GaitNumbers) -> bool:
    """Whether most motions that the samples leave open can't be worked out."""
    drawn = numbers.drawn
    if drawn is None:
        return False
    from thesis_pin.report.uncertainty import numbers as uncertainty

    return uncertainty.few_draws(drawn.lost, len(drawn.draws.margin))
