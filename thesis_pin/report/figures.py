"""Plots as files: drawn by Matplotlib, the same on every machine.

Plots are laid out by :mod:`thesis_pin.report.plotting`, other pictures by Matplotlib's
figures. A user's matplotlibrc, styles, TeX and backend have no say: everything is drawn
under Matplotlib's own defaults, without a display and without pyplot.
"""

from __future__ import annotations

import io
import os
import sys
import warnings
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
from thesis_pin.report.plotting.sheet import Sheet, fitted, pdf, png, svg
from thesis_pin.report.plotting.wanted import Wanted, wanted_now

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_TRIES = 16
"""Times that texts shrink, by 0.85 each: to a thirteenth."""

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
        width: Width [inch] unless one is :class:`Wanted`; it gets wider and higher where axes
            would vanish.
        height: Height [inch], likewise.
        title: Headline above all; empty for none.
    """
    width, height = wanted_now().size or (width, height)
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
    """A figure as ``name.png`` and ``name.svg``, the same bytes for the same figure.

    Or in the formats and the size that are :class:`Wanted`: what needs more room is drawn
    smaller, so that no label is ever cut.
    """
    import matplotlib as mpl

    with mpl.rc_context({"svg.hashsalt": name}):
        wanted = wanted_now()
        if not isinstance(figure, Sheet):
            return _general(name, figure, wanted)
        if wanted.size is not None:
            figure = fitted(figure, *wanted.size)
        drawn = {"png": lambda: png(figure, wanted.dots), "svg": lambda: svg(figure)}
        drawn["pdf"] = lambda: pdf(figure)
        return {f"{name}.{form}": drawn[form]() for form in wanted.formats}


def _general(name: str, figure: Figure, wanted: Wanted) -> dict[str, bytes]:
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.backends.backend_pdf import FigureCanvasPdf
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    # Laid out once, and each format drawn once: savefig does both again and again.
    figure.set_dpi(wanted.dots)
    if wanted.size is not None:
        _fit(figure, *wanted.size)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    found = {}
    for form in wanted.formats:
        content = io.BytesIO()
        if form == "png":
            figure.set_dpi(wanted.dots)  # which print_pdf changes
            FigureCanvasAgg(figure).print_png(content, metadata={"Software": None})
        elif form == "svg":
            FigureCanvasSVG(figure).print_svg(content, metadata={"Date": None})
        else:
            with mpl.rc_context({"pdf.fonttype": 42}):
                FigureCanvasPdf(figure).print_pdf(content, metadata={"CreationDate": None})
        found[f"{name}.{form}"] = content.getvalue()
    return found


def _fit(figure: Figure, width: float, height: float) -> None:
    """Give a figure a size [inch], and its texts one at which none is cut."""
    from matplotlib.text import Text

    figure.set_size_inches(width, height)
    engine = figure.get_layout_engine()
    for _ in range(_TRIES):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            if engine is not None:
                engine.execute(figure)
        box = figure.get_tightbbox()
        spare = min(box.x0, box.y0, width - box.x1, height - box.y1)
        if not told and spare >= 0.0:
            return
        for text in figure.findobj(Text):
            text.set_fontsize(0.85 * float(text.get_fontsize()))
