"""Plots as figures of plotly: data that plotly.js draws inside a page."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.report.curves import BLACK, STROKES, Area, Band, Curve, Limit, Plot, condensed

MARGINS = {"l": 74, "r": 14, "t": 12, "b": 44}
"""Fixed, so that the page can place its time cursor over a plot; room for ticks as −0.0015."""

STRETCHES = 600
"""Of a plot's x axis: about as many as it has columns of pixels."""

_DIGITS = 5

_MARKS: dict[str, dict[str, object]] = {"dot": {"size": 4}, "cross": {"size": 6, "symbol": "x"}}


def figure(plot: Plot) -> dict[str, object]:
    """A plot as ``{"data": […], "layout": {…}}``, JSON-ready."""
    plot = condensed(plot, STRETCHES)
    axis = {"gridcolor": "#e3e7eb", "zerolinecolor": "#9aa0a6", "automargin": False}
    axis |= {"exponentformat": "e"}  # a micro of nothing is no unit
    x: dict[str, object] = axis | {"title": {"text": plot.across, "standoff": 6}}
    y: dict[str, object] = axis | {"title": {"text": plot.label, "standoff": 4}}
    ends: list[float] = []
    if plot.time is None:
        y["scaleanchor"] = "x"
    else:
        ends = [float(plot.time[0]), float(plot.time[-1])]
        x["range"] = ends
        y["rangemode"] = "tozero"
    layout = {
        "margin": MARGINS,
        "font": {"family": "system-ui, sans-serif", "size": 13, "color": "#1a1a1a"},
        "paper_bgcolor": "#ffffff",
        "plot_bgcolor": "#ffffff",
        "xaxis": x,
        "yaxis": y,
        "legend": {"orientation": "h", "y": -0.2, "yanchor": "top", "font": {"size": 12}},
        "hovermode": "closest",
        "shapes": [_band(band) for band in plot.bands],
    }
    areas, limits = [area.name for area in plot.areas], [limit.name for limit in plot.limits]
    data = [
        *(_area(area, area.name in areas[:k]) for k, area in enumerate(plot.areas)),
        *(_curve(plot, curve) for curve in plot.curves),
        *(_limit(limit, ends, limit.name in limits[:k]) for k, limit in enumerate(plot.limits)),
    ]
    return {"data": data, "layout": layout}


def _curve(plot: Plot, curve: Curve) -> dict[str, object]:
    over = "%{y:.4g} at %{x:.3f} s" if plot.time is not None else "%{x:.4g}, %{y:.4g}"
    trace: dict[str, object] = {
        "type": "scatter",
        "name": curve.name,
        "x": _short(plot.places(curve)),
        "y": _short(curve.y),
        "hovertemplate": over,
    }
    if curve.marks:
        return trace | {"mode": "markers", "marker": _MARKS[curve.marks] | {"color": curve.colour}}
    width = 1.8 * curve.weight
    # Plotly's own names mean other lengths, as long as a legend's sample of them.
    strokes = ",".join(f"{width * part:.3g}px" for part in STROKES[curve.dash])
    line = {"color": curve.colour, "dash": strokes or "solid", "width": width}
    return trace | {"mode": "lines", "line": line}


def _limit(limit: Limit, ends: list[float], again: bool) -> dict[str, object]:
    return {
        "type": "scatter",
        "mode": "lines",
        "name": limit.name,
        "x": ends,
        "y": [limit.value, limit.value],
        "line": {"color": BLACK, "dash": "dash", "width": 1.2},
        "showlegend": not again,
        "legendgroup": limit.name,
        "hoverinfo": "skip",
    }


def _area(area: Area, again: bool) -> dict[str, object]:
    closed = np.vstack([area.corners, area.corners[:1]])
    red, green, blue = (int(area.colour[k : k + 2], 16) for k in (1, 3, 5))
    return {
        "type": "scatter",
        "mode": "lines",
        "name": area.name,
        "legendgroup": area.name,
        "showlegend": not again,
        "x": _short(closed[:, 0]),
        "y": _short(closed[:, 1]),
        "fill": "toself" if area.filled else "none",
        "fillcolor": f"rgba({red},{green},{blue},0.3)",
        "line": {"color": area.colour, "dash": "dot", "width": 1.3 if area.edged else 0},
        "hoverinfo": "skip",
    }


def _band(band: Band) -> dict[str, object]:
    return {
        "type": "rect",
        "xref": "x",
        "yref": "paper",
        "x0": band.start,
        "x1": band.end,
        "y0": 0,
        "y1": 1,
        "fillcolor": band.colour,
        "opacity": 0.16,
        "line": {"width": 0},
        "layer": "below",
    }


def _short(values: ArrayLike) -> list[float | None]:
    """Numbers with five digits of what they range over; NaN and infinity become None, a gap."""
    values = np.asarray(values, dtype=float)
    some = values[np.isfinite(values)]
    size, span = np.abs(some).max(initial=0.0), np.ptp(some) if some.size else 0.0
    # Times of a log, say, are seconds since 1970.
    more = math.ceil(math.log10(size / span)) if 0.0 < span < size else 0
    digits = min(_DIGITS + more, 17)
    return [float(f"{v:.{digits}g}") if math.isfinite(v) else None for v in values]
