"""Figures of a torque report: motors, loops and joints."""

from __future__ import annotations

from thesis_pin.report.curves import evenly
from thesis_pin.report.figures import figure_files, panels
from thesis_pin.report.torque import curves
from thesis_pin.report.torque.document import TorqueReport

MOST_SAMPLES = 4001
"""More along a curve don't show."""


def figures(report: TorqueReport) -> dict[str, bytes]:
    """Every figure of a report as PNG and SVG: file name → content."""
    keep = evenly(len(report.joints.time), MOST_SAMPLES)
    drawn = {
        "motors": curves.motors(report, keep),
        "joints": [[plot] for plot in curves.joints(report, keep)],
        "loops": [[plot] for plot in curves.loops(report, keep)],
    }
    files: dict[str, bytes] = {}
    for name, rows in drawn.items():
        if rows:
            width = 5.0 * len(rows[0]) if len(rows[0]) > 1 else 8.0
            figure = panels(rows, width, 3.2 * len(rows), report.robot.model.name)
            files |= figure_files(name, figure)
    return files
