"""A panel's axes, names and legend stand around it and nowhere else."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from pictured import panels_of, shapes_of, texts_of

from thesis_pin.report.curves import Area, Band, Curve, Limit, Plot, both_signs
from thesis_pin.report.figures import panels
from thesis_pin.report.plotting.legend import SIZE
from thesis_pin.report.plotting.sheet import Text, text_width

TIME = np.linspace(0.0, 2.0, 50)


def plot(scale=1.0, curves=3, **more):
    drawn = [Curve(f"motor {k}", scale * np.sin(TIME + k), "#0072b2") for k in range(curves)]
    return Plot("Torques", "", "torque [N·m]", drawn, TIME, **more)


def box(text):
    """Left, bottom, right and top of a text."""
    length, high, deep = text_width(text.text, text.size), 0.72 * text.size, 0.2 * text.size
    if text.upright:
        start = text.y - text.align * length
        return text.x - high, start, text.x + deep, start + length
    start = text.x - text.align * length
    return start, text.y - deep, start + length, text.y + high


@pytest.mark.parametrize("scale", [1e-9, 1e-3, 1.0, 123456.0, 1e9])
@pytest.mark.parametrize("shape", [(1, 1), (2, 3)])
@pytest.mark.parametrize("title", ["", "A robot", 20 * "A robot "])
@pytest.mark.parametrize("start", [0.0, 1732617283.25])
def test_no_text_lies_over_another_or_leaves_the_sheet(scale, shape, title, start):
    width, height = 5.0 * shape[1], 3.2 * shape[0]
    drawn = replace(plot(scale), time=start + TIME, title=title or "Torques")
    sheet = panels([[drawn] * shape[1]] * shape[0], width, height, title)
    boxes = [box(mark) for mark in sheet.marks if isinstance(mark, Text) and mark.text]
    for left, bottom, right, top in boxes:
        assert 0 <= left < right <= 72 * width
        assert 0 <= bottom < top <= 72 * height
    for one, other in combinations(boxes, 2):
        beside = one[2] <= other[0] or other[2] <= one[0]
        assert beside or one[3] <= other[1] or other[3] <= one[1]


def test_a_legend_names_each_thing_once_and_one_thing_not_at_all():
    many = plot(
        limits=both_signs("stall", np.array([3.0])),
        bands=[Band("stands", 0.0, 0.5, "#56b4e9"), Band("stands", 1.0, 2.0, "#56b4e9")],
    )
    named = [mark.text for mark in panels([[many]], 8, 3).marks if getattr(mark, "size", 0) == SIZE]
    assert named == ["stands", "motor 0", "motor 1", "motor 2", "stall"]
    assert "motor 0" not in texts_of(panels([[plot(curves=1)]], 8, 3))


def test_names_of_forty_curves_have_their_room():
    sheet = panels([[plot(curves=40)]], 8.0, 3.2)
    (frame,) = shapes_of(sheet, "frame")
    for k in range(40):
        (name,) = (
            mark for mark in sheet.marks if isinstance(mark, Text) and mark.text == f"motor {k}"
        )
        assert name.x > frame.points[:, 0].max()
        assert 0 < name.y < 3.2 * 72


def test_panels_of_a_row_that_name_the_same_share_a_legend():
    row = [plot(), plot(2.0), plot(3.0)]
    sheet = panels([row], 15, 3)
    assert texts_of(sheet).count("motor 0") == 1
    (name,) = (mark for mark in sheet.marks if getattr(mark, "text", "") == "motor 0")
    assert name.x > max(frame.points[:, 0].max() for frame in shapes_of(sheet, "frame"))
    assert texts_of(panels([[*row[:2], plot(curves=2)]], 15, 3)).count("motor 0") == 3


@pytest.mark.parametrize("shape", [(1, 3), (9, 1)])
def test_a_sheet_grows_where_its_axes_would_vanish(shape):
    rows = [[plot(curves=40 + k) for k in range(shape[1])]] * shape[0]
    sheet = panels(rows, 4.0, 3.0)
    frames = np.array([np.ptp(frame.points, axis=0) for frame in shapes_of(sheet, "frame")])
    assert frames.min() >= 72.0 - 1e-9
    corners = np.concatenate([frame.points for frame in shapes_of(sheet, "frame")])
    assert (corners > 0).all()
    assert (corners < [72 * sheet.width, 72 * sheet.height]).all()
    wider = panels(rows, 90.0, 60.0)
    assert (wider.width, wider.height) == pytest.approx((90.0, 60.0))


def test_a_constant_no_value_at_all_and_a_gap_are_drawn():
    flat = Plot("", "", "y", [Curve("flat", np.full(50, 5.0), "#000000")], TIME)
    none = Plot("", "", "y", [Curve("none", np.full(50, np.nan), "#000000")], TIME)
    bare = Plot("", "", "y", [])
    (one, _) = panels_of(panels([[flat], [none], [bare]], 6, 7))
    np.testing.assert_allclose(one.things[0][1][:, 1], 5.0)


def test_a_sample_without_neighbours_is_a_dot():
    values = np.sin(TIME)
    values[[0, 2, 20, 22, 40]] = np.nan, np.nan, np.inf, np.nan, np.nan
    curve = Curve("torn", values, "#0072b2", dash="dash")
    (dots,) = shapes_of(panels([[Plot("", "", "y", [curve], TIME)]], 6, 3), "samples")
    (line,) = shapes_of(panels([[Plot("", "", "y", [curve], TIME)]], 6, 3), "curve")
    np.testing.assert_array_equal(dots.points, line.points[[1, 21]])
    assert dots.look.marks == "dot"
    assert dots.look.stroke == line.look.stroke
    assert not shapes_of(panels([[plot()]], 6, 3), "samples")


@pytest.mark.parametrize("name", ["rod_2_right_tip – rod_2_right_seat", "left_hip " * 9, "m" * 30])
def test_a_legend_has_room_for_letters_on_whole_pixels(name):
    from matplotlib.backends.backend_agg import RendererAgg
    from matplotlib.font_manager import FontProperties

    drawn = RendererAgg(9, 9, 150).get_text_width_height_descent(
        name, FontProperties(size=8), False
    )
    curves = [Curve(name, TIME, "#0072b2"), Curve("b", TIME, "#000000")]
    sheet = panels([[Plot("", "", "y", curves, TIME)]], 9, 3)
    (text,) = (mark for mark in sheet.marks if getattr(mark, "text", "") == name)
    assert text.x + drawn[0] * 72 / 150 < 9 * 72 - 3.0


def test_an_area_without_an_edge_and_a_limit_stretch_the_axes():
    area = Area("open", np.array([[0, 0], [1, 9], [2, 0]]), "#0072b2", edged=False)
    sheet = panels([[plot(areas=[area], limits=[Limit("most", -20.0)])]], 6, 3)
    (panel,) = panels_of(sheet)
    (frame,) = shapes_of(sheet, "frame")
    low, high = panel.y.read(frame.points[[0, 2], 1])
    assert low < -20.0
    assert high > 9.0
    assert shapes_of(sheet, "area")[0].look.stroke is None
