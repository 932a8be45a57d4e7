"""Zero-moment point, polygons and margins against the level floor's formulas and by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.contacts.balance.criteria import flat_corners, margins, zero_moment_points
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.outlines import area, hull, simplified
from thesis_pin.contacts.stability import zero_moment_point

NUMBER = st.floats(-3.0, 3.0)


@given(st.lists(NUMBER, min_size=9, max_size=9), st.floats(-0.5, 0.5))
def test_on_a_level_floor_it_is_the_thesis_s_zero_moment_point(values, height):
    com, rate = np.array(values[:3]), np.array([*values[3:6], *values[6:]])
    mass = 2.0
    force = rate[:3] + np.array([0.0, 0.0, mass * 9.81])
    moment = rate[3:] + np.cross(com, [0.0, 0.0, mass * 9.81])
    ours = zero_moment_points(Floor(height), np.concatenate([force, moment])[None])[0]
    assert np.allclose(ours[:2], zero_moment_point(mass, com, rate, height), atol=1e-9)
    assert ours[2] == pytest.approx(height)


def test_no_moment_along_a_sloping_floor_is_left_at_the_point():
    rng = np.random.default_rng(0)
    floor = Floor(0.3, 0.2, 1.0)
    wrench = rng.normal(size=(20, 6)) + np.array([0, 0, 10, 0, 0, 0])
    points = zero_moment_points(floor, wrench)
    left = wrench[:, 3:] - np.cross(points, wrench[:, :3])
    along = left - np.outer(left @ floor.normal, floor.normal)
    assert np.allclose(along, 0.0, atol=1e-12)
    assert np.allclose(floor.above(points), 0.0, atol=1e-12)
    assert np.isnan(zero_moment_points(floor, -wrench)).all()


def test_margins_are_distances_to_the_border_of_a_polygon_an_edge_or_a_point():
    floor = Floor()
    square = np.array([[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]], dtype=float)
    corners = [np.repeat(square, 4, axis=0), np.full((4, 1, 3), [4.0, 1.0, 0.0])]
    support = np.array([[1, 0], [1, 1], [0, 1], [0, 0]], dtype=bool)
    points = np.array([[1, 0.5, 0], [3, 1, 0], [4, 2, 0], [0, 0, 0]], dtype=float)
    found = margins(floor, points, flat_corners(floor, corners, support))
    to_edge = 0.5 / np.sqrt(1.25)  # from (3, 1) to the line from (2, 2) to (4, 1)
    assert found[:3] == pytest.approx([0.5, 1.0 / np.sqrt(5), -1.0])
    assert to_edge == pytest.approx(1 / np.sqrt(5))
    assert np.isneginf(found[3])
    line = [np.full((1, 1, 3), [0.0, 0, 0]), np.full((1, 1, 3), [2.0, 0, 0])]
    both = np.array([[True, True]])
    assert margins(floor, np.array([[1.0, 0.3, 0]]), flat_corners(floor, line, both)) == (
        pytest.approx(-0.3)
    )


def test_hulls_of_points_in_line_and_of_one_point_are_ends_and_it():
    assert hull(np.array([[0.0, 0], [1, 1], [3, 3], [2, 2]])).tolist() in (
        [[0, 0], [3, 3]],
        [[3, 3], [0, 0]],
    )
    assert hull(np.array([[1.0, 2], [1, 2]])).tolist() == [[1, 2]]
    assert len(hull(np.array([[0.0, 0], [1, 0], [0, 1], [0.2, 0.2]]))) == 3


def test_an_outline_of_few_corners_lies_inside_and_loses_the_area_it_says():
    angle = 2 * np.pi * np.arange(40) / 40
    circle = hull(np.column_stack([np.cos(angle), np.sin(angle)]))
    few, lost = simplified(circle)
    assert len(few) == 8
    assert lost == pytest.approx(1 - area(few) / area(circle))
    assert 0 < lost < 0.15
    assert {tuple(p) for p in few} <= {tuple(p) for p in circle}
