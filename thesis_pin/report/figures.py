"""Plots as files: drawn by Matplotlib, the same on every machine.

A user's matplotlibrc, styles, TeX and backend have no say: everything is drawn
under Matplotlib's own defaults, without a display and without pyplot.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.report.curves import BLACK, Plot, condensed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STRETCHES = 1333
"""Of a plot's x axis: as many as the widest has columns of pixels."""

_LINES = {"solid": "-", "dash": "--", "dot": ":"}
_MARKS = {"dot": ".", "cross": "x"}


@contextmanager
def default_style() -> Iterator[None]:
    """Matplotlib's own defaults while a figure is made; also a decorator.

    Raises:
        BadInput: Matplotlib can't be imported because of a user's settings.
    """
    mpl = _matplotlib()
    # A backend belongs to windows, which nothing here opens.
    ours = {key: mpl.rcParamsDefault[key] for key in mpl.rcParamsDefault if key != "backend"}
    with mpl.rc_context(ours):
        yield


def _matplotlib() -> ModuleType:
    """Matplotlib, also where ``MPLBACKEND`` names a backend that doesn't exist."""
    if "matplotlib" in sys.modules:
        return import_module("matplotlib")
    backend = os.environ.pop("MPLBACKEND", None)
    try:
        mpl = import_module("matplotlib")
    except (ValueError, OSError) as error:
        raise BadInput(
            f"Matplotlib can't be imported: {error}",
            remedy="Mend the matplotlibrc in this folder, at $MATPLOTLIBRC or in your settings",
        ) from None
    finally:
        if backend is not None:
            os.environ["MPLBACKEND"] = backend
    if backend:  # what the program around us would have got from importing it
        with suppress(ValueError):
            mpl.rcParams["backend"] = backend
    return mpl


@default_style()
def panels(rows: Sequence[Sequence[Plot]], width: float, height: float, title: str = "") -> Figure:
    """Plots side by side and one below the other.

    Args:
        rows: Rows of equally many plots.
        width: Width [inch].
        height: Height [inch].
        title: Headline above all; empty for none.
    """
    figure, axes = new_figure(width, height, len(rows), len(rows[0]))
    for line, plots in zip(axes, rows, strict=True):
        for axis, plot in zip(line, plots, strict=True):
            _draw(axis, condensed(plot, STRETCHES))
    if title:
        figure.suptitle(title)
    return figure


def _draw(axis: Axes, plot: Plot) -> None:
    plane = plot.time is None
    for area in plot.areas:
        tint = {"facecolor": (area.colour, 0.3)} if area.filled else {"facecolor": "none"}
        edge = {"edgecolor": area.colour if area.edged else "none", "linestyle": ":"}
        axis.fill(*area.corners.T, label=area.name, **tint, **edge)
    for band in plot.bands:
        axis.axvspan(
            band.start, band.end, color=band.colour, alpha=0.16, linewidth=0, label=band.name
        )
    for curve in plot.curves:
        line: dict[str, Any] = {"linestyle": _LINES[curve.dash], "linewidth": 1 if plane else 1.5}
        if curve.marks:
            line = {"linestyle": "", "marker": _MARKS[curve.marks], "markersize": 4}
        axis.plot(plot.places(curve), curve.y, color=curve.colour, label=curve.name, **line)
    for limit in plot.limits:
        axis.axhline(limit.value, color=BLACK, linestyle="--", linewidth=1, label=limit.name)
    axis.set(title=plot.title, xlabel=plot.across, ylabel=plot.label)
    axis.grid(alpha=0.3)
    if plane:
        axis.set_aspect("equal")
    handles, labels = axis.get_legend_handles_labels()
    named = dict(zip(reversed(labels), reversed(handles), strict=True))  # the first of each name
    order = list(dict.fromkeys(labels))
    if len(order) > 1:
        beside = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}
        below = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.15), "ncols": 2}
        axis.legend(
            [named[name] for name in order], order, fontsize=8, **(below if plane else beside)
        )


def new_figure(
    width: float, height: float, rows: int = 1, columns: int = 1
) -> tuple[Figure, NDArray[np.object_]]:
    """A Matplotlib figure and its axes, drawn without a display or global state.

    Args:
        width: Width [inch].
        height: Height [inch].
        rows: Rows of the grid of axes.
        columns: Its columns.

    Returns:
        The figure and an array of axes, shape ``(rows, columns)``.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False)


@default_style()
def figure_files(name: str, figure: Figure) -> dict[str, bytes]:
    """A figure as ``name.png`` and ``name.svg``, the same bytes for the same figure."""
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    # Laid out once, and each format drawn once: savefig does both again and again.
    figure.set_dpi(150)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    png, svg = io.BytesIO(), io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": name}):
        FigureCanvasAgg(figure).print_png(png, metadata={"Software": None})
        FigureCanvasSVG(figure).print_svg(svg, metadata={"Date": None})
    return {f"{name}.png": png.getvalue(), f"{name}.svg": svg.getvalue()}
