"""The workspace as a picture: condition number over slices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.study.workspace import Workspace
from thesis_pin.report.curves import VERMILLION
from thesis_pin.report.figures import default_style, figure_files, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@default_style()
def workspace_figure(space: Workspace) -> Figure:
    """Condition over a slice, or over the three middle slices of a volume."""
    sizes = [len(axis) for axis in space.axes]
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
        if min(sign.shape) > 1 and (sign < 0).any() and (sign > 0).any():
            ax.contour(*grid, np.sign(sign).T, levels=[0.0], colors=VERMILLION)
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
