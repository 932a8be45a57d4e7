"""Plots as files: drawn by Matplotlib, the same on every machine.

Plots are laid out by :mod:`thesis_pin.report.plotting`, other pictures by Matplotlib's
figures. A user's matplotlibrc, styles, TeX and backend have no say: everything is drawn
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
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.report.curves import Plot, condensed
from thesis_pin.report.plotting.grid import arranged
from thesis_pin.report.plotting.panel import panel
from thesis_pin.report.plotting.sheet import DOTS, Sheet, png, svg

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STRETCHES = 1333
"""Of a plot's x axis: as many as the widest has columns of pixels."""


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
def panels(rows: Sequence[Sequence[Plot]], width: float, height: float, title: str = "") -> Sheet:
    """Plots side by side and one below the other.

    Args:
        rows: Rows of equally many plots; those of a row that name the same things share a legend.
        width: Width [inch]; it gets wider and higher where axes would vanish.
        height: Height [inch].
        title: Headline above all; empty for none.
    """
    table = [[panel(condensed(plot, STRETCHES)) for plot in row] for row in rows]
    return arranged(table, width, height, title)


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
def figure_files(name: str, figure: Sheet | Figure) -> dict[str, bytes]:
    """A figure as ``name.png`` and ``name.svg``, the same bytes for the same figure."""
    import matplotlib as mpl

    with mpl.rc_context({"svg.hashsalt": name}):
        if isinstance(figure, Sheet):
            return {f"{name}.png": png(figure), f"{name}.svg": svg(figure)}
        return _general(name, figure)


def _general(name: str, figure: Figure) -> dict[str, bytes]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    # Laid out once, and each format drawn once: savefig does both again and again.
    figure.set_dpi(DOTS)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    raster, vector = io.BytesIO(), io.BytesIO()
    FigureCanvasAgg(figure).print_png(raster, metadata={"Software": None})
    FigureCanvasSVG(figure).print_svg(vector, metadata={"Date": None})
    return {f"{name}.png": raster.getvalue(), f"{name}.svg": vector.getvalue()}
