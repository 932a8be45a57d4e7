"""Plots become figures that plotly accepts, with every number in them."""

import numpy as np
from pictured import shapes_of
from plotted import read

from thesis_pin.pages.plots import MARGINS, figure
from thesis_pin.report.curves import Area, Band, Curve, Limit, Plot, both_signs
from thesis_pin.report.figures import panels

TIME = np.linspace(0.0, 2.0, 5)
SQUARE = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]])


def test_curves_over_time_arrive_with_gaps_where_they_have_no_value():
    values = np.array([1.0, np.nan, 1 / 3, -2e-9, 123456.7])
    curve = Curve("knee", values, "#0072b2", "dot")
    drawn = read(Plot("t", "", "torque [N·m]", [curve], TIME))
    (trace,) = drawn.data
    np.testing.assert_array_equal(trace.x, TIME)
    assert trace.y == (1.0, None, 0.33333, -2e-9, 123460.0)
    assert (trace.name, trace.mode, trace.line.dash) == ("knee", "lines", "1.8px,2.97px")
    assert drawn.layout.xaxis.range == (0.0, 2.0)
    assert drawn.layout.yaxis.title.text == "torque [N·m]"


def test_what_is_far_from_zero_keeps_its_shape():
    """Times of a log are seconds since 1970."""
    time = 1732617283.25 + np.linspace(0.0, 0.6, 101)
    values = 1e3 + 1e-6 * np.sin(10 * (time - time[0]))
    (trace,) = read(Plot("t", "", "y", [Curve("c", values, "#000000")], time)).data
    np.testing.assert_allclose(np.array(trace.x), time, rtol=0, atol=1e-5)
    np.testing.assert_allclose(np.array(trace.y), values, rtol=0, atol=1e-10)


def test_infinity_is_a_gap():
    values = np.array([1.0, np.inf, 2.0, -np.inf, 3.0])
    (trace,) = read(Plot("t", "", "y", [Curve("c", values, "#000000")], TIME)).data
    assert trace.y == (1.0, None, 2.0, None, 3.0)


def test_limits_cross_the_whole_time_and_share_a_line_of_the_legend():
    limits = [*both_signs("stall", np.array([3.0])), Limit("rated", 1.0)]
    drawn = read(Plot("t", "", "y", [Curve("c", TIME, "#000000")], TIME, limits=limits)).data[1:]
    assert [trace.y for trace in drawn] == [(3.0, 3.0), (-3.0, -3.0), (1.0, 1.0)]
    assert {trace.x for trace in drawn} == {(0.0, 2.0)}
    assert [trace.showlegend for trace in drawn] == [True, False, True]


def test_bands_are_stretches_of_time_below_the_curves():
    bands = [Band("left", 0.25, 0.75, "#56b4e9")]
    (shape,) = read(
        Plot("t", "", "y", [Curve("c", TIME, "#000000")], TIME, bands=bands)
    ).layout.shapes
    assert (shape.x0, shape.x1, shape.fillcolor) == (0.25, 0.75, "#56b4e9")
    assert (shape.yref, shape.layer) == ("paper", "below")


def test_a_plane_has_one_scale_and_closed_areas():
    areas = [Area("sole", SQUARE, "#e69f00"), Area("sole", SQUARE + 5, "#e69f00", filled=False)]
    curve = Curve("zmp", TIME, "#d55e00", marks="cross", x=2 * TIME)
    drawn = read(Plot("t", "", "y [mm]", [curve], across="x [mm]", areas=areas))
    assert drawn.layout.yaxis.scaleanchor == "x"
    first, second, points = drawn.data
    assert (first.x, first.y) == ((0, 3, 3, 0, 0), (0, 0, 1, 1, 0))
    assert (first.fill, first.fillcolor) == ("toself", "rgba(230,159,0,0.3)")
    assert (second.fill, second.showlegend) == ("none", False)
    assert (points.mode, points.marker.symbol) == ("markers", "x")
    np.testing.assert_array_equal(points.x, 2 * TIME)


def test_margins_are_those_the_page_places_its_cursor_by():
    margin = read(Plot("t", "", "y", [Curve("c", TIME, "#000000")], TIME)).layout.margin
    assert {side: margin[side] for side in MARGINS} == MARGINS


def test_a_heavier_curve_is_as_much_thicker_on_a_page_as_in_a_figure():
    y = np.zeros(3)
    lines = [Curve("light", y, "#000000"), Curve("heavy", y, "#000000", weight=2.0)]
    plot = Plot("Two", "", "y", lines, np.arange(3.0))
    light, heavy = (trace["line"]["width"] for trace in figure(plot)["data"])
    assert heavy == 2.0 * light
    drawn = shapes_of(panels([[plot]], 4, 3), "curve")
    widths = [shape.look.width for shape in drawn]
    assert widths[1] == 2.0 * widths[0]
