"""Condition numbers over one coordinate of a workspace, and where there are none."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def condition_line(
    ax: Axes,
    where: np.ndarray,
    condition: np.ndarray,
    determinant: np.ndarray,
    missing: Iterable[tuple[str, str, np.ndarray]],
    border: tuple[str, str],
) -> None:
    """Draw condition numbers over a coordinate.

    Args:
        ax: Where to.
        where: Values of the coordinate, shape ``(n,)``.
        condition: Condition numbers, NaN where there are none, shape ``(n,)``.
        determinant: Its sign parts the workspace, shape ``(n,)``.
        missing: Word, colour and places of each reason for there being none.
        border: Word and colour of the lines at which the determinant changes its sign.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    there = bool(np.isfinite(condition).any())
    if there:
        ax.plot(where, condition, ".-", color="black", markersize=3, label="condition number")
    for word, colour, places in missing:
        if places.any():  # at the lower edge, whatever the scale
            low = np.full(int(places.sum()), 0.03)
            edge = ax.get_xaxis_transform()
            ax.plot(where[places], low, ".", color=colour, label=word, transform=edge)
    sign = np.sign(determinant)
    for k in np.flatnonzero(sign[1:] * sign[:-1] < 0):
        ax.axvline((where[k] + where[k + 1]) / 2, color=border[1], label=border[0])
    named = dict(zip(*reversed(ax.get_legend_handles_labels()), strict=True))
    if set(named) != {"condition number"}:
        ax.legend(named.values(), named.keys(), fontsize=8)
    ax.set(ylabel="condition number", yscale="log")
    if not there:
        ax.set_ylim(1, 100)
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.grid(alpha=0.3)
