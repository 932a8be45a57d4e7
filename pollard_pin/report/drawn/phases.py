"""Phases of a path that have their like in other paths: how much of its way the tip has gone."""

from __future__ import annotations

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.urdf import TOOL_FRAME
from thesis_pin.pages.alignment import Phase, by_way
from thesis_pin.pages.drawing import frame_placements


def phases(report: TrajectoryReport) -> tuple[Phase, ...]:
    """Equal parts of the spray tip's way.

    Args:
        report: The report on the path.

    Raises:
        BadInput: The tip moves nowhere.
    """
    points = frame_placements(report.robot.model, TOOL_FRAME, report.joints.q)[:, :3]
    return by_way(report.joints.time, points, "the spray tip")
