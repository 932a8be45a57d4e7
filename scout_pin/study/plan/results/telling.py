"""Limits and requests in words."""

from __future__ import annotations

import math
from collections.abc import Mapping

from scout_pin.study.plan.cycles.feet import Pace, Steps
from scout_pin.study.plan.limits import KINDS, UNITS, Worst
from scout_pin.study.plan.request import PlanRequest

_FIELDS = {
    "step_length": ("a step of {:.4g} mm", 1e3),
    "step_time": ("a step of {:.4g} s", 1.0),
    "speed": ("a speed of {:.4g} mm/s", 1e3),
    "margin": ("a margin of {:.3g} mm", 1e3),
    "side": ("a way aside of {:.3g} mm", 1e3),
    "turn": ("a turn of {:.3g}°", 180 / math.pi),
    "foot_spacing": ("feet {:.4g} mm apart", 1e3),
}


def passed_words(one: Worst) -> str:
    """A limit and what it was held against, as in "the knees' reach (left, 2.1° …)"."""
    about = [one.subject.replace("_", " ")] if one.subject else []
    if one.kind != "contact":
        about.append(f"{_amount(one, one.value)}, limit {_amount(one, one.limit)}")
    elif one.excess > 0.0:
        about.append(f"passed by {one.value - one.limit:.2g} of the weight times a sole's length")
    about.append(f"at t = {one.t:.3g} s")
    return f"{KINDS[one.kind]} ({', '.join(about)})"


def way_words(pace: Pace, steps: Steps) -> str:
    """How far two steps that aren't straight ahead go, as in "60 mm ahead, 20 mm to the right"."""
    parts = [f"{2 * pace.step_length * 1e3:.4g} mm ahead"] if pace.step_length else []
    if steps.aside:
        side = "right" if steps.aside > 0 else "left"
        parts.append(f"{2 * abs(steps.aside) * 1e3:.4g} mm to the {side}")
    if steps.turn:
        side = "left" if steps.turn > 0 else "right"
        parts.append(f"{math.degrees(2 * abs(steps.turn)):.4g}° round to the {side}")
    return ", ".join(parts)


def nearest_words(request: PlanRequest, nearest: Mapping[str, PlanRequest]) -> list[str]:
    """Requests that can be met, each by what it changes."""
    words = []
    for name, other in nearest.items():
        text, scale = _FIELDS[name]
        words.append(text.format(float(getattr(other, name)) * scale))
    return words


def _amount(one: Worst, value: float) -> str:
    if one.kind == "margin":
        return f"{value * 1e3:.3g} mm"
    if one.kind == "posture" and one.subject in ("x", "y", "height"):
        return f"{value * 1e3:.4g} mm"
    if one.kind in ("lower", "upper", "posture"):
        return f"{math.degrees(value):.3g}°"
    if one.kind == "line":
        return f"{value:.1%}"
    if one.kind == "knee":
        if value >= 1.0:
            return f"{value - 1.0:.2g} beyond the reach of a straight leg, as a cosine"
        return f"{math.degrees(math.acos(value)):.3g}° from straight"
    if one.kind == "force":
        return f"{value:.0%} of the weight"
    return f"{value:.3g} {UNITS[one.kind]}"
