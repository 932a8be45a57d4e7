"""Figures: the thesis's 4.1 to 4.4 for any path, loop forces, margins, workspaces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.specification import ACTUATOR_SYMBOLS, JOINT_SYMBOLS
from thesis_pin.report.summary import PALETTE, figure_files, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pollard_pin.report.document import TrajectoryReport
    from pollard_pin.study.workspace import Workspace

_CHAINS = (
    ("chain 0: arm and forearm", (0, 1, 2)),
    ("chain 0: wrist", (3, 4, 5)),
    ("chain 1", (6, 7, 8)),
    ("chain 2", (9, 10, 11)),
)


_POINTS = 1000  # more along a curve don't show


def _thin(report: TrajectoryReport) -> slice:
    """Every how many samples to draw."""
    return slice(None, None, max(1, len(report.joints.time) // _POINTS))


def joints_figure(report: TrajectoryReport, order: int) -> Figure:
    """Positions, velocities or accelerations of all joints (4.1, 4.2, 4.3).

    Args:
        report: The report.
        order: 0, 1 or 2.
    """
    values = (report.joints.q, report.joints.v, report.joints.a)[order]
    unit = ("°", "°/s", "°/s²")[order]
    figure, axes = new_figure(10, 7, 2, 2)
    some = _thin(report)
    for ax, (title, joints) in zip(axes.flat, _CHAINS, strict=True):
        for colour, joint in zip(PALETTE, joints, strict=False):
            ax.plot(
                report.joints.time[some],
                np.degrees(values[some, joint]),
                color=colour,
                label=JOINT_SYMBOLS[joint],
            )
        ax.set(title=title, xlabel="time [s]", ylabel=f"[{unit}]")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small")
    figure.suptitle(("Joint angles", "Joint rates", "Joint accelerations")[order])
    return figure


def actuators_figure(report: TrajectoryReport) -> Figure:
    """Torque, power and work of base and wrist motors (4.4)."""
    figure, axes = new_figure(10, 9, 3, 2)
    some = _thin(report)
    rows = (
        ("torque [N·m]", report.torque),
        ("power [W]", report.power),
        ("work [J]", report.work_done),
    )
    for row, (label, values) in zip(axes, rows, strict=True):
        for ax, title, motors in zip(row, ("base", "wrist"), (range(3), range(3, 6)), strict=True):
            for k in motors:
                ax.plot(
                    report.joints.time[some],
                    values[some, k],
                    color=PALETTE[k % 3],
                    label=ACTUATOR_SYMBOLS[k],
                )
            ax.set(title=title, xlabel="time [s]", ylabel=label)
            ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small")
    figure.suptitle(f"Motors on {report.path.name}, {report.robot.inertia} inertias")
    return figure


def margins_figure(report: TrajectoryReport) -> Figure:
    """Ball-joint forces, condition number and reach margin."""
    figure, axes = new_figure(8, 8, 3, 1)
    force, condition, margin = axes[:, 0]
    some = _thin(report)
    time = report.joints.time[some]
    for i in (0, 1):
        force.plot(
            time,
            report.loop_force_size[some, i],
            color=PALETTE[i],
            label=f"ball joint {i + 1}",
        )
    force.legend(fontsize="small")
    force.set(ylabel="force [N]", title="Loop reactions")
    condition.plot(time, report.holding.condition[some], color=PALETTE[0])
    condition.set(ylabel="condition [-]", title="Six-motor Jacobian, lengths in 0.1 m")
    margin.plot(time, report.solutions.margin[some], color=PALETTE[2])
    margin.set(ylabel="margin [-]", xlabel="time [s]", title="Reach margin")
    return figure


def report_files(report: TrajectoryReport) -> dict[str, bytes]:
    """Every figure of a report as PNG and SVG: file name → content."""
    files: dict[str, bytes] = {}
    for order, name in enumerate(("positions", "velocities", "accelerations")):
        files |= figure_files(name, joints_figure(report, order))
    files |= figure_files("actuators", actuators_figure(report))
    files |= figure_files("margins", margins_figure(report))
    return files


def workspace_figure(space: Workspace) -> Figure:
    """Condition over a slice, or over the three middle slices of a volume."""
    sizes = [len(axis) for axis in space.axes]
    thin = [k for k in range(3) if sizes[k] == 1]
    normals = thin[:1] if thin else [0, 1, 2]
    figure, axes = new_figure(6 * len(normals), 5, 1, len(normals))
    values = np.log10(space.condition)
    finite = values[np.isfinite(values)]
    top = float(np.quantile(finite, 0.98)) if finite.size else 1.0
    image = None
    for ax, normal in zip(axes[0], normals, strict=True):
        across, up = (k for k in range(3) if k != normal)
        middle = sizes[normal] // 2
        cut = np.take(values, middle, axis=normal)
        sign = np.take(space.determinant, middle, axis=normal)
        grid = (space.axes[across], space.axes[up])
        image = ax.pcolormesh(
            *grid, cut.T, shading="nearest", cmap="viridis", vmin=0, vmax=max(top, 0.1)
        )
        if min(sign.shape) > 1 and (sign < 0).any() and (sign > 0).any():
            ax.contour(*grid, np.sign(sign).T, levels=[0.0], colors=PALETTE[1])
        names = "xyz"
        ax.set(
            xlabel=f"{names[across]} [m]",
            ylabel=f"{names[up]} [m]",
            title=f"{names[normal]} = {space.axes[normal][middle]:.3g} m",
            aspect="equal" if min(sizes[across], sizes[up]) > 1 else "auto",
        )
    figure.colorbar(image, ax=list(axes[0]), label="log10 of the condition number")
    return figure


def workspace_files(space: Workspace) -> dict[str, bytes]:
    """The workspace as PNG and SVG: file name → content."""
    return figure_files("workspace", workspace_figure(space))
