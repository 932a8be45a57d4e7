"""Whether a replay did what was planned, criterion by criterion, in words; and why not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from pollard_pin.specification import ACTUATOR_SYMBOLS
from pollard_pin.study.simulate.growth import Growth
from pollard_pin.study.simulate.measures import Measures
from thesis_pin.simulation.tallies import lost_sentences, passed_sentence
from thesis_pin.tolerances import TOLERANCES

Name = Literal["deviation", "turn", "opening", "energy", "saturation"]
"""What is asked of every replay."""

_UNSTABLE = 1e3
"""Factor by which errors have to grow until growth explains why the tool leaves its path."""


@dataclass(frozen=True)
class Criterion:
    """One thing that is asked of a replay.

    Attributes:
        name: What.
        value, limit: In ``unit``.
        unit: Of both; empty for shares.
        met: Whether it is as asked.
        words: How it is, in a sentence, with amount and time.
    """

    name: Name
    value: float
    limit: float
    unit: str
    met: bool
    words: str


def criteria(found: Measures) -> tuple[Criterion, ...]:
    """What is asked of a replay, each with its answer.

    The spray tip is never more than 1 mm off its path, which is gone to its end, the tool turned
    by at most 0.01 rad; ball joints open by 1e-6 m at most; energy closes to 1e-6; no motor is
    at its limit.
    """
    return (_deviation(found), _turn(found), _opening(found), _energy(found), _saturation(found))


def sentences(found: Measures, duration: float) -> list[str]:
    """What of a replay isn't as asked, and where it ends early.

    Args:
        found: The replay.
        duration: Of its path [s].
    """
    when, why = found.ended
    ending = [f"The replay ends at t = {when:.3f} s of {duration:g} s: {why}."] if why else []
    return [*ending, *(one.words for one in criteria(found) if not one.met)]


def reason(found: Measures, grown: Growth, slope: float | None, held: bool) -> str | None:
    """Why the tool leaves its path, where errors that grow explain it; else None.

    Where a motor is at its limit that is the reason, and the growth another one.

    Args:
        found: The replay.
        grown: Growth of errors along its plan.
        slope: Rate at which its deviation was seen to grow [1/s].
        held: Whether there are servos.
    """
    if found.left is None or found.saturated.any() or grown.factor[-1] < np.log(_UNSTABLE):
        return None
    each = grown.time[-1] / grown.factor[-1]
    text = (
        f"The reason: {'these servos are too soft' if held else 'nothing is there'} to correct "
        "errors, and this motion lets them grow, as a pendulum on its head does; by the linearised "
        f"mechanism by a factor of e each {each:.3f} s, by "
        f"10^{grown.factor[-1] / np.log(10):.0f} over the path"
    )
    if slope is not None:
        text += f" (seen: a factor of e each {1 / slope:.3f} s)"
    horizon = grown.horizon(TOLERANCES.replay_deviation)
    if horizon is not None:
        text += (
            f". Even the rounding of numbers of 16 digits becomes a millimetre in {horizon:.1f} s, "
            "so that no engine follows longer than that"
        )
    end = "Stiffer ones end it." if held else "Servos end it: give their stiffness."
    return f"{text}. {end}"


def draws_sentences(every: Sequence[Measures]) -> Iterator[str]:
    """How many of several robots do what was planned."""
    tries = [criteria(found) for found in every]
    yield passed_sentence(tries)
    yield from lost_sentences(tries, _LOST)
    deviation = np.array([one.deviation[0] for one in every]) * 1e3
    yield (
        f"Their tools leave the path by {np.median(deviation):.3g} mm in the median, by "
        f"{deviation.max():.3g} mm at most."
    )


_LOST: dict[str, str] = {
    "deviation": "how far the tool is off its path",
    "turn": "how far the tool is turned",
    "opening": "ball joints that open",
    "energy": "energy that doesn't close",
    "saturation": "motors at their limit",
}


def _deviation(found: Measures) -> Criterion:
    (value, time), limit = found.deviation, TOLERANCES.replay_deviation
    met = value <= limit and not found.ended[1]
    if found.left is not None:
        words = (
            f"The spray tip leaves its path by {limit * 1e3:g} mm at t = {found.left:.3f} s, by "
            f"{value * 1e3:.3g} mm at most (t = {time:.3f} s)."
        )
    elif met:
        words = f"The spray tip stays within {value * 1e3:.3g} mm of its path (t = {time:.3f} s)."
    else:
        words = "The spray tip doesn't get to the end of its path."
    return Criterion("deviation", value, limit, "m", met, words)


def _turn(found: Measures) -> Criterion:
    (value, time), limit = found.turn, TOLERANCES.replay_turn
    met = value <= limit
    words = (
        f"The tool turns {'at most' if met else 'up to'} {np.degrees(value):.3g}° from its planned "
        f"orientation (t = {time:.3f} s)"
    )
    return Criterion(
        "turn",
        value,
        limit,
        "rad",
        met,
        f"{words}." if met else f"{words}; allowed: {np.degrees(limit):.2g}°.",
    )


def _opening(found: Measures) -> Criterion:
    (value, time), limit = found.opening, TOLERANCES.replay_opening
    met = value <= limit
    words = f"The ball joints {'open by at most' if met else 'open by'} {value:.1e} m"
    words = f"{words} (t = {time:.3f} s)"
    allowed = f"; allowed: {limit:.0e} m. Take shorter steps."
    return Criterion("opening", value, limit, "m", met, f"{words}." if met else words + allowed)


def _energy(found: Measures) -> Criterion:
    value, limit = found.energy_error, TOLERANCES.replay_energy
    met = value <= limit
    words = (
        f"The motors' work and the change of kinetic and potential energy differ by {value:.1e} of "
        f"the {found.exchanged:.3g} J exchanged"
    )
    allowed = f"; allowed: {limit:.0e}. Take shorter steps."
    return Criterion("energy", value, limit, "", met, f"{words}." if met else words + allowed)


def _saturation(found: Measures) -> Criterion:
    motor = int(found.saturated.argmax())
    share = float(found.saturated[motor])
    if not share:
        return Criterion("saturation", 0.0, 0.0, "", True, "No motor reaches its largest torque.")
    words = f"{ACTUATOR_SYMBOLS[motor]} is at its largest torque {share:.2%} of the time."
    return Criterion("saturation", share, 0.0, "", False, words)
