"""Zero-moment point and support polygon, by moments and by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.contacts.stability import signed_margin, support_polygon, zero_moment_point
from thesis_pin.errors import NoSupportForce


def test_standing_still_puts_the_zmp_under_the_centre_of_mass():
    com = np.random.default_rng(3).normal(size=(5, 3))
    np.testing.assert_array_equal(zero_moment_point(0.9, com, np.zeros((5, 6))), com[:, :2])


def test_a_fall_faster_than_gravity_has_no_zmp():
    with pytest.raises(NoSupportForce, match="sample 1"):
        zero_moment_point(1.0, np.zeros((2, 3)), [[0] * 6, [0, 0, -20.0, 0, 0, 0]])


def test_support_polygon_and_margin_of_known_shapes():
    square = np.array([[0, 0], [2, 0], [2, 1], [0, 1], [1, 0.5]])
    polygon = support_polygon(square)
    assert len(polygon) == 4
    points = np.array([[1, 0.5], [1, 0.9], [3, 0.5], [3, 2.0], [1.0, 1.0]])
    expected = [0.5, 0.1, -1.0, -np.sqrt(2), 0.0]
    np.testing.assert_allclose(signed_margin(polygon, points), expected, atol=1e-12)


number = st.floats(-3.0, 3.0)
triple = st.tuples(number, number, number)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.floats(0.1, 5.0), triple, triple, triple, st.floats(-1.0, 1.0))
def test_the_floors_wrench_has_no_level_moment_about_the_zmp(mass, com, linear, angular, floor):
    """Newton and Euler: the floor gives ṗ − m g and L̇ − com × m g; (6.1) on any floor."""
    gravity = np.array([0.0, 0.0, -9.81])
    force = np.array(linear) - mass * gravity
    if force[2] < 0.1:
        return
    moment = np.array(angular) - np.cross(com, mass * gravity)
    zmp = zero_moment_point(mass, np.array(com), np.array([*linear, *angular]), floor)
    left = moment - np.cross([*zmp, floor], force)
    np.testing.assert_allclose(left[:2], 0.0, atol=1e-9)


def test_a_robot_at_rest_stands_on_any_floor_under_its_centre_of_mass():
    com = np.array([0.2, -0.3, 0.5])
    for floor in (-1.0, 0.0, 0.7):
        np.testing.assert_allclose(zero_moment_point(0.9, com, np.zeros(6), floor), com[:2])


def test_the_support_polygon_of_two_soles_is_their_common_hull():
    left = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    right = left + np.array([3.0, 2.0])
    polygon = support_polygon(left, right)
    expected = {(0, 0), (1, 0), (4, 2), (4, 3), (3, 3), (0, 1)}
    assert {(round(x), round(y)) for x, y in polygon} == expected
    edges = np.roll(polygon, -1, axis=0) - polygon
    following = np.roll(edges, -1, axis=0)
    assert (edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0] > 0).all()
