"""Figures of a balance report: the floor, the feet, the motors, the joints."""

from __future__ import annotations

from thesis_pin.report.balance import curves
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.curves import evenly
from thesis_pin.report.figures import figure_files, panels
from thesis_pin.report.torque import figures as motors

MOST_SAMPLES = motors.MOST_SAMPLES


def figures(report: BalanceReport) -> dict[str, bytes]:
    """Every figure of a report as PNG and SVG: file name → content."""
    keep = evenly(len(report.time), MOST_SAMPLES)
    title = report.robot.model.name
    files = figure_files("floor", panels([[curves.ground(report, keep)]], 7.0, 6.0, title))
    if report.held:
        return files
    rows = [[curves.margin(report, keep)], *([plot] for plot in curves.forces(report, keep))]
    files |= figure_files("feet", panels(rows, 8.0, 3.2 * len(rows), title))
    return files | motors.figures(report.motors)
