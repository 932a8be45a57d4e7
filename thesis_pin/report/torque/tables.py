"""What a torque report says: tables and paragraphs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from thesis_pin.report.tables import Part, Table
from thesis_pin.report.torque.document import TorqueReport
from thesis_pin.report.torque.uncertainty import open_table


def motors_table(report: TorqueReport) -> Table:
    """What every motor has to do."""
    a = report.actuators
    per = ["rad/s" if turns else "m/s" for turns in report.turning]
    columns = {
        "motor": a.names,
        "peak": [f"{x:.4g} {u}" for x, u in zip(a.peak_torque, report.units, strict=True)],
        "RMS": [f"{x:.4g}" for x in a.rms_torque],
        "of limit": [f"{x:.0%}" if x else "–" for x in report.effort_use],
        "peak speed": [f"{x:.4g} {u}" for x, u in zip(a.peak_speed, per, strict=True)],
        "peak W": [f"{x:.4g}" for x in a.peak_power],
        "work + J": [f"{x:.4g}" for x in a.positive_work],
        "work − J": [f"{x:z.4g}" for x in a.negative_work],
        "net J": [f"{x:z.4g}" for x in a.net_work],
    }
    return Table.of("Motors", columns)


def loops_table(report: TorqueReport) -> Table:
    """What every loop has to carry."""
    moments = np.linalg.norm(report.dynamics.moment, axis=-1).max(axis=0)
    forces = report.loop_force_size.max(axis=0)
    return Table(
        "Loops, peaks",
        ("loop", "type", "force N", "moment N·m"),
        [
            (loop.name, loop.kind, f"{force:.4g}", f"{moment:.4g}")
            for loop, force, moment in zip(report.robot.loops, forces, moments, strict=True)
        ],
    )


def summary(report: TorqueReport) -> Iterator[Part]:
    """A torque report in tables and paragraphs."""
    time = report.joints.time
    title = f"{report.robot.model.name}, {report.motion.name}, {time[-1] - time[0]:g} s"
    yield motors_table(report).only(title, (0, 1, 3, 4, 5, 8))  # what 80 columns hold
    if report.robot.loops:
        yield loops_table(report)
    yield f"Unexplained load: {report.unexplained.max():.1e} of the largest."
    if report.headlines is not None:
        yield open_table(report.headlines, report.names)
    yield from (f"Warning: {one}." for one in report.doubts())
    yield from report.verdict()
    yield from (f"Note: {note}." for note in report.notes())
    yield from (f"Warning: {one}" for one in report.warnings())
