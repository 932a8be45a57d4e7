"""A workspace as a picture: the condition number, and why the rest can't be reached."""

from __future__ import annotations

from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.loops.workspace.mapped import (
    CUT_OFF,
    LIMIT,
    OPEN,
    OTHER,
    SINGULAR,
    WORDS,
    Workspace,
)
from thesis_pin.report.curves import ORANGE, PURPLE, SKY, VERMILLION
from thesis_pin.report.figures import default_style, figure_files, new_figure
from thesis_pin.report.workspace.lines import condition_line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh
    from matplotlib.figure import Figure

SHADES = {
    OPEN: "#d9d9d9",
    LIMIT: ORANGE,
    SINGULAR: VERMILLION,
    OTHER: SKY,
    CUT_OFF: "#f2f2f2",
}
"""Colours of cells that aren't reachable, by their state."""

BORDER = PURPLE
"""Colour of the line on which the motors lose the frame."""


@default_style()
def workspace_figure(space: Workspace) -> Figure:
    """Condition over a line, over a plane, or over the three middle planes of a volume."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    wide = [k for k, size in enumerate(space.grid.shape) if size > 1]
    if len(wide) == 1:
        return _line(space, wide[0])
    normals: list[int | None] = list(range(3)) if len(wide) == 3 else [None]
    figure, axes = new_figure(6.0 * len(normals), 5.4, 1, len(normals))
    values = np.log10(space.condition[space.reachable])
    top = max(float(np.quantile(values, 0.98)) if values.size else 1.0, 0.1)
    drawn = [
        _plane(ax, space, normal, wide, top) for ax, normal in zip(axes[0], normals, strict=True)
    ]
    shown = [k for k in SHADES if (space.state == k).any()]
    handles: list[object] = [Patch(color=SHADES[k], label=WORDS[k]) for k in shown]
    if any(crossed for _, crossed in drawn):
        handles.append(Line2D([], [], color=BORDER, label="determinant changes sign"))
    if handles:
        figure.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=9)
    below = len(normals) > 1  # beside three planes the bar would cover a title
    figure.colorbar(
        drawn[-1][0],
        ax=list(axes[0]),
        label="log10 of the condition number",
        location="bottom" if below else "right",
        aspect=40 if below else 20,
        shrink=0.6 if below else 1.0,
    )
    figure.suptitle(
        "\n".join(
            wrap(
                f"{space.robot.model.name}: condition number {space.measure.said()}",
                75 * len(normals),
            )
        ),
        size=10,
    )
    return figure


def _plane(
    ax: Axes, space: Workspace, normal: int | None, wide: list[int], top: float
) -> tuple[QuadMesh, bool]:
    """One plane of cells; whether the determinant changes its sign in it."""
    from matplotlib.colors import ListedColormap

    grid = space.grid
    across, up = (k for k in wide if k != normal)
    middle = 0 if normal is None else grid.shape[normal] // 2

    def cut(values: np.ndarray) -> np.ndarray:
        for k in range(len(grid.shape) - 1, -1, -1):
            if k not in (across, up):
                values = np.take(values, middle if k == normal else 0, axis=k)
        return values.T

    where = grid.axes[across].values, grid.axes[up].values
    state, condition = cut(space.state), cut(space.condition)
    shades = np.ma.masked_equal(state.astype(float), 0)
    colours = ListedColormap([SHADES.get(k, "#ffffff") for k in range(len(WORDS))])
    ax.pcolormesh(*where, shades, shading="nearest", cmap=colours, vmin=-0.5, vmax=len(WORDS) - 0.5)
    image = ax.pcolormesh(
        *where, np.log10(condition), shading="nearest", cmap="viridis", vmin=0, vmax=top
    )
    sign = np.sign(cut(space.determinant))
    crossed = bool((sign < 0).any() and (sign > 0).any())
    if crossed:
        ax.contour(*where, sign, levels=[0.0], colors=BORDER)
    title = "" if normal is None else f"{grid.axes[normal].name} = "
    if normal is not None:
        title += f"{grid.axes[normal].values[middle]:.3g} {grid.axes[normal].unit}"
    units = [grid.axes[k].unit for k in (across, up)]
    ax.set(
        xlabel=f"{grid.axes[across].name} [{units[0]}]",
        ylabel=f"{grid.axes[up].name} [{units[1]}]",
        title=title,
        aspect="equal" if units[0] == units[1] else "auto",
    )
    return image, crossed


def _line(space: Workspace, axis: int) -> Figure:
    """Condition over one coordinate."""
    figure, axes = new_figure(8.0, 4.0)
    ax, along, state = axes[0, 0], space.grid.axes[axis], space.state.ravel()
    missing = [(WORDS[k], shade, state == k) for k, shade in SHADES.items()]
    border = ("determinant changes sign", BORDER)
    condition, determinant = space.condition.ravel(), space.determinant.ravel()
    condition_line(ax, along.values, condition, determinant, missing, border)
    ax.set(
        xlabel=f"{along.name} [{along.unit}]",
        title=f"{space.robot.model.name}: condition number {space.measure.said()}",
    )
    return figure


def workspace_files(space: Workspace) -> dict[str, bytes]:
    """A workspace as PNG and SVG: file name → content."""
    return figure_files("workspace", workspace_figure(space))
