"""Whether a try kept to its plan, criterion by criterion, in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from scout_pin.specification import JOINT_NAMES
from scout_pin.study.simulate.measures import Measures
from thesis_pin.simulation.tallies import lost_sentences, passed_sentence
from thesis_pin.tolerances import TOLERANCES

Name = Literal["distance", "heading", "slip", "upright", "torque", "soles"]
"""What is asked of every try."""


@dataclass(frozen=True)
class Criterion:
    """One thing that is asked of a try.

    Attributes:
        name: What.
        met: Whether it is as asked.
        words: How it is, in a sentence, with amount and time.
    """

    name: Name
    met: bool
    words: str


def criteria(found: Measures) -> tuple[Criterion, ...]:
    """What is asked of a try, each with its answer.

    The distance is the planned one within 5 %, or none within 2 mm; the heading within 5°; no
    standing foot slips by more than 1 mm a step; the torso tips by at most 10° from the plan; no
    servo ever gives all it has; and the soles don't touch each other.
    """
    return (
        _distance(found),
        _heading(found),
        _slip(found),
        _upright(found),
        _torque(found),
        _soles(found),
    )


def sentences(found: Measures) -> list[str]:
    """What a try is told of: first what isn't as asked, then what it stumbles over."""
    said = [one.words for one in criteria(found) if not one.met]
    stumble = found.stumble
    if stumble is not None:
        said.append(
            f"The {stumble.side} foot bears {stumble.load:.2f} N at t = {stumble.time:.3g} s, "
            f"where the plan has it {stumble.height * 1e3:.1f} mm above the floor."
        )
    return said


def _distance(found: Measures) -> Criterion:
    turns = abs(found.planned_turn) > TOLERANCES.walked_heading
    if found.stays:
        met = abs(found.distance) <= TOLERANCES.walked_place
        stays = "turns in its place" if turns else "stays in its place"
        return Criterion(
            "distance",
            met,
            f"It {stays if met else 'leaves its place'}: it strays by "
            f"{abs(found.distance) * 1e3:.2f} mm.",
        )
    share, whither = found.distance / found.planned_distance, "far"
    if turns:
        side = "left" if found.planned_turn > 0 else "right"
        whither = f"far, round to the {side}"
    met = abs(share - 1) <= TOLERANCES.walked_share
    return Criterion(
        "distance",
        met,
        f"It comes {found.distance * 1e3:z.1f} mm of {found.planned_distance * 1e3:.1f} mm "
        f"{whither} ({share:.1%}), {abs(found.sideways) * 1e3:.1f} mm aside.",
    )


def _heading(found: Measures) -> Criterion:
    turned = np.degrees(found.heading)
    return Criterion(
        "heading",
        abs(found.heading) <= TOLERANCES.walked_heading,
        f"At the end it is turned by {abs(turned):.2f}° to the {'left' if turned > 0 else 'right'} "
        "of its planned heading.",
    )


def _slip(found: Measures) -> Criterion:
    worst = found.worst_slip
    if worst is None:
        return Criterion("slip", False, "No foot ever bears load.")
    over = sum(one.distance > TOLERANCES.walked_slip for one in found.slips)
    steps = f"in {over} of {len(found.slips)} stances" if over else "in the worst stance"
    return Criterion(
        "slip",
        not over,
        f"Standing feet slip: {steps}, farthest the {worst.side} one by "
        f"{worst.distance * 1e3:.2f} mm at t = {worst.time:.3g} s."
        if over
        else f"No standing foot slips by more than {worst.distance * 1e3:.2f} mm a step.",
    )


def _upright(found: Measures) -> Criterion:
    tilt = np.degrees(found.tilt)
    if found.tips_at is None:
        return Criterion("upright", True, f"The torso is at most {tilt:.2f}° off its plan.")
    return Criterion(
        "upright",
        False,
        f"It tips: from t = {found.tips_at:.3g} s the torso is more than "
        f"{np.degrees(TOLERANCES.walked_tilt):.0f}° off its plan, at most {tilt:.1f}°.",
    )


def _torque(found: Measures) -> Criterion:
    worst = int(found.saturated.argmax())
    if found.saturated[worst] == 0:
        return Criterion("torque", True, "No servo ever gives all it has.")
    return Criterion(
        "torque",
        False,
        f"The servo of {JOINT_NAMES[worst]} gives all it has for {found.saturated[worst]:.2%} of "
        f"the time; the plan, its rotor counted, takes {found.line[worst]:.0%} of its torque-speed "
        "line.",
    )


def _soles(found: Measures) -> Criterion:
    if found.meet is None:
        return Criterion("soles", True, "The soles don't touch each other.")
    return Criterion("soles", False, f"The soles touch each other at t = {found.meet:.3g} s.")


def draws_sentences(all_found: Sequence[Measures]) -> Iterator[str]:
    """How many of several tries keep what is asked."""
    tries = [criteria(found) for found in all_found]
    yield passed_sentence(tries)
    led = [[one.met for one in each if one.name in ("distance", "heading")] for each in tries]
    yield f"{sum(map(all, led))} of {len(tries)} keep distance and heading."
    yield from lost_sentences(tries, _LOST)


_LOST: dict[str, str] = {
    "distance": "how far they come",
    "heading": "where they head",
    "slip": "feet that slip",
    "upright": "tipping",
    "torque": "servos that give all they have",
    "soles": "soles that touch each other",
}
