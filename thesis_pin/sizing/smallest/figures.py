"""Time against motor, as a picture."""

from __future__ import annotations

import numpy as np

from thesis_pin.report.curves import GREEN, Curve, Limit, Plot, apart
from thesis_pin.report.figures import figure_files, panels
from thesis_pin.sizing.smallest.answer import Answer
from thesis_pin.sizing.smallest.timed import Timed


def curve_plot(found: Timed, motion: str) -> Plot:
    """How short a motion may be with which motor, over the motors' stall torque."""
    torque = np.array([one.stall_torque for one in found.actuators])
    order = np.argsort(torque, kind="stable")
    listed = len({one.no_load_speed for one in found.actuators}) > 1
    curves = [
        Curve(
            name,
            values[order],
            colour,
            dash,
            marks="dot" if listed else None,
            x=torque[order],
        )
        for (name, values), (colour, dash) in zip(
            found.times.items(), map(apart, range(len(found.times))), strict=True
        )
    ]
    one = found.smallest
    if one is not None and found.within is not None:
        at = found.actuators.index(one)
        here = np.array([one.stall_torque]), np.array([found.fastest[at]])
        curves.append(Curve(f"smallest: {one.name}", here[1], GREEN, marks="cross", x=here[0]))
    return Plot(
        f"Time against motor: {motion}",
        "Times of the motion with motors of each stall torque.",
        "time [s]",
        curves,
        time=torque[order],
        across="stall torque [N·m]",
        limits=[] if found.within is None else [Limit("asked for", found.within)],
    )


def curve_files(answer: Answer) -> dict[str, bytes]:
    """The curve of an answer that has one: file name → content."""
    if answer.curve is None:
        return {}
    plot = curve_plot(answer.curve, answer.motion)
    return figure_files("curve", panels([[plot]], 8.0, 5.0))
