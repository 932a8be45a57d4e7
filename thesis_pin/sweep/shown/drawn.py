"""Designs as points of a plane: what could be had, and the Pareto front."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.curves import BLUE, GREEN, VERMILLION
from thesis_pin.report.figures import default_style, figure_files, new_figure
from thesis_pin.sweep.chosen.pareto import Aim
from thesis_pin.sweep.shown.choice import Choice

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PALE = "#b0b7bd"
"""Colour of designs that break a limit."""


@default_style()
def pareto_figure(choice: Choice) -> Figure:
    """Every judged design by the first two aims, by colour the third; the front as a line."""
    figure, axes = new_figure(8.0, 5.4)
    ax = axes[0, 0]
    across, up = (_numbers(choice, aim) for aim in choice.aims[:2])
    good, done = choice.sweep.feasible, choice.sweep.done
    broken = done & ~good
    ax.plot(across[broken], up[broken], ".", color=PALE, ms=4, label="breaks a limit")
    if len(choice.aims) > 2:
        third = choice.aims[2]
        points = ax.scatter(
            across[good], up[good], c=_numbers(choice, third)[good], s=16, cmap="viridis"
        )
        if good.any():
            figure.colorbar(points, ax=ax, label=f"{third.column.heading} ({_way(third)})")
    else:
        ax.plot(across[good], up[good], ".", color=BLUE, ms=6, label="keeps every limit")
    front = choice.front
    line = "-" if len(choice.aims) == 2 else ""
    if front.size:
        ax.plot(
            across[front],
            up[front],
            f"o{line}",
            drawstyle="steps-post",  # the front begins with the best by the first aim
            color=VERMILLION,
            mfc="none",
            ms=7,
            lw=1.2,
            label=f"Pareto front ({front.size})",
        )
    if choice.best is not None:
        what = "nearest to the wish" if choice.terms else "best"
        ax.plot(
            across[choice.best],
            up[choice.best],
            "*",
            color=GREEN,
            ms=15,
            label=f"{what}: {choice.best}",
        )
    first, second = choice.aims[:2]
    ax.set(
        xlabel=f"{first.column.heading} ({_way(first)})",
        ylabel=f"{second.column.heading} ({_way(second)})",
        title=f"{int(done.sum()):,} designs, {int(good.sum()):,} keep every limit",
    )
    ax.grid(alpha=0.3)
    if ax.get_legend_handles_labels()[0]:
        figure.legend(loc="outside lower center", ncols=2, fontsize=9)
    return figure


def _way(aim: Aim) -> str:
    return "less is better" if aim.sign > 0 else "more is better"


def _numbers(choice: Choice, aim: Aim) -> NDArray[np.float64]:
    return choice.sweep.numbers(aim.column.name)


def figures(choice: Choice) -> dict[str, bytes]:
    """The picture in the wanted formats: file name → content; none where nothing was judged."""
    return figure_files("pareto", pareto_figure(choice)) if choice.sweep.done.any() else {}
