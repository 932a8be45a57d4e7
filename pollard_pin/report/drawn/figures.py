"""Figures of a trajectory report: 4.1 to 4.4 for any path, loop forces, margins, tool."""

from __future__ import annotations

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.report.drawn import curves
from pollard_pin.report.movement import report_states
from thesis_pin.report.curves import evenly
from thesis_pin.report.exchange.movement import exchange_files
from thesis_pin.report.figures import figure_files, panels

MOST_SAMPLES = 4001
"""More along a curve don't show."""


def figures(report: TrajectoryReport) -> dict[str, bytes]:
    """Every figure as PNG and SVG, and the joints for other programs: file name → content."""
    keep = evenly(len(report.joints.time), MOST_SAMPLES)
    torque, _, power, work = curves.motors(report, keep)
    title = f"Motors on {report.path.name}, {report.robot.inertia} inertias"
    drawn = {"actuators": panels([torque, power, work], 10, 9, title)}
    for order, name in enumerate(("positions", "velocities", "accelerations")):
        chains = curves.joints(report, keep, order)
        drawn[name] = panels([chains[:2], chains[2:]], 10, 7)
    margins = (curves.loop_reactions, curves.conditioning, curves.reach_margin)
    drawn["margins"] = panels([[plot(report, keep)] for plot in margins], 8, 8)
    drawn["tool"] = panels([[curves.tool_speed(report, keep)]], 8, 3)
    files: dict[str, bytes] = {}
    for name, figure in drawn.items():
        files |= figure_files(name, figure)
    return files | exchange_files(report_states(report, keep))
