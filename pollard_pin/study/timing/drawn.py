"""A law of motion's report as plots, a page and figures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pollard_pin.report.drawn import page as trajectory
from pollard_pin.report.drawn.curves import motors
from pollard_pin.specification import ACTUATOR_SYMBOLS
from pollard_pin.study.timing.report import TimeReport
from pollard_pin.study.timing.tables import motors_table
from thesis_pin.pages.page import Tile, html
from thesis_pin.report.curves import BLUE, VERMILLION, Curve, Limit, Plot, apart
from thesis_pin.report.figures import figure_files, panels
from thesis_pin.report.tables import Table
from thesis_pin.timing.binding import Stretch, stretches

_MOST = 40


def plots(found: TimeReport) -> list[Plot]:
    """Speed profile and use of limits."""
    timed = found.timed
    time, law = found.report.joints.time, timed.law
    middle = (law.time[1:] + law.time[:-1]) / 2
    top = found.largest_speed
    high = 3 * timed.tool_speed.max()
    profile = Plot(
        "Tool speed",
        "The law's, below what the limits leave at each place by itself; where that is more than "
        "three times the largest speed it isn't drawn.",
        "speed [m/s]",
        [
            Curve(
                "limits by themselves",
                np.where(top > high, np.nan, top),
                VERMILLION,
                "dash",
                x=middle,
            ),
            Curve("law", found.report.tool_speed, BLUE),
        ],
        time,
    )
    drawn = [profile]
    titles = {
        "torque": "Use of the torque–speed lines" if timed.limits.line else "Use of torque limits",
        "speed": "Use of speed limits",
        "force": "Use of the limit of ball-joint forces",
        "tool speed": "Use of the limit of tool speed",
        "tool acceleration": "Use of the limit of tool acceleration",
    }
    for what, values in found.use.items():
        names = ACTUATOR_SYMBOLS if values.shape[1] == len(ACTUATOR_SYMBOLS) else ()
        curves = [
            Curve(
                names[k] if names else f"{what} {k + 1}" if values.shape[1] > 1 else what,
                values[:, k],
                *apart(k),
            )
            for k in range(values.shape[1])
        ]
        text = "1 is the limit."
        drawn.append(
            Plot(titles[what], text, "share [-]", curves, time, limits=[Limit("limit", 1.0)])
        )
    return drawn


def page(found: TimeReport) -> bytes:
    """The report as one self-contained HTML file."""
    whole, timed = trajectory.page_of(found.report), found.timed
    tiles = [
        Tile("duration", f"{timed.duration:.4g} s"),
        Tile("largest use of a limit", f"{timed.solved.use.largest:.1%}"),
    ]
    binding = Table(
        "What binds when",
        ("limit", "from s", "to s"),
        [(one.limit, f"{one.start:.4f}", f"{one.end:.4f}") for one in _longest(found)],
        "The forty longest stretches.",
    )
    return html(
        replace(
            whole,
            title=f"{found.report.robot.specification.name.capitalize()}: {timed.path.name}",
            good=found.within_limits,
            verdict=[*found.verdict(), *(f"Note: {note}." for note in timed.course.notes)],
            tiles=[*tiles, *whole.tiles],
            plots=[*plots(found), *whole.plots],
            tables=[motors_table(found), binding, *whole.tables],
        )
    )


def _longest(found: TimeReport) -> list[Stretch]:
    every = stretches(found.timed.law, found.timed.solved.use)
    kept = sorted(every, key=lambda one: one.start - one.end)[:_MOST]
    return sorted(kept, key=lambda one: one.start)


def figures(found: TimeReport) -> dict[str, bytes]:
    """Figures, and the path with its law: file name → content."""
    torque, speed, power, _ = motors(found.report)
    drawn = {
        "profile": panels([[plot] for plot in plots(found)[:3]], 8, 9),
        "actuators": panels([torque, speed, power], 10, 9),
    }
    files: dict[str, bytes] = {}
    for name, figure in drawn.items():
        files |= figure_files(name, figure)
    return files | {"path.toml": found.path_file.encode()}
