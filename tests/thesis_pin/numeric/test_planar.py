"""Convex polygons against Qhull and GEOS."""

import numpy as np
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from thesis_pin.numeric.planar import clearly_simple, convex_hull, depth


def cloud(seed, count, rounded):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(count, 2)) * 10.0 ** rng.uniform(-3, 2) + rng.normal(size=2)
    if rounded:  # with points that stand in line, and some twice
        points = np.round(points / np.ptp(points) * 4) / 4
    return points


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(3, 20), rounded=st.booleans())
@settings(max_examples=200, deadline=None)
def test_corners_are_qhulls_counter_clockwise(seed, count, rounded):
    points = cloud(seed, count, rounded)
    assume(np.linalg.matrix_rank(points - points[0]) == 2)
    ours, theirs = points[convex_hull(points)], points[ConvexHull(points).vertices]
    assert {*map(tuple, ours.tolist())} == {*map(tuple, theirs.tolist())}
    start = [tuple(one) for one in theirs.tolist()].index(tuple(ours[0]))
    np.testing.assert_array_equal(np.roll(theirs, -start, axis=0), ours)


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(3, 20))
@settings(max_examples=60, deadline=None)
def test_depth_is_the_distance_from_the_border_and_negative_outside(seed, count):
    points = cloud(seed, count, rounded=False)
    polygon = points[convex_hull(points)]
    some = np.random.default_rng(seed + 1).normal(size=(50, 2)) * np.ptp(points) + points[0]
    place = shapely.points(some)
    distance = shapely.distance(shapely.LinearRing(polygon), place)
    inside = shapely.contains(shapely.Polygon(polygon), place)
    expected = np.where(inside, distance, -distance)
    np.testing.assert_allclose(depth(polygon, some), expected, rtol=0, atol=1e-12 * np.ptp(points))


def test_corners_and_edges_have_no_depth():
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    assert depth(square, square).tolist() == [0.0] * 4
    assert depth(square, np.array([[0.5, 0.0], [0.5, 0.5], [2.0, 2.0]])).tolist() == [
        0.0,
        0.5,
        -np.sqrt(2),
    ]


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(3, 9), rounded=st.booleans())
@settings(max_examples=300, deadline=None)
def test_what_is_clearly_simple_is_valid_to_geos(seed, count, rounded):
    points = cloud(seed, count, rounded)
    polygon = shapely.Polygon(points)
    if clearly_simple(points.tolist()):
        assert polygon.is_valid
        assert polygon.area > 0


def test_soles_are_clearly_simple_and_what_touches_itself_is_not():
    assert clearly_simple([(0, 0), (2, 0), (2, 1), (1, 0.4), (0, 1)])
    assert clearly_simple([(0, 0), (1, 0), (2, 0), (2, 1)])  # straight on at a corner
    assert not clearly_simple([(0, 0), (1, 1), (1, 0), (0, 1)])  # crosses
    assert not clearly_simple([(0, 0), (2, 0), (2, 1), (1, 0), (0, 1)])  # touches
    assert not clearly_simple([(0, 0), (2, 0), (1, 0)])  # no area
    assert not clearly_simple([(0, 0), (2, 0), (1, 0), (1, 1)])  # back along itself
