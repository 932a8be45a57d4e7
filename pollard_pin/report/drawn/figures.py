"""Figures of a trajectory report: 4.1 to 4.4 for any path, loop forces, margins, tool."""

from __future__ import annotations

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.report.drawn import curves
from pollard_pin.report.movement import report_states
from thesis_pin.report.curves import evenly
from thesis_pin.report.exchange.movement import exchange_files
from thesis_pin.report.figures import figure_files, panels

NUMBERS = {
    "positions": "4.1",
    "velocities": "4.2",
    "accelerations": "4.3",
    "actuators": "4.4",
    "margins": "",
    "tool": "",
}
"""Names of the figures, each with its number in the thesis; empty for those it has not."""

EXCHANGED = 4001
"""Samples of the joints for other programs, at most."""


def figures(report: TrajectoryReport) -> dict[str, bytes]:
    """Every figure as PNG and SVG, and the joints for other programs: file name → content."""
    torque, _, power, work = curves.motors(report)
    title = f"Motors on {report.path.name}, {report.robot.inertia} inertias"
    drawn = {"actuators": panels([torque, power, work], 10, 9, title)}
    for order, name in enumerate(("positions", "velocities", "accelerations")):
        chains = curves.joints(report, order)
        drawn[name] = panels([chains[:2], chains[2:]], 10, 7)
    margins = (curves.loop_reactions, curves.conditioning, curves.reach_margin)
    drawn["margins"] = panels([[plot(report)] for plot in margins], 8, 8)
    drawn["tool"] = panels([[curves.tool_speed(report)]], 8, 3)
    files: dict[str, bytes] = {}
    for name, figure in drawn.items():
        files |= figure_files(name, figure)
    keep = evenly(len(report.joints.time), EXCHANGED)
    return files | exchange_files(report_states(report, keep))
