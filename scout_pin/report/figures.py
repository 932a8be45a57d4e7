"""Figures of a gait report: the thesis's own (5.1, 5.2, 5.3) and those it has not."""

from __future__ import annotations

from typing import Any

import numpy as np

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.stability import polygons
from scout_pin.report.document import GaitReport
from scout_pin.specification import JOINT_NAMES, SIDES
from thesis_pin.model.loading import joint_id
from thesis_pin.pages.drawing import joint_placements
from thesis_pin.pages.scene import thinned
from thesis_pin.report.summary import PALETTE, figure_files, new_figure

_NAMES = ("yaw", "roll", "pitch", "knee", "ankle pitch", "ankle roll")

_SUPPORT_STYLE: dict[str, dict[str, Any]] = {
    "left": {"facecolor": PALETTE[5], "alpha": 0.35},
    "right": {"facecolor": PALETTE[4], "alpha": 0.35},
    "double": {"facecolor": "none", "edgecolor": "0.5", "linestyle": "--"},
}


def figures(report: GaitReport) -> dict[str, bytes]:
    """Every figure of a report as PNG and SVG: file name → content."""
    files: dict[str, bytes] = {}
    for name, draw in (
        ("feet_and_torso", feet_and_torso),
        ("joint_angles", joint_angles),
        ("stick_figures", stick_figures),
        ("torques", torques),
        ("stability", stability),
    ):
        files |= figure_files(name, draw(report))
    return files


def feet_and_torso(report: GaitReport) -> Any:
    """Torso and feet over time: figure 5.1."""
    figure, axes = new_figure(7, 4)
    axis, motion = axes[0, 0], report.motion
    curves = (
        ("torso y", motion.torso.position[:, 1]),
        ("left foot y", motion.left_foot.position[:, 1]),
        ("left foot z", motion.left_foot.position[:, 2]),
        ("right foot y", motion.right_foot.position[:, 1]),
        ("right foot z", motion.right_foot.position[:, 2]),
    )
    for colour, (label, values) in zip(PALETTE, curves, strict=False):
        axis.plot(motion.time, values * 1e3, color=colour, label=label)
    axis.set(xlabel="time [s]", ylabel="[mm]", title=f"Gait {report.gait.name!r}")
    axis.grid(alpha=0.3)
    axis.legend()
    return figure


def joint_angles(report: GaitReport) -> Any:
    """Joint angles over time, one panel a leg: figure 5.2."""
    figure, axes = new_figure(7, 6, rows=2)
    for k, side in enumerate(SIDES):
        _per_joint(axes[k, 0], report, np.degrees(report.joints.q), k)
        axes[k, 0].set(ylabel=f"{side} leg [°]")
    axes[1, 0].set(xlabel="time [s]")
    return figure


def stick_figures(report: GaitReport, frames: int = 8) -> Any:
    """The robot as a stick figure at moments of the gait, from the side and from the front: 5.3."""
    some = thinned(report.joints.time, frames)
    lines = _skeleton(report, some)
    figure, axes = new_figure(1.35 * len(some), 4.2, rows=2, columns=len(some))
    top = max(points[..., 2].max() for points in lines.values()) * 1e3 + 15
    colours = {"left": PALETTE[5], "right": PALETTE[4], "torso": "0.35"}
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
    axes[1, 0].plot([], [], color=colours["left"], label="left leg")
    axes[1, 0].plot([], [], color=colours["right"], label="right leg")
    figure.legend(fontsize=8, loc="outside lower center", ncols=2)
    return figure


def _skeleton(report: GaitReport, some: np.ndarray) -> dict[str, np.ndarray]:
    """Lines through the joints' origins and around the soles: name → ``(frames, points, 3)``."""
    robot = report.robot
    q = free_flyer_state(report.motion.torso, report.joints)[0][some]
    frames = joint_placements(robot.model, q)[..., :3]
    lines = {}
    for k, side in enumerate(SIDES):
        numbers = [joint_id(robot.model, name) for name in JOINT_NAMES[6 * k : 6 * k + 6]]
        lines[side] = frames[:, numbers]
    lines["torso"] = np.stack([lines[side][:, 0] for side in SIDES], axis=1)
    for side, foot in zip(SIDES, (report.motion.left_foot, report.motion.right_foot), strict=True):
        place = foot.placement[some]
        corners = robot.sole_vertices(side, place)
        lines[f"{side}_sole"] = np.concatenate([corners, corners[:, :1]], axis=1)
        lines[side] = np.concatenate([lines[side], place[:, None, :3, 3]], axis=1)
    return lines


def torques(report: GaitReport) -> Any:
    """Joint torques against the servos' stall torque, one panel a leg."""
    figure, axes = new_figure(7, 6, rows=2)
    for k, side in enumerate(SIDES):
        axis = axes[k, 0]
        _per_joint(axis, report, report.dynamics.torque, k)
        limit = report.robot.stall_torque[6 * k : 6 * k + 6].min()
        for value in (limit, -limit):
            axis.axhline(value, color="black", linestyle="--", linewidth=1)
        axis.annotate("stall torque", (report.joints.time[0], limit), va="bottom", fontsize=8)
        axis.set(ylabel=f"{side} leg [N·m]")
    axes[1, 0].set(xlabel="time [s]")
    return figure


def stability(report: GaitReport) -> Any:
    """Zero-moment point and soles from above, and its margin over time."""
    figure, axes = new_figure(9, 4.5, columns=2)
    plan, time = axes[0]
    feet = {"left": report.motion.left_foot.placement, "right": report.motion.right_foot.placement}
    labelled: set[str] = set()
    for samples, polygon in polygons(report.robot, report.motion, feet):
        phase = report.motion.phase[samples[0]]
        label = None if phase in labelled else f"{phase} support"
        labelled.add(phase)
        plan.fill(*(polygon * 1e3).T, label=label, **_SUPPORT_STYLE[phase])
        plan.plot(*(report.zmp[samples] * 1e3).T, ".", color=PALETTE[1], markersize=2)
    plan.plot([], [], ".", color=PALETTE[1], label="zero-moment point")
    plan.plot(*(report.com[:, :2] * 1e3).T, color=PALETTE[0], linewidth=1, label="centre of mass")
    plan.set(xlabel="x, to the right [mm]", ylabel="y, forward [mm]", aspect="equal")
    plan.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)
    time.plot(report.joints.time, report.margin * 1e3, color=PALETTE[0])
    time.axhline(0, color="black", linewidth=1)
    low = min(0.0, float(report.margin.min()) * 1e3) - 2
    time.axhspan(low, 0, color=PALETTE[1], alpha=0.15, label="outside: the robot tips")
    time.set(xlabel="time [s]", ylabel="ZMP margin [mm]", ylim=(low, None))
    time.legend(fontsize=8)
    for axis in (plan, time):
        axis.grid(alpha=0.3)
    return figure


def _per_joint(axis: Any, report: GaitReport, values: np.ndarray, leg: int) -> None:
    for joint, (colour, name) in enumerate(zip(PALETTE, _NAMES, strict=True)):
        axis.plot(report.joints.time, values[:, 6 * leg + joint], color=colour, label=name)
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
