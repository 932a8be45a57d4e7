"""What a balance report says: tables and paragraphs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.tables import Part, Table
from thesis_pin.report.torque.tables import loops_table, motors_table
from thesis_pin.report.torque.uncertainty import open_table

HELD_FEET, HELD_MOTORS = (0, 3, 5, 6, 7), (0, 1, 3)
"""Columns that say something of a pose that is held."""


def feet_table(report: BalanceReport) -> Table:
    """What every foot has to bear."""
    found = report.found
    force = found.contact_wrench
    across = np.hypot(force[..., 0], force[..., 1])
    twist = np.abs(force[..., 5])
    normal = found.normal_force
    low, high = (np.where(found.support, normal, fill) for fill in (np.inf, -np.inf))
    most = "force" if report.held else "force, most"
    columns = {
        "foot": report.names,
        "kind": [foot.kind for foot in found.feet],
        "bears load": [f"{share:.0%}" for share in found.support.mean(axis=0)],
        f"{most} N": [_some(x) for x in high.max(axis=0)],
        "least N": [_some(x) for x in low.min(axis=0)],
        "along floor N": [f"{x:.4g}" for x in across.max(axis=0)],
        "friction used": [f"{x:.0%}" for x in report.peak_friction],
        "twist N·m": [f"{x:.3g}" for x in twist.max(axis=0)],
    }
    return Table.of("Feet", columns)


def summary(report: BalanceReport) -> Iterator[Part]:
    """A balance report in tables and paragraphs."""
    time, motors = report.time, report.motors
    title = f"{report.robot.model.name}, {motors.motion.name}"
    if not report.held:
        title += f", {time[-1] - time[0]:g} s"
    feet = feet_table(report)
    yield feet.only(title, HELD_FEET if report.held else (0, 2, 3, 4, 5, 6))
    yield motors_table(motors).only("Motors", HELD_MOTORS if report.held else (0, 1, 3, 4, 5, 8))
    if report.robot.loops:
        yield loops_table(motors)
    if motors.headlines is not None:
        yield open_table(motors.headlines, motors.names)
    yield from (f"Warning: {one}." for one in report.doubts())
    yield from report.verdict()
    yield from (f"Note: {note}." for note in motors.motion.notes)
    yield from (f"Warning: {one}" for one in report.warnings())


def _some(value: float) -> str:
    return f"{value:.4g}" if np.isfinite(value) else "–"
