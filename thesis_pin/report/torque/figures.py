"""Figures of a torque report: motors, loops and joints."""

from __future__ import annotations

from thesis_pin.report.figures import figure_files, panels
from thesis_pin.report.torque import curves
from thesis_pin.report.torque.document import TorqueReport


def figures(report: TorqueReport) -> dict[str, bytes]:
    """Every figure of a report as PNG and SVG: file name → content."""
    drawn = {
        "motors": curves.motors(report),
        "joints": [[plot] for plot in curves.joints(report)],
        "loops": [[plot] for plot in curves.loops(report)],
    }
    files: dict[str, bytes] = {}
    for name, rows in drawn.items():
        if rows:
            width = 5.0 * len(rows[0]) if len(rows[0]) > 1 else 8.0
            figure = panels(rows, width, 3.2 * len(rows), report.robot.model.name)
            files |= figure_files(name, figure)
    return files
