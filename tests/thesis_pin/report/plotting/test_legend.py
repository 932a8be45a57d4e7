"""Legends hold every entry inside their frames, in as many columns as fit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.report.figures import default_style
from thesis_pin.report.plotting.legend import Entry, Legend, fitting
from thesis_pin.report.plotting.sheet import Look, Shape, Text, text_width

LINE = Look((0.0, 0.0, 0.0, 1.0))


def entries(count):
    return [Entry(f"joint {k}" * (1 + k % 3), LINE, area=k % 2 == 0) for k in range(count)]


@settings(deadline=None)  # the first imports Matplotlib
@given(st.integers(1, 40), st.integers(1, 5))
@default_style()
def test_names_stand_within_the_frame_and_apart(count, columns):
    legend = Legend(entries(count), columns)
    frame, *marks = legend.marks(10.0, 500.0)
    (left, bottom), (right, top) = frame.points.min(axis=0), frame.points.max(axis=0)
    assert (left, top) == (10.0, 500.0)
    assert (right - left, top - bottom) == pytest.approx((legend.width, legend.height))
    places = set()
    for mark in marks:
        if isinstance(mark, Text):
            assert left < mark.x < mark.x + text_width(mark.text, mark.size) < right
            assert bottom < mark.y < mark.y + mark.size < top + 3
            places.add((mark.x, mark.y))
        else:
            assert isinstance(mark, Shape)
            assert (mark.points >= [left, bottom]).all()
            assert (mark.points <= [right, top]).all()
    assert len(places) == count


@default_style()
def test_as_many_columns_as_keep_it_as_low_as_asked():
    many = entries(30)
    for height in (100.0, 200.0, 1000.0):
        legend = fitting(many, height)
        assert legend.height <= height
        if legend.columns > 1:
            assert Legend(many, legend.columns - 1).height > height


@default_style()
def test_samples_look_as_what_they_name():
    dots = Look((0.0, 0.0, 1.0, 1.0), marks="dot")
    tint = Look(fill=(1.0, 0.0, 0.0, 0.3))
    legend = Legend([Entry("points", dots), Entry("area", tint, area=True), Entry("line", LINE)])
    _, point, _, area, _, line, _ = legend.marks(0.0, 100.0)
    assert [one.look for one in (point, area, line)] == [dots, tint, LINE]
    assert [len(one.points) for one in (point, area, line)] == [1, 4, 2]
    assert [one.closed for one in (point, area, line)] == [False, True, False]
    np.testing.assert_allclose(np.diff(line.points[:, 1]), 0.0)
