"""What a law of motion's report says on a terminal: a table and paragraphs."""

from __future__ import annotations

from collections.abc import Iterator

from pollard_pin.report.tables import resting_on
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS
from pollard_pin.study.timing.report import TimeReport
from thesis_pin.report.tables import Part, Table


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
    yield ""
    yield from resting_on(found.assumptions())


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
