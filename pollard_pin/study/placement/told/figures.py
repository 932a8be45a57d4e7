"""PlacementNumbers as a picture: the objective over positions, and why others can't be followed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.study.placement.judged import (
    ACTUATION,
    ARMS,
    CONDITION,
    FOLLOWED,
    LIMITS,
    OUT,
    REASONS,
    SERIAL,
    SPEED,
    TORQUE,
    WEIGHT,
)
from pollard_pin.study.placement.result import PlacementNumbers
from thesis_pin.report.curves import GREEN, ORANGE, PURPLE, SKY, VERMILLION
from thesis_pin.report.figures import default_style, figure_files, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh
    from matplotlib.figure import Figure

SHADES = {
    OUT: "#d9d9d9",
    LIMITS: ORANGE,
    SERIAL: SKY,
    ACTUATION: PURPLE,
    ARMS: "#f0e442",
    CONDITION: "#bcbd22",
    TORQUE: VERMILLION,
    SPEED: "#8c564b",
    WEIGHT: "#4d4d4d",
}
"""Colours of placements that can't be followed, by their reason."""

_MOST = 8  # slices of a volume that are drawn
_ROW = 4  # of them beside each other
_HIGHEST = 0.9  # quantile of what is to be small at which colours end


def shown(space: PlacementNumbers) -> tuple[np.ndarray, str]:
    """What is drawn of each placement of the grid, and what it is called; NaN for nothing."""
    judged, fine = space.judged, space.judged.reason == FOLLOWED
    effort, _ = space.robot.specification.assumptions.joint_limits.of_motors()
    if space.objective == "torque" and np.ptp(effort) == 0.0:
        value, label = judged.torque.max(axis=1), "largest peak torque of a motor [N·m]"
    elif space.objective == "torque":
        value, label = (
            100 * (judged.torque / effort).max(axis=1),
            "largest use of a torque limit [%]",
        )
    elif space.objective == "conditioning":
        value, label = judged.condition, "largest condition number"
    elif space.objective == "clearance":
        value, label = judged.clearance, "clearance: least sine of the singular sets"
    else:
        held = np.where(judged.pace > 0, judged.pace, np.nan)
        value, label = space.path.duration / held, "shortest time [s]"
    return np.where(fine, value, np.nan), label


def flattened(space: PlacementNumbers) -> tuple[np.ndarray, np.ndarray]:
    """Values and reasons over x, y, z, the best of all turns, images and branches."""
    value, _ = shown(space)
    shape = (-1, *space.choices.shape[3:])
    values, reasons = value.reshape(shape), space.judged.reason.reshape(shape)
    cost = space.cost.reshape(shape)
    best = cost.argmin(axis=0)[None]
    value = np.take_along_axis(values, best, axis=0)[0]
    # Where nothing can be followed, the reason of what came nearest to it.
    return value, np.where(np.isfinite(value), FOLLOWED, reasons.max(axis=0))


@default_style()
def placements_figure(space: PlacementNumbers) -> Figure:
    """The objective over a line, a plane, or slices of a volume at equal heights."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    ranges = space.choices.ranges
    wide = [k for k in range(3) if len(ranges[k]) > 1]
    values, reasons = flattened(space)
    label = shown(space)[1]
    if len(wide) < 2:
        return _line(space, wide[0] if wide else None)
    normal = 2 if len(wide) == 3 else next(k for k in range(3) if k not in wide)
    slices = _slices(space, normal)
    columns = min(len(slices), _ROW)
    rows = -(-len(slices) // columns)
    figure, axes = new_figure(max(4.4 * columns + 1.2, 6.8), 3.9 * rows + 1.4, rows, columns)
    finite = values[np.isfinite(values)]
    ends = (0.0, 1.0)
    if finite.size:
        top = 1.0 if space.objective == "clearance" else _HIGHEST
        ends = (float(finite.min()), float(np.quantile(finite, top)))
    for ax in axes.ravel()[len(slices) :]:
        ax.set_axis_off()
    for ax, number in zip(axes.ravel(), slices, strict=False):
        image = _plane(ax, space, (normal, number), values, reasons, ends)
    handles: list[object] = [
        Patch(color=SHADES[k], label=REASONS[k]) for k in SHADES if (reasons == k).any()
    ]
    handles += [
        Line2D([], [], marker=mark, color="none", mec="black", mfc=fill, ms=size, label=word)
        for mark, fill, size, word in ((("*", "white", 13, "best"), ("o", GREEN, 7, "now")))
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=min(columns, 2), fontsize=9)
    beyond = "max" if finite.size and finite.max() > ends[1] else "neither"
    figure.colorbar(image, ax=list(axes.ravel()), label=label, extend=beyond)
    figure.suptitle(f"{space.path.name}: {label}{_over(space)}", size=10)
    return figure


def _over(space: PlacementNumbers) -> str:
    """Over what the best is taken that isn't drawn."""
    _, branches, turns = space.choices.shape[:3]
    what = [f"{turns} turns"] * (turns > 1) + [f"{branches} branches"] * (branches > 1)
    what += ["both images"] * (len(space.choices.mirrored) > 1)
    return f", best of {' and '.join(what)}" if what else ""


def _slices(space: PlacementNumbers, normal: int) -> list[int]:
    """Which slices are drawn: evenly spread ones, among them that of the best."""
    axis = space.choices.ranges[normal]
    numbers = np.linspace(0, len(axis) - 1, min(len(axis), _MOST)).round().astype(int)
    if space.best:
        best = int(np.abs(axis - space.best[0].placement.position[normal]).argmin())
        numbers[int(np.abs(numbers - best).argmin())] = best
    return sorted(set(numbers.tolist()))


def _plane(
    ax: Axes,
    space: PlacementNumbers,
    cut: tuple[int, int],
    values: np.ndarray,
    reasons: np.ndarray,
    ends: tuple[float, float],
) -> QuadMesh:
    """One slice: which axis is cut, and where."""
    from matplotlib.colors import ListedColormap

    normal, number = cut
    across, up = (k for k in range(3) if k != normal)
    ranges = space.choices.ranges
    where, axis = (ranges[across], ranges[up]), ranges[normal]
    why = np.take(reasons, number, axis=normal).T.astype(float)
    why[why == FOLLOWED] = np.nan
    colours = ListedColormap(["#ffffff", *SHADES.values()])
    ax.pcolormesh(*where, why, shading="nearest", cmap=colours, vmin=-0.5, vmax=len(REASONS) - 0.5)
    image = ax.pcolormesh(
        *where,
        np.take(values, number, axis=normal).T,
        shading="nearest",
        cmap="viridis",
        vmin=ends[0],
        vmax=ends[1],
        edgecolors="face",
    )
    marks = [(space.best[0].placement, "*", "white", 14.0)] if space.best else []
    for placement, mark, fill, size in (*marks, (space.start.placement, "o", GREEN, 7.0)):
        place = placement.position
        inside = all(
            ranges[k][0] - _half(ranges[k]) <= place[k] <= ranges[k][-1] + _half(ranges[k])
            for k in range(3)
        )
        if inside and int(np.abs(axis - place[normal]).argmin()) == number:
            ax.plot(place[across], place[up], mark, ms=size, mec="black", mfc=fill)
    names = "xyz"
    ax.set(
        xlabel=f"{names[across]} [m]",
        ylabel=f"{names[up]} [m]",
        title=f"{names[normal]} = {axis[number]:.4g} m",
        aspect="equal",
    )
    return image


def _half(axis: np.ndarray) -> float:
    return float(np.diff(axis).min()) / 2 if len(axis) > 1 else 1e-9


def _line(space: PlacementNumbers, wide: int | None) -> Figure:
    """The objective over one coordinate, or over the turn."""
    value, label = shown(space)
    shape, numbers = space.choices.shape, np.arange(space.choices.count)
    axis = 2 if wide is None else 3 + wide
    if wide is None:
        over, name = np.degrees(space.choices.turn), "turn [°]"
    else:
        over, name = space.choices.ranges[wide], f"{'xyz'[wide]} [m]"
    every = np.moveaxis(numbers.reshape(shape), axis, -1).reshape(-1, len(over))
    groups = [group for group in every if np.isfinite(value[group]).any()]
    figure, axes = new_figure(7.5, 4.2)
    ax = axes[0, 0]
    for group in groups:
        named = _named(space, int(group[0]), turns=wide is not None)
        ax.plot(over, value[group], "o-" if len(over) < _MARKED else "-", ms=4, label=named)
    if not groups:
        ax.text(0.5, 0.5, "the path can't be followed", transform=ax.transAxes, ha="center")
    if 1 < len(groups) <= _LABELLED:
        ax.legend(fontsize=8)
    ax.set(xlabel=name, ylabel=label, title=f"{space.path.name}: {label}")
    ax.grid(alpha=0.3)
    return figure


def _named(space: PlacementNumbers, number: int, *, turns: bool) -> str:
    """What a line is of that others aren't."""
    placement, branch = space.choices.at(number)
    words = [str(branch)] * (len(space.choices.branches) > 1)
    if len(space.choices.mirrored) > 1:
        words.append("mirror image" if placement.mirrored else "as it is")
    if turns and len(space.choices.turn) > 1:
        words.append(f"turned by {np.degrees(placement.turn):z.4g}°")
    return ", ".join(words)


_LABELLED = 16  # lines up to which each is named
_MARKED = 60  # values of a line below which each is marked


def placements_files(space: PlacementNumbers) -> dict[str, bytes]:
    """The map as PNG and SVG: file name → content."""
    return figure_files("placements", placements_figure(space))
