"""A gait written down again: at which times, and in our own format."""

from __future__ import annotations

import json

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.exact import fits, key_ending, toml_number
from scout_pin.motion.gait import BODIES, Gait
from thesis_pin.numeric.interpolation import interpolate
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.tables.writing import WrittenUnits, texts
from thesis_pin.tolerances import TOLERANCES

_APART = 1e-6
"""Share of a gait within which an evenly spaced time and a change of support are one."""


def rows_of(gait: Gait, samples: int | None = None, *, usual: int = 401) -> np.ndarray:
    """Times t at which to write a gait down, in its unit, shape ``(n,)``.

    Args:
        gait: The gait.
        samples: Evenly spaced times, with those at which support changes; None takes the
            samples that the gait was made of, where a spline through them is the gait or it
            is smooth within their resolution.
        usual: How many, where it wasn't made of samples.
    """
    if samples is None and (own := _own_rows(gait)) is not None:
        return own
    changes = np.unique([*(phase.start for phase in gait.phases), gait.end])
    even = np.linspace(gait.start, gait.end, samples or usual)
    apart = np.abs(even[:, None] - changes).min(axis=1) > _APART * (gait.end - gait.start)
    return np.union1d(even[apart], changes)


def _own_rows(gait: Gait) -> np.ndarray | None:
    """The samples that a gait was made of; None if a spline through some isn't all that it is."""
    if gait.variants is not None and gait.rows is not None:
        return np.array(gait.rows.t)
    moving = [c for curves in gait.curves.values() for c in curves if len(c.x) > 2]
    if not moving:
        return None
    t = moving[0].x
    ends = {gait.start, gait.end} <= {float(t[0]), float(t[-1])}
    if len(t) > 3 and ends and all(_through(curve, t) for curve in moving):
        return np.asarray(t)
    return None


def keeps_curves(gait: Gait, samples: int | None) -> bool:
    """Whether our own format takes a gait's own curves rather than splines through samples.

    Splines lose more than digits: the end of a cycle no longer fits its start.

    Args:
        gait: The gait.
        samples: How many were asked for; None takes what suits the gait.
    """
    made_of_samples = gait.variants is not None or _own_rows(gait) is not None
    return samples is None and not made_of_samples and fits(gait)


def supports(gait: Gait, t: np.ndarray) -> list[str]:
    """Who bears load at each row, so that what is written has the gait's own phases when read.

    A reader takes a change to happen at the first row that shows it, so the row at a change
    bears the name of the phase that begins there; only where one foot takes over from the
    other do both stand.

    Args:
        gait: The gait.
        t: Times of the rows in its unit, shape ``(n,)``.
    """
    lasting = [phase for phase in gait.phases if phase.end > phase.start]
    begun = np.searchsorted([phase.start for phase in lasting], t, side="right") - 1
    both = np.asarray(gait.support(t).all(axis=1))
    found = []
    for number, at, two in zip(begun.tolist(), t.tolist(), both.tolist(), strict=True):
        phase = lasting[max(number, 0)]
        before = lasting[max(number - 1, 0)].support
        over = at == phase.start and "double" not in (phase.support, before)
        found.append("double" if over and two else phase.support)
    return found


def _through(curve: Piecewise, t: np.ndarray) -> bool:
    """Whether a curve is the spline with free ends through its own nodes."""
    if len(curve.c) != 4 or not np.array_equal(curve.x, t):
        return False
    again = interpolate(t, curve(t), "free")
    middle = t[:-1] + np.diff(t) / 2
    scale = float(np.abs(curve(t)).max())
    return all(
        np.abs(again(middle, order) - curve(middle, order)).max()
        <= TOLERANCES.same_curve * max(scale, float(np.abs(curve(middle, order)).max()))
        for order in (0, 1, 2)
    )


def gait_toml(gait: Gait, t: np.ndarray, units: WrittenUnits) -> str:
    """A gait in our own format, its curves splined through samples.

    Args:
        gait: The gait.
        t: Times of the samples in its unit, ascending, shape ``(n,)``.
        units: Units of lengths and angles; time is in seconds.
    """
    time = t * gait.time_unit
    lines = [
        "format = 1",
        f"name = {json.dumps(gait.name)}",
        f"source = {json.dumps(gait.source)}",
        "time_unit = 1.0",
        'interpolation = "free"',
        *(["cycle = true"] if gait.cycle else []),
        *([f"branch = {json.dumps(gait.branch)}"] if gait.branch else []),
        *([gait.made_for.toml] if gait.made_for else []),
    ]
    nodes = ", ".join(map(repr, time.tolist()))
    for body in BODIES:
        lines += ["", f"[{body}]"]
        for name, curve in zip(POSE_NAMES, gait.curves[body], strict=True):
            unit = units.length if name in "xyz" else units.angle
            values = texts(curve(t), unit)
            key = name + key_ending(unit)
            if len(set(values)) == 1:
                lines.append(f"{key} = {toml_number(values[0])}")
            else:
                row = ", ".join(map(toml_number, values))
                lines.append(f"{key} = [{{ t = [{nodes}], value = [{row}] }}]")
    for phase in gait.phases:
        start, end = (at * gait.time_unit for at in (phase.start, phase.end))
        support = f'support = "{phase.support}"'
        lines += ["", "[[phases]]", f"start = {start!r}", f"end = {end!r}", support]
    return "\n".join(lines) + "\n"
