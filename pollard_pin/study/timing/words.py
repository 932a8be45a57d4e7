"""What a law of motion's report says: tables, a page, figures."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from pollard_pin.report.drawn import page as trajectory
from pollard_pin.report.drawn.curves import motors
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS
from pollard_pin.study.timing.report import TimeReport
from thesis_pin.pages.page import Tile, html
from thesis_pin.report.curves import BLUE, VERMILLION, Curve, Limit, Plot, apart
from thesis_pin.report.figures import figure_files, panels
from thesis_pin.report.tables import Part, Table
from thesis_pin.timing.binding import Stretch, stretches


def summary(found: TimeReport) -> Iterator[Part]:
    """The report in tables and paragraphs."""
    timed, limits = found.timed, found.timed.limits
    yield motors_table(found)
    tool = timed.tool_speed
    yield (
        f"The spray tip moves at {tool.min():.4g} to {tool.max():.4g} m/s; ball joints carry up to "
        f"{found.report.loop_force_size.max():.3g} N."
    )
    extra = [
        f"{text} {value:g} {unit}"
        for text, value, unit in (
            ("ball-joint forces", limits.force, "N"),
            ("tool speed", limits.tool_speed, "m/s"),
            ("tool acceleration", limits.tool_acceleration, "m/s²"),
        )
        if value is not None
    ]
    if extra:
        yield f"Limited too: {', '.join(extra)}."
    yield ""
    yield from found.verdict()
    if not found.given:
        yield (
            "The motors' torques and speeds are the specification's, which are assumptions; give "
            "your motors' with --torque and --speed."
        )
    yield from (f"Note: {note}." for note in timed.course.notes)


def motors_table(found: TimeReport) -> Table:
    """Each motor's limits, how much of them it uses, and how long it is the one that binds."""
    limits, use = found.timed.limits, found.timed.solved.use
    peak = dict(zip(use.names, use.peak, strict=True))
    first = "torque–speed line" if limits.line else "torque"
    torque, speed = (
        [peak[f"{what} of {name}"] for name in ACTUATOR_NAMES] for what in (first, "speed")
    )
    binds = [
        sum(share for limit, share in found.shares.items() if limit.endswith(f" of {name}"))
        for name in ACTUATOR_NAMES
    ]
    what = "line" if limits.line else "torque"
    columns = {
        "motor": ACTUATOR_NAMES,
        "": ACTUATOR_SYMBOLS,
        "N·m": [f"{value:.4g}" for value in limits.effort],
        f"{what} used": [f"{value:.1%}" for value in torque],
        "rad/s": [f"{value:.4g}" for value in limits.speed],
        "speed used": [f"{value:.1%}" for value in speed],
        "binds": [f"{value:.0%}" for value in binds],
    }
    title = f"Motors, law {found.timed.aim}, {found.timed.duration:.4g} s"
    return Table.of(title, columns)


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
        Tile("fastest spray tip", f"{timed.tool_speed.max():.3g} m/s"),
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


_MOST = 40


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
