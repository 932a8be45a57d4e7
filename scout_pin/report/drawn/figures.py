"""Figures of a gait report: the thesis's own (5.1, 5.2, 5.3) and those it has not."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
from thesis_pin.report.curves import evenly
from thesis_pin.report.exchange.movement import exchange_files
from thesis_pin.report.figures import default_style, figure_files, new_figure, panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
def stick_figures(report: GaitReport, frames: int = 8) -> Figure:
    """The robot as a stick figure at moments of the gait, from the side and from the front: 5.3."""
    some = thinned(report.joints.time, frames)
    lines = skeleton(report, some)
    figure, axes = new_figure(1.35 * len(some), 4.2, rows=2, columns=len(some))
    top = max(points[..., 2].max() for points in lines.values()) * 1e3 + 15
    colours = SIDE_COLOURS | {"torso": "0.35"}
    for row, (across, view) in enumerate(((1, "from the right"), (0, "from behind"))):
        everything = np.concatenate([points[..., across].ravel() for points in lines.values()])
        limits = np.array([everything.min(), everything.max()]) * 1e3 + (-15, 15)
        for k, axis in enumerate(axes[row]):
            for name, points in lines.items():
                axis.plot(
                    *points[k][:, [across, 2]].T * 1e3,
                    color=colours[name.split("_")[0]],
                    linewidth=1.2 if "sole" in name else 2,
                    marker="" if "sole" in name else "o",
                    markersize=3,
                )
            axis.axhline(0, color="black", linewidth=0.8)
            axis.set(aspect="equal", xlim=limits, ylim=(-12, top), xticks=[])
            if row == 0:
                axis.set_title(f"{report.joints.time[some[k]]:.2f} s", fontsize=9)
            if k:
                axis.set_yticks([])
        axes[row, 0].set_ylabel(f"{view}, z [mm]", fontsize=9)
    for side in SIDES:
        axes[1, 0].plot([], [], color=colours[side], label=f"{side} leg")
    figure.legend(fontsize=8, loc="outside lower center", ncols=2)
    return figure


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
