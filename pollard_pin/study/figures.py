"""The workspace as a picture: condition number over slices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.study.workspace import Workspace
from thesis_pin.report.curves import ORANGE, VERMILLION
from thesis_pin.report.figures import default_style, figure_files, new_figure
from thesis_pin.report.workspace.lines import condition_line

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@default_style()
def workspace_figure(space: Workspace) -> Figure:
    """Condition over a line, over a slice, or over the three middle slices of a volume."""
    sizes = [len(axis) for axis in space.axes]
    if sizes.count(1) > 1:
        return _line(space, int(np.argmax(sizes)))
    thin = [k for k in range(3) if sizes[k] == 1]
    normals = thin[:1] if thin else [0, 1, 2]
    figure, axes = new_figure(6 * len(normals), 5, 1, len(normals))
    values = np.log10(space.condition)
    finite = values[np.isfinite(values)]
    top = float(np.quantile(finite, 0.98)) if finite.size else 1.0
    for ax, normal in zip(axes[0], normals, strict=True):
        across, up = (k for k in range(3) if k != normal)
        middle = sizes[normal] // 2
        cut = np.take(values, middle, axis=normal)
        sign = np.take(space.determinant, middle, axis=normal)
        grid = (space.axes[across], space.axes[up])
        image = ax.pcolormesh(
            *grid, cut.T, shading="nearest", cmap="viridis", vmin=0, vmax=max(top, 0.1)
        )
        if (sign < 0).any() and (sign > 0).any():
            ax.contour(*grid, np.sign(sign).T, levels=[0.0], colors=VERMILLION)
        names = "xyz"
        ax.set(
            xlabel=f"{names[across]} [m]",
            ylabel=f"{names[up]} [m]",
            title=f"{names[normal]} = {space.axes[normal][middle]:.3g} m",
            aspect="equal",
        )
    figure.colorbar(image, ax=list(axes[0]), label="log10 of the condition number")
    return figure


def _line(space: Workspace, along: int) -> Figure:
    """Condition over one coordinate, and where there is none."""
    figure, axes = new_figure(8, 4)
    ax, condition = axes[0, 0], space.condition.ravel()
    reached = space.reachable.ravel()
    missing = [
        ("out of reach", "silver", ~reached),
        ("reached, singular", ORANGE, reached & np.isnan(condition)),
    ]
    border = ("motors lose the tool", VERMILLION)
    condition_line(ax, space.axes[along], condition, space.determinant.ravel(), missing, border)
    fixed = [f"{n} = {space.axes[k][0]:.3g} m" for k, n in enumerate("xyz") if k != along]
    ax.set(xlabel=f"{'xyz'[along]} [m]", title=", ".join(fixed))
    return figure


def workspace_files(space: Workspace) -> dict[str, bytes]:
    """The workspace as PNG and SVG: file name → content."""
    return figure_files("workspace", workspace_figure(space))
