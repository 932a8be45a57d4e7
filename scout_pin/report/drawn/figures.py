"""Figures of a gait report: the thesis's own (5.1, 5.2, 5.3) and those it has not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import free_flyer_state
from scout_pin.report.document import GaitReport
from scout_pin.report.drawn import curves
from scout_pin.report.drawn.curves import SIDE_COLOURS
from scout_pin.report.movement import report_states
from scout_pin.specification import JOINT_NAMES, SIDES
from thesis_pin.model.loading import joint_id
from thesis_pin.numeric.elementwise import Samples
from thesis_pin.pages.drawing import joint_placements
from thesis_pin.pages.scene import thinned
from thesis_pin.report.curves import BLACK, Curve, Plot, evenly
from thesis_pin.report.exchange.movement import exchange_files
from thesis_pin.report.figures import default_style, figure_files, panels
from thesis_pin.report.plotting.grid import arranged
from thesis_pin.report.plotting.legend import Entry, Legend
from thesis_pin.report.plotting.panel import Panel
from thesis_pin.report.plotting.sheet import Look, Sheet, colour

NUMBERS = {
    "feet_and_torso": "5.1",
    "joint_angles": "5.2",
    "stick_figures": "5.3",
    "torques": "",
    "stability": "",
}
"""Names of the figures, each with its number in the thesis; empty for those it has not."""

EXCHANGED = 4001
"""Samples of the joints for other programs, at most."""


def figures(report: GaitReport) -> dict[str, bytes]:
    """Every figure as PNG and SVG, and the joints for other programs: file name → content."""
    legs, plan = SIDES, curves.plan(report)
    drawn = {
        "feet_and_torso": panels([[curves.feet_and_torso(report)]], 7, 4),
        "joint_angles": panels([[curves.joint_angles(report, leg)] for leg in legs], 8, 6.5),
        "stick_figures": stick_figures(report),
        "torques": panels([[curves.torques(report, leg)] for leg in legs], 8, 6.5),
        "stability": panels([[plan, curves.stability_margin(report)]], 11, 5),
    }
    files: dict[str, bytes] = {}
    for name, figure in drawn.items():
        files |= figure_files(name, figure)
    keep = evenly(len(report.joints.time), EXCHANGED)
    return files | exchange_files(report_states(report, keep))


@default_style()
def stick_figures(report: GaitReport, frames: int = 8) -> Sheet:
    """The robot as a stick figure at moments of the gait, from the side and from the front: 5.3."""
    some = thinned(report.joints.time, frames)
    lines = skeleton(report, some)
    top = max(points[..., 2].max() for points in lines.values()) * 1e3 + 15
    rows = []
    for row, (across, view) in enumerate(((1, "from the right"), (0, "from behind"))):
        everything = np.concatenate([points[..., across].ravel() for points in lines.values()])
        low, high = float(everything.min()) * 1e3 - 15, float(everything.max()) * 1e3 + 15
        floor = Curve("floor", np.zeros(2), BLACK, x=np.array([low, high]), weight=0.8)
        rows.append(
            [
                Panel(
                    Plot(
                        f"{report.joints.time[some[k]]:.2f} s" if row == 0 else "",
                        "The robot as a stick figure.",
                        f"{view}, z [mm]",
                        [floor, *_sticks(lines, k, across)],
                    ),
                    (low, high),
                    (-12.0, top),
                    marked=(False, k == 0),
                )
                for k in range(len(some))
            ]
        )
    legend = Legend(
        [Entry(f"{side} leg", Look(colour(SIDE_COLOURS[side]), 2.0)) for side in SIDES], 2
    )
    return arranged(rows, 1.35 * len(some), 4.2, legend=legend)


def _sticks(lines: dict[str, NDArray[np.float64]], moment: int, across: int) -> list[Curve]:
    """Lines of one moment, and dots at the joints; ``across`` is the axis to the right."""
    colours = SIDE_COLOURS | {"torso": "#595959"}
    curves = []
    for name, points in lines.items():
        x, y = points[moment][:, [across, 2]].T * 1e3
        tint, sole = colours[name.split("_")[0]], "sole" in name
        curves.append(Curve(name, y, tint, x=x, weight=1.2 if sole else 2.0))
        if not sole:
            curves.append(Curve(name, y, tint, marks="dot", x=x, weight=2.0))
    return curves


def skeleton(report: GaitReport, some: Samples) -> dict[str, NDArray[np.float64]]:
    """Lines through the joints' origins and around the soles.

    Args:
        report: The report.
        some: Indices of samples.

    Returns:
        Name → points in the world [m], shape ``(len(some), points, 3)``.
    """
    robot = report.robot
    motion = report.motion.part(some)
    q = free_flyer_state(motion.torso, report.joints.part(some))[0]
    frames = joint_placements(robot.model, q)[..., :3]
    lines = {}
    for k, side in enumerate(SIDES):
        numbers = [joint_id(robot.model, name) for name in JOINT_NAMES[6 * k : 6 * k + 6]]
        lines[side] = frames[:, numbers]
    lines["torso"] = np.stack([lines[side][:, 0] for side in SIDES], axis=1)
    for side, foot in zip(SIDES, (motion.left_foot, motion.right_foot), strict=True):
        place = foot.placement
        corners = robot.sole_vertices(side, place)
        lines[f"{side}_sole"] = np.concatenate([corners, corners[:, :1]], axis=1)
        lines[side] = np.concatenate([lines[side], place[:, None, :3, 3]], axis=1)
    return lines
