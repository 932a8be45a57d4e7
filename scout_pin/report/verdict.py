"""A gait report's answer in plain sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from scout_pin.report.numbers import GaitReport


def sentences(report: GaitReport) -> list[str]:
    """The verdict, most important first: walking, contact, servos, swing feet."""
    return [
        *_walking(report),
        *_servos(report),
        *_swing(report),
        *_smooth(report),
    ]


def _walking(report: GaitReport) -> list[str]:
    name, count = report.robot.specification.name.capitalize(), len(report.margin)
    outside = report.margin <= 0
    refused = int((~report.dynamics.admissible).sum())
    if not outside.any() and not refused and not report.can_walk:
        return [f"{name} can't walk this gait as planned, though the floor could carry it."]
    if not outside.any() and not refused:
        worst = report.margin.min() * 1e3
        return [
            f"{name} can walk this gait: the floor can supply every wrench it needs, and the "
            f"ZMP keeps at least {worst:.1f} mm inside the support polygon."
        ]
    text = f"{name} can't walk this gait as planned"
    result = []
    if outside.any():
        single = ~report.motion.support.all(axis=1)
        where = "the stance sole" if (single | ~outside).all() else "the support polygon"
        low, high = -report.margin[outside].max() * 1e3, -report.margin[outside].min() * 1e3
        span = f"{low:.1f} to {high:.1f} mm" if high - low > 0.05 else f"{high:.1f} mm"
        text += (
            f": the ZMP lies outside {where} by {span} in {int(outside.sum())} of {count} samples"
        )
        if (single & outside).sum() == single.sum() and single.any():
            text += " (all of single support)"
        text += "."
        if (single & outside).any():
            fall = (
                "onto the foot it means to lift"
                if report.tips_towards_swing
                else "outwards, away from its other foot"
            )
            text += f" It would tip {fall}."
        result.append(text)
    else:
        result.append(
            f"{text}: the ZMP stays inside, but in {refused} of {count} samples the soles can't "
            "give the whole wrench (friction or yaw moment)."
        )
    sample, violation = report.worst_contact
    if refused:
        result.append(
            f"In {refused} of {count} samples no admissible floor wrench exists; the torques "
            f"suppose feet glued to the floor. At worst (t = {report.motion.t[sample]:g}) "
            f"the glue has to supply {violation:.3f} N·m."
        )
    return result


def _servos(report: GaitReport) -> list[str]:
    use, fastest = report.servo_use, report.fastest
    k = int(np.argmax(use))
    if report.servos_carry:
        text = (
            f"The servos can carry it: the worst, {report.actuators.names[k]}, uses "
            f"{use[k]:.0%} of its torque-speed line."
        )
    else:
        text = (
            f"The servos can't carry it: {report.actuators.names[k]} needs {use[k]:.0%} of its "
            "torque-speed line."
        )
    if fastest.line is None:
        text += " No time unit is slow enough: gravity alone overloads a servo."
    else:
        text += f" The line allows a time unit down to {fastest.line:.4f} s."
    return [text]


def _swing(report: GaitReport) -> list[str]:
    if report.clearance < -1e-9:
        return [f"A swinging sole goes {-report.clearance * 1e3:.1f} mm into the floor."]
    return []


def _smooth(report: GaitReport) -> list[str]:
    if not report.rate_jumps:
        return []
    worst = report.rate_jumps[0]
    unit = "m/s" if worst.coordinate in "xyz" else "rad/s"
    count = len(report.rate_jumps)
    often = "once" if count == 1 else f"{count} times"
    return [
        f"A planned rate jumps {often}, most {worst.body.replace('_', ' ')} {worst.coordinate} by "
        f"{worst.size:.3g} {unit} at t = {worst.t:g}; no finite torque does that "
        "and none is counted."
    ]
