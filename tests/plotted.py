"""Plots as plotly itself reads them from a page."""

import json

import numpy as np
import plotly.graph_objects

from thesis_pin.pages.plots import figure


def read(plot):
    """A plot as plotly itself reads it from the page."""
    return plotly.graph_objects.Figure(json.loads(json.dumps(figure(plot), allow_nan=False)))


def assert_arrives(plot):
    """Plotly holds all that a plot has, each curve with its name and numbers of five digits.

    Plots of up to as many samples as a page shows.
    """
    held = read(plot)
    areas, curves, limits = plot.areas, plot.curves, plot.limits
    assert [trace.name for trace in held.data] == [one.name for one in (*areas, *curves, *limits)]
    traces = held.data[len(areas) :]
    for curve, trace in zip(curves, traces[: len(curves)], strict=True):
        x = plot.time if curve.x is None else curve.x
        np.testing.assert_allclose(np.array(trace.x, dtype=float), x, rtol=5.1e-5)
        np.testing.assert_allclose(np.array(trace.y, dtype=float), curve.y, rtol=5.1e-5)
    assert [set(trace.y) for trace in traces[len(curves) :]] == [{one.value} for one in limits]
    assert [(one.x0, one.x1) for one in held.layout.shapes] == [
        (one.start, one.end) for one in plot.bands
    ]
    assert (held.layout.xaxis.title.text, held.layout.yaxis.title.text) == (plot.across, plot.label)
