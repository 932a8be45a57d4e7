"""A report as one self-contained page: verdict, animation, plots, tables.

Plots are plotly figures, given as data and drawn by plotly.js inside the page.
Every text goes through the template's escaping; data can't end its script.
"""

from __future__ import annotations

import json
import platform
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from thesis_pin.pages import player as viewer
from thesis_pin.pages.scene import Scene

MARGINS = {"l": 58, "r": 14, "t": 12, "b": 44}
"""Fixed, so that the page can place its time cursor over a plot."""

_SOFTWARE = ("thesis-pin", "pin", "numpy", "scipy", "meshcat", "plotly")


@dataclass(frozen=True)
class Tile:
    """One number at the top of a report.

    Attributes:
        label: What it is.
        value: The number with its unit.
        good: Whether it is within its limit; None if it has none.
    """

    label: str
    value: str
    good: bool | None = None


@dataclass(frozen=True)
class Series:
    """One curve of a plot over time.

    Attributes:
        name: Legend.
        values: Shape ``(n,)``; NaN leaves a gap.
        colour: ``#rrggbb``.
        dash: Plotly's ``solid``, ``dot``, ``dash`` …
    """

    name: str
    values: np.ndarray
    colour: str
    dash: str = "solid"


@dataclass(frozen=True)
class Plot:
    """A plotly figure with its headings.

    Attributes:
        title: Heading.
        text: What is to be seen in it, in a sentence; also its alternative text.
        figure: ``{"data": […], "layout": {…}}``.
        over_time: Whether its x axis is the motion's time, so that it follows the animation.
    """

    title: str
    text: str
    figure: dict[str, Any]
    over_time: bool = True


@dataclass(frozen=True)
class Table:
    """A table; the first column is text, the others are numbers unless ``prose``."""

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""
    prose: bool = False


@dataclass(frozen=True)
class Page:
    """A report before it becomes HTML.

    Attributes:
        title, subtitle: Headline.
        good: Whether the answer is yes.
        verdict: Sentences, the most important first.
        tiles: Key numbers.
        plots, tables: In order; may be empty.
        scene: The animation; None for a page without.
    """

    title: str
    subtitle: str
    good: bool
    verdict: Sequence[str]
    tiles: Sequence[Tile]
    plots: Sequence[Plot]
    tables: Sequence[Table]
    scene: Scene | None = None


def html(page: Page) -> bytes:
    """The page as one file that needs no network."""
    return viewer.render(
        "report.html",
        page=page,
        plots=_plot_parts(page.plots) if page.plots else None,
        margins=MARGINS,
        player_parts=viewer.player_parts(page.scene) if page.scene else None,
        report_script=viewer.web_file("report.js"),
        report_style=viewer.web_file("report.css"),
        unpack=viewer.web_file("unpack.js"),
    )


def _plot_parts(plots: Sequence[Plot]) -> dict[str, str]:
    return {
        "library": viewer.packed(viewer.package_file("plotly", "package_data/plotly.min.js")),
        "figures": viewer.packed(_json([plot.figure for plot in plots])),
    }


def software() -> Table:
    """Versions of what worked the report out."""
    rows = [("Python", platform.python_version())]
    for name in _SOFTWARE:
        try:
            rows.append((name, version(name)))
        except PackageNotFoundError:
            from thesis_pin.version import __version__

            rows.append((name, __version__ if name == "thesis-pin" else "not installed"))
    return Table("Software", ("package", "version"), rows, prose=True)


def assumptions_table(assumptions: Iterable[Mapping[str, Any]]) -> Table:
    """Numbers a thesis leaves open: dictionaries with ``name``, ``why`` and values."""
    rows = [
        (
            str(entry["name"]).replace("_", " "),
            ", ".join(
                f"{k} {v:g}" if isinstance(v, float) else f"{k} {v}"
                for k, v in entry.items()
                if k not in ("name", "why")
            ),
            str(entry["why"]),
        )
        for entry in assumptions
    ]
    return Table("Assumptions", ("what", "value", "why"), rows, prose=True)


def time_plot(
    title: str,
    text: str,
    unit: str,
    time: np.ndarray,
    series: Sequence[Series],
    *,
    limits: Sequence[tuple[str, float]] = (),
    bands: Sequence[tuple[float, float, str]] = (),
    zero: bool = True,
) -> Plot:
    """Curves over time with their limits.

    Args:
        title: Heading.
        text: What is to be seen.
        unit: Quantity and unit of the y axis.
        time: Sample times [s], shape ``(n,)``.
        series: The curves.
        limits: Dashed black lines with their names.
        bands: Intervals of time shaded in a colour.
        zero: Whether the y axis always shows zero.
    """
    data: list[dict[str, Any]] = [
        {
            "type": "scatter",
            "mode": "lines",
            "name": curve.name,
            "x": _short(time),
            "y": _short(curve.values),
            "line": {"color": curve.colour, "dash": curve.dash, "width": 1.8},
            "hovertemplate": "%{y:.4g} at %{x:.3f} s",
        }
        for curve in series
    ]
    ends = [float(time[0]), float(time[-1])]
    data += [
        {
            "type": "scatter",
            "mode": "lines",
            "name": name,
            "x": ends,
            "y": [value, value],
            "line": {"color": "#000000", "dash": "dash", "width": 1.2},
            "showlegend": k == 0 or name != limits[k - 1][0],
            "legendgroup": name,
            "hoverinfo": "skip",
        }
        for k, (name, value) in enumerate(limits)
    ]
    shapes = [
        {
            "type": "rect",
            "xref": "x",
            "yref": "paper",
            "x0": start,
            "x1": end,
            "y0": 0,
            "y1": 1,
            "fillcolor": colour,
            "opacity": 0.16,
            "line": {"width": 0},
            "layer": "below",
        }
        for start, end, colour in bands
    ]
    layout = base_layout("time [s]", unit) | {"shapes": shapes}
    layout["xaxis"] |= {"range": ends}
    if zero:
        layout["yaxis"] |= {"rangemode": "tozero"}
    return Plot(title, text, {"data": data, "layout": layout})


def base_layout(x: str, y: str) -> dict[str, Any]:
    """What all plots share."""
    axis = {"gridcolor": "#e3e7eb", "zerolinecolor": "#9aa0a6", "automargin": False}
    return {
        "margin": MARGINS | {"b": 44},
        "font": {"family": "system-ui, sans-serif", "size": 13, "color": "#1a1a1a"},
        "paper_bgcolor": "#ffffff",
        "plot_bgcolor": "#ffffff",
        "xaxis": axis | {"title": {"text": x, "standoff": 6}},
        "yaxis": axis | {"title": {"text": y, "standoff": 4}},
        "legend": {"orientation": "h", "y": -0.2, "yanchor": "top", "font": {"size": 12}},
        "hovermode": "closest",
    }


def _short(values: np.ndarray) -> list[float | None]:
    """Numbers with five digits; NaN becomes None, a gap."""
    return [None if v != v else float(f"{v:.5g}") for v in np.asarray(values, dtype=float)]


def _json(document: Any) -> bytes:
    return json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
