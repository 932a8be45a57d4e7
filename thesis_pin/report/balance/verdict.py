"""The balance report's answer in plain sentences."""

from __future__ import annotations

import numpy as np

from thesis_pin.contacts.balance.sharing import tolerance
from thesis_pin.report.balance.numbers import BalanceNumbers
from thesis_pin.report.resolution import millimetres
from thesis_pin.report.torque import verdict
from thesis_pin.report.uncertainty.reason import FEW
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.tolerances import TOLERANCES

_SHARED = {
    "torque": "the least sum of squared torques",
    "force": "the least sum of squared contact forces",
    "equal": "normal forces as equal as can be",
}
_TELLING = 1e-3  # a share of the weight or of its moment that is named


def sentences(report: BalanceNumbers) -> list[str]:
    """The answer, the most important first."""
    motors, balance = report.motors, _balance(report)
    if (reason := why_not(report)) is not None:
        balance[0] = f"By its own curves {balance[0][0].lower()}{balance[0][1:]}"
        balance.insert(0, reason)
    if report.slides:
        balance[0] = f"Taken as resting, {balance[0][0].lower()}{balance[0][1:]}"
        balance.insert(0, _slides(report))
    return [
        *balance,
        *_friction(report),
        *_contacts(report),
        *verdict.sentences(motors, motors=motors.within_limits is not None),
        *_sharing(report),
        *report.chosen,
    ]


def why_not(report: BalanceNumbers) -> str | None:
    """Why the motion's samples carry no verdict on balance; None if they do, or are exact."""
    drawn = report.drawn
    if drawn is None or report.supplied is not None:
        return None
    if drawn.few:
        return FEW
    held = report.missing
    return (
        "The samples can't carry a verdict: the largest wrench that is missing may be "
        f"{held.low:.2g} to {held.high:.2g} N·m, and {report.border:.2g} N·m count as none. Finer "
        "samples are needed."
    )


def may_slide(report: BalanceNumbers) -> str | None:
    """Why nobody can tell whether feet slide; None where that decides nothing."""
    if report.balanced is not None or not report.supplied:
        return None
    names = ", ".join(one.foot for one in report.slides)
    return f"The samples can't tell whether {names} slides under load. Finer samples are needed."


def _balance(report: BalanceNumbers) -> list[str]:
    if report.cause is None:
        if not report.found.support.any():
            return ["The robot flies: no foot stands, and it moves as it has to in free fall."]
        if report.held:
            said = f"The robot stands on {_listed(report)}"
        else:
            said = "The robot keeps its balance"
        return [f"{said}{_margin(report)}."]
    share = 1.0 - float(report.given.mean())
    when = "" if report.held else f" at t = {report.time[report.worst]:.4g} s"
    often = "" if report.held or share >= 1 else f", {share:.0%} of the samples"
    return [f"The robot falls{when}{often}: {why}." for why in _causes(report)[:1]] + [
        f"And {why}." for why in _causes(report)[1:]
    ]


def _slides(report: BalanceNumbers) -> str:
    each = "; ".join(one.said() for one in report.slides)
    may = "" if any(one.certain for one in report.slides) else "may "
    what = f"Feet {may}slide while they bear load"
    if len(report.slides) == 1:
        what = f"A foot {may}slide{'' if may else 's'} while it bears load"
    why = ", or the samples are too coarse for it to rest" if may else ""
    return f"{what}{why}: {each}."


def _causes(report: BalanceNumbers) -> list[str]:
    """What is missing at the worst sample, the most telling first."""
    why, found = report.cause, report.found
    assert why is not None
    weight, moment = found.scale / found.length, found.scale
    said = []
    if not found.support[why.sample].any():
        return [
            f"no foot stands, and {_newtons(found.violation[why.sample] / found.length)} is missing"
        ]
    if why.pull > _TELLING * weight:
        said.append(f"the floor would have to pull with {_newtons(why.pull)}")
    if why.tip > _TELLING * moment:
        outside = ""
        if why.outside and report.level:
            outside = (
                f", its zero-moment point {why.outside * 1e3:.3g} mm outside its support polygon"
            )
        said.append(f"it tips{outside}; {why.tip:.3g} N·m are missing")
    if why.turn > _TELLING * moment:
        said.append(
            f"it turns on its feet; {why.turn:.3g} N·m about the floor's normal are missing"
        )
    if why.push > _TELLING * weight:
        said.append(f"it slips on any floor; {_newtons(why.push)} along it are missing")
    if why.friction is not None:
        there = [foot.friction for k, foot in enumerate(found.feet) if found.support[why.sample, k]]
        needed = f"{why.friction * max(there):.3g}"
        if why.slips:
            said.append(f"it slips; it needs a friction of {needed}, and has {max(there):g}")
        else:
            said.append(
                f"it is about to slip: it needs a friction of {needed} of {max(there):g}, of which "
                "pyramids of eight edges give no more than 92% in some directions"
            )
    return said or [f"{found.violation[why.sample]:.3g} N·m are missing"]


def _margin(report: BalanceNumbers) -> str:
    held = report.least_margin
    if held.value < 0 or not report.level or not np.isfinite(held.value):
        return ""
    where = "" if report.held else f" (t = {report.time[report.found.margin.argmin()]:.4g} s)"
    return f", its zero-moment point {_millimetres(held)} inside its support polygon{where}"


def _friction(report: BalanceNumbers) -> list[str]:
    used = report.peak_friction
    if report.cause is not None or not any(used):
        return []
    k = int(np.argmax(used))
    foot = report.found.feet[k]
    return [f"Most friction is used by {foot.name}: {used[k]:.0%} of {foot.friction:g}."]


def _contacts(report: BalanceNumbers) -> list[str]:
    said = []
    missing = float(report.found.violation.max())
    if report.cause is None and missing > tolerance(report.found.scale):
        said.append(
            f"Up to {missing:.2g} N·m are missing, less than {report.border:.2g} N·m that count as "
            f"none: {TOLERANCES.balance * 1e3:g} mm of the zero-moment point."
        )
    if not report.level:
        said.append(
            f"Feet stand up to {report.found.level.max() * 1e3:.3g} mm from one plane: their cones "
            "decide, and the zero-moment point is that on the floor's plane."
        )
    flight = float((~report.found.support.any(axis=1)).mean())
    if 0 < flight < 1:
        said.append(f"No foot stands in {flight:.0%} of the samples.")
    return said


def _sharing(report: BalanceNumbers) -> list[str]:
    if not report.found.support.any():
        return ["No foot carries anything."]
    most = int(report.found.freedoms.max())
    if not most:
        return ["What each foot carries follows from the motion."]
    components = "1 component" if most == 1 else f"{most} components"
    least = "" if int(report.found.freedoms.min()) == most else "up to "
    return [
        f"Feet leave {least}{components} of their forces open; load is shared by "
        f"{_SHARED[report.found.sharing]}."
    ]


def _listed(report: BalanceNumbers) -> str:
    standing = [n for k, n in enumerate(report.names) if report.found.support[:, k].any()]
    return standing[0] if len(standing) == 1 else f"{', '.join(standing[:-1])} and {standing[-1]}"


def _newtons(value: float) -> str:
    return f"{value:.4g} N"


def _millimetres(held: Interval) -> str:
    return f"{held.value * 1e3:.3g} mm" if held.low == held.high else millimetres(held)
