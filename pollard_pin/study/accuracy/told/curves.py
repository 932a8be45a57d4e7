"""What an accuracy study's figures and page draw."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.study.accuracy.result import AccuracyNumbers
from pollard_pin.study.accuracy.told.document import sensitivities_csv
from pollard_pin.study.accuracy.told.verdict import LEVEL
from thesis_pin.report.curves import BLUE, GREEN, PURPLE, SKY, VERMILLION, Curve, Limit, Plot
from thesis_pin.report.figures import default_style, figure_files, new_figure, panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BARS = 16
"""Tolerances that are drawn as bars."""


def plots(study: AccuracyNumbers) -> list[Plot]:
    """Errors along a path, or along a workspace's only axis; none of other workspaces."""
    if study.time is not None:
        return [distances(study), axes(study), directions(study)]
    return [along_axis(study)] if len(wide_axes(study)) == 1 else []


def wide_axes(study: AccuracyNumbers) -> list[int]:
    """Axes of a workspace that have more than one value."""
    assert study.space is not None
    return [k for k, axis in enumerate(study.space.axes) if len(axis) > 1]


def along_axis(study: AccuracyNumbers) -> Plot:
    """How far off the tip may be along a line of positions; gaps where it can't be."""
    space, (axis,) = study.space, wide_axes(study)
    assert space is not None
    stack = study.stack
    worst, root = (_on_grid(study, x).ravel() * 1e3 for x in (stack.farthest, _sound_root(study)))
    limits = [] if study.limit is None else [Limit("allowed", study.limit * 1e3)]
    return Plot(
        "Distance of the spray tip from its place",
        "At the worst signs of all errors, and by the root of the sum of squares; gaps where there "
        "is no bound, and where what is linear in the errors means little.",
        "distance [mm]",
        [
            Curve("at worst", worst, VERMILLION),
            Curve("root of the sum of squares", root, BLUE, "dash"),
        ],
        space.axes[axis],
        across=f"{'xyz'[axis]} [m]",
        limits=limits,
    )


def distances(study: AccuracyNumbers) -> Plot:
    """How far off the tip may be along a path."""
    stack, draws = study.stack, study.draws
    curves = [
        Curve("at worst", _drawable(stack.farthest) * 1e3, VERMILLION),
        Curve("root of the sum of squares", _sound_root(study) * 1e3, BLUE, "dash"),
    ]
    if draws is not None and draws.assembled.any():
        level = np.quantile(draws.distance[draws.assembled], LEVEL, axis=0) * 1e3
        curves.append(Curve(f"{LEVEL:.0%} of drawn robots", level, GREEN, "dashdot"))
    limits = [] if study.limit is None else [Limit("allowed", study.limit * 1e3)]
    return Plot(
        "Distance of the spray tip from its place",
        "At the worst signs of all errors, by the root of the sum of squares, of drawn robots.",
        "distance [mm]",
        curves,
        study.time,
        limits=limits,
    )


def axes(study: AccuracyNumbers) -> Plot:
    """How far off the tip may be along each axis."""
    values = study.stack.components * 1e3
    return Plot(
        "Along each axis, at worst",
        "Each at the worst signs of all errors for it.",
        "distance [mm]",
        [
            Curve("x", values[:, 0], BLUE),
            Curve("y", values[:, 1], VERMILLION, "dash"),
            Curve("z", values[:, 2], GREEN, "dashdot"),
        ],
        study.time,
    )


def directions(study: AccuracyNumbers) -> Plot:
    """How far off the spray direction may be."""
    return Plot(
        "Spray direction",
        "Angle to the planned one.",
        "angle [°]",
        [
            Curve("at worst", np.degrees(study.stack.worst_turn), PURPLE),
            Curve("root of the sum of squares", np.degrees(study.stack.root_turn), SKY, "dash"),
        ],
        study.time,
    )


@default_style()
def bars_figure(study: AccuracyNumbers) -> Figure:
    """What moves the tip farthest, tolerance by tolerance."""
    some = [one for one in study.contributions if one.reach > 0][:BARS]
    figure, grid = new_figure(8.0, 1.2 + 0.3 * max(len(some), 1))
    ax, place = grid[0, 0], np.arange(len(some))
    ax.barh(place, [one.reach * 1e3 for one in some], color=BLUE, height=0.7)
    for k, one in enumerate(some):
        ax.annotate(
            f" {one.reach * 1e3:.2g} mm, {one.share:.1%} of the variance",
            (one.reach * 1e3, k),
            va="center",
            fontsize=8,
        )
    unit = {"mm": "mm", "deg": "°"}
    names = [
        f"{one.parameter.name}  ±{one.tolerance.written:.3g} {unit[one.parameter.unit]}"
        for one in some
    ]
    ax.set_yticks(place, names, fontsize=8)
    ax.invert_yaxis()
    ax.set_xlim(0.0, 1.5 * max([one.reach * 1e3 for one in some], default=1.0))
    level = "largest on the path" if study.space is None else "median of the positions"
    ax.set(xlabel=f"what it moves the spray tip by [mm], {level}")
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    return figure


@default_style()
def map_figure(study: AccuracyNumbers) -> Figure:
    """Worst distance over a slice, or over the three middle slices of a volume."""
    from matplotlib.colors import LogNorm
    from matplotlib.ticker import NullFormatter

    space = study.space
    assert space is not None
    value = _on_grid(study, study.stack.farthest) * 1e3
    lost = space.reachable & np.isfinite(space.condition) & np.isnan(value)
    sizes = [len(axis) for axis in space.axes]
    thin = [k for k in range(3) if sizes[k] == 1]
    normals = thin[:1] if thin else [0, 1, 2]
    figure, grid = new_figure(6.0 * len(normals), 5.0, 1, len(normals))
    finite = value[np.isfinite(value)]
    low = float(finite.min()) if finite.size else 1.0
    high = float(np.quantile(finite, 0.95)) if finite.size else 10.0
    scale = LogNorm(low, max(high, low * 1.1))
    outlined = False
    for ax, normal in zip(grid[0], normals, strict=True):
        across, up = (k for k in range(3) if k != normal)
        middle = sizes[normal] // 2
        at = (space.axes[across], space.axes[up])
        gone = np.where(np.take(lost, middle, axis=normal), 1.0, np.nan)
        ax.pcolormesh(*at, gone.T, shading="nearest", cmap="gray_r", vmin=0.0, vmax=2.0)
        shown = np.take(value, middle, axis=normal)
        image = ax.pcolormesh(*at, shown.T, shading="nearest", cmap="viridis", norm=scale)
        if study.limit is not None and min(shown.shape) > 1 and np.isfinite(shown).any():
            level = np.where(np.isnan(shown), np.inf, shown)
            inside = np.where(level <= study.limit * 1e3, 1.0, 0.0)
            if 0.0 < inside.mean() < 1.0:
                outlined = True
                ax.contour(*at, inside.T, levels=[0.5], colors=VERMILLION)
        names = "xyz"
        ax.set(
            xlabel=f"{names[across]} [m]",
            ylabel=f"{names[up]} [m]",
            title=f"{names[normal]} = {space.axes[normal][middle]:.3g} m",
            aspect="equal" if min(sizes[across], sizes[up]) > 1 else "auto",
        )
    bar = figure.colorbar(
        image, ax=list(grid[0]), label="spray tip off at worst [mm]", extend="max"
    )
    ticks = _round_numbers(scale.vmin or low, scale.vmax or high)
    bar.set_ticks(ticks, labels=[f"{one:g}" for one in ticks])
    bar.ax.yaxis.set_minor_formatter(NullFormatter())
    said = ["grey: some robot within tolerances can't be assembled"] if lost.any() else []
    if study.limit is not None and outlined:
        said.append(f"orange: within {study.limit * 1e3:g} mm")
    if said:
        figure.suptitle("; ".join(said), size=9)
    return figure


def figures(study: AccuracyNumbers) -> dict[str, bytes]:
    """The study's figures, and its table of tolerances: file name → content."""
    files = {"sensitivities.csv": sensitivities_csv(study)}
    files |= figure_files("contributions", bars_figure(study))
    if study.space is not None:
        wide = len(wide_axes(study))
        if wide == 1:
            files |= figure_files("map", panels([plots(study)], 8, 4))
        return files | (figure_files("map", map_figure(study)) if wide > 1 else {})
    return files | figure_files("errors", panels([[plot] for plot in plots(study)], 8, 8))


def _round_numbers(low: float, high: float) -> list[float]:
    """1, 2, 5 times powers of ten between two numbers."""
    powers = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    every = [float(f"{one}e{power}") for power in powers for one in (1, 2, 5)]
    return [one for one in every if low <= one <= high]


def _sound_root(study: AccuracyNumbers) -> np.ndarray:
    """Root of the sum of squares, with gaps where what is linear means little."""
    return np.where(study.bent, np.nan, study.stack.root)


def _on_grid(study: AccuracyNumbers, values: np.ndarray) -> np.ndarray:
    """Values of the poses on the workspace's grid; NaN where there are none, or no bound."""
    space = study.space
    assert space is not None
    there = space.reachable & np.isfinite(space.condition)
    found = np.full(there.shape, np.nan)
    found[there] = _drawable(values)
    return found


def _drawable(values: np.ndarray) -> np.ndarray:
    """Values with gaps where there is no bound."""
    return np.where(np.isfinite(values), values, np.nan)
