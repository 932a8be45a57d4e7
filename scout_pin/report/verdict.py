"""A gait's answer: yes or no, and in plain sentences."""

from __future__ import annotations

import numpy as np

from scout_pin.motion.collisions import Touch
from scout_pin.report.judged import ends
from scout_pin.report.judged.limits import SPEEDS, headline
from scout_pin.report.numbers import GaitNumbers
from thesis_pin.tolerances import TOLERANCES


def servos_carry(numbers: GaitNumbers) -> bool:
    """Whether every joint stays under its servo's torque-speed line."""
    return bool((numbers.servo_use <= 1.0).all())


def can_walk(numbers: GaitNumbers) -> bool:
    """Whether the floor can give every wrench, feet swing clear, no rate jumps, a cycle closes."""
    return bool(
        (numbers.margin > 0).all() and numbers.dynamics.admissible.all() and feet_and_rates(numbers)
    )


def feet_and_rates(numbers: GaitNumbers) -> bool:
    """All but what the floor has to supply: feet swing clear, no rate jumps, a cycle closes."""
    return (
        not numbers.digs
        and not numbers.soles_collide
        and not numbers.collisions.touching
        and numbers.ends.kind != "open cycle"
        and not numbers.rate_jumps
    )


def within_limits(numbers: GaitNumbers) -> bool:
    """Walkable and carried by the servos."""
    return can_walk(numbers) and servos_carry(numbers)


def sentences(numbers: GaitNumbers, *, walking: bool = True, servos: bool = True) -> list[str]:
    """The verdict, most important first: walking, contact, ends, servos, speed, swing feet.

    Args:
        numbers: What it is about.
        walking: Whether to say if the floor can supply what the gait needs.
        servos: Whether to say if the servos can carry it.
    """
    return [
        *(_walking(numbers) if walking else ()),
        *ends.sentences(numbers.ends),
        *(_servos(numbers) if servos else ()),
        *(_speed(numbers) if walking and servos else ()),
        *_swing(numbers),
        *_smooth(numbers),
    ]


def _walking(numbers: GaitNumbers) -> list[str]:
    name, count = numbers.robot.specification.name.capitalize(), len(numbers.margin)
    outside = numbers.margin <= 0
    refused = int((~numbers.dynamics.admissible).sum())
    if not outside.any() and not refused and not can_walk(numbers):
        return [f"{name} can't walk this gait as planned, though the floor could carry it."]
    if not outside.any() and not refused:
        least = _millimetres(numbers.margin.min())
        within = " within its file" if numbers.ends.qualified else ""
        return [
            f"{name} can walk this gait{within}: the floor can supply every wrench it needs, and "
            f"the ZMP keeps at least {least} inside the support polygon."
        ]
    text = f"{name} can't walk this gait as planned"
    result = []
    if outside.any():
        single = ~numbers.motion.support.all(axis=1)
        where = "the stance sole" if (single | ~outside).all() else "the support polygon"
        low, high = -numbers.margin[outside].max() * 1e3, -numbers.margin[outside].min() * 1e3
        span = f"{low:z.1f} to {high:z.1f} mm" if high - low > 0.05 else _millimetres(high * 1e-3)
        text += (
            f": the ZMP lies outside {where} by {span} in {int(outside.sum())} of {count} samples"
        )
        if (single & outside).sum() == single.sum() and single.any():
            text += " (all of single support)"
        text += "."
        if (single & outside).any():
            fall = (
                "onto the foot it means to lift"
                if numbers.tips_towards_swing
                else "outwards, away from its other foot"
            )
            text += f" It would tip {fall}."
        result.append(text)
    else:
        result.append(
            f"{text}: the ZMP stays inside, but in {refused} of {count} samples the soles can't "
            "give the whole wrench (friction or yaw moment)."
        )
    if refused:
        sample, violation = numbers.worst_contact
        result.append(
            f"In {refused} of {count} samples no admissible floor wrench exists; the torques "
            f"suppose feet glued to the floor. At worst (t = {numbers.motion.t[sample]:g}) "
            f"the glue has to supply {violation:.3f} N·m."
        )
    return result


def _servos(numbers: GaitNumbers) -> list[str]:
    use = numbers.servo_use
    k = int(np.argmax(use))
    if servos_carry(numbers):
        text = (
            f"The servos can carry it: the worst, {numbers.actuators.names[k]}, uses "
            f"{_percent(use[k])} of its torque-speed line."
        )
    else:
        text = (
            f"The servos can't carry it: {numbers.actuators.names[k]} needs {_percent(use[k])} of "
            "its torque-speed line."
        )
    return [text]


def _speed(numbers: GaitNumbers) -> list[str]:
    """At which time units it does both; the interval with the given one first."""
    unit, found = numbers.time_unit, numbers.time_units
    first = headline(found, unit)
    if first is None:
        low, high = (unit / speed for speed in reversed(SPEEDS))
        return [
            f"At no time unit from {low:.4g} to {high:.4g} s would it both walk and be carried."
        ]
    inside = first.shortest <= unit <= first.longest
    text = "It walks, and the servos carry it, " if inside else "It would do both "
    text += f"at time units from {first.words}"
    others = [f"{one.shortest:.4g} to {one.longest:.4g} s" for one in found if one is not first]
    return [f"{text}; also from {', '.join(others)}." if others else f"{text}."]


def _swing(numbers: GaitNumbers) -> list[str]:
    said = []
    if numbers.digs:
        depth = -(numbers.lowest_corner or 0.0)
        said.append(f"A swinging sole goes {depth * 1e3:.1f} mm into the floor.")
    if numbers.soles_collide:
        time = numbers.motion.t[numbers.sole_gap[1]]
        said.append(f"The soles collide (t = {time:g}).")
    for touch in numbers.collisions.touching:
        said.append(f"{_links(touch)} collide (t = {numbers.motion.t[touch.sample]:g}).")
    drawn = numbers.collisions.drawn
    if drawn:
        time = numbers.motion.t[drawn[0].sample]
        more = ("", ", and another pair")[len(drawn) > 1]
        more = f", and {len(drawn) - 1} other pairs" if len(drawn) > 2 else more
        said.append(
            f"As drawn, {_links(drawn[0])} touch (t = {time:g}){more}; "
            "what the specification gives no shape of (collision) isn't judged."
        )
    scraping = [swing for swing in numbers.swings if swing.scrapes]
    if scraping:
        worst = max(scraping, key=lambda swing: swing.scraped)
        often = ("", ", and another swing does")[len(scraping) > 1]
        often = f", and {len(scraping) - 1} other swings do" if len(scraping) > 2 else often
        said.append(
            f"The {worst.side} foot scrapes: of its way of {worst.way * 1e3:.1f} mm it makes "
            f"{worst.scraped * 1e3:.1f} mm less than {TOLERANCES.scrape_height * 1e3:g} mm above "
            f"the floor (t = {worst.start:g} to {worst.end:g}){often}."
        )
    return said


def _percent(use: float) -> str:
    """A share of a limit, with as many digits as tell on which side of 100 % it is."""
    digits = next((n for n in range(8) if np.sign(round(use, n + 2) - 1) == np.sign(use - 1)), 8)
    return f"{use:.{digits}%}"


def _millimetres(length: float) -> str:
    """A length that isn't zero, and doesn't look like it."""
    return f"{length * 1e3:.1f} mm" if round(length * 1e3, 1) else f"{length * 1e3:.1g} mm"


def _links(touch: Touch) -> str:
    return " and ".join(touch.links)


def _smooth(numbers: GaitNumbers) -> list[str]:
    if not numbers.rate_jumps:
        return []
    worst = numbers.rate_jumps[0]
    unit = "m/s" if worst.coordinate in "xyz" else "rad/s"
    count = len(numbers.rate_jumps)
    often = "once" if count == 1 else f"{count} times"
    return [
        f"A planned rate jumps {often}, most {worst.body.replace('_', ' ')} {worst.coordinate} by "
        f"{worst.size:.3g} {unit} at t = {worst.t:g}; no finite torque does that "
        "and none is counted."
    ]
