"""Figures of a balance report: the floor, the feet, the motors, the joints."""

from __future__ import annotations

from thesis_pin.report.balance import curves
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.figures import figure_files, panels
from thesis_pin.report.torque import figures as motors


def figures(report: BalanceReport) -> dict[str, bytes]:
    """Every figure of a report as PNG and SVG: file name → content."""
    title = report.robot.model.name
    files = figure_files("floor", panels([[curves.ground(report)]], 7.0, 6.0, title))
    if report.held:
        return files
    rows = [[curves.margin(report)], *([plot] for plot in curves.forces(report))]
    files |= figure_files("feet", panels(rows, 8.0, 3.2 * len(rows), title))
    return files | motors.figures(report.motors)
