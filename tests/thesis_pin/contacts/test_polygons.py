"""Distances of flat polygons in space, against a quadratic programme and shapely."""

import unittest.mock

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from thesis_pin.contacts import polygons
from thesis_pin.contacts.polygons import least_distance, polygon_distance
from thesis_pin.tolerances import TOLERANCES

SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
NOTCHED = np.array([[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]], dtype=float)


def placed(outline, rng, spread):
    axis = rng.normal(size=3)
    angle = rng.uniform(0, np.pi)
    k = np.cross(np.eye(3), axis / np.linalg.norm(axis))
    turn = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
    return np.column_stack([outline, np.zeros(len(outline))]) @ turn.T + rng.normal(
        size=3, scale=spread
    )


def by_optimisation(one, other):
    """Least distance of two convex polygons over mixtures of their corners."""
    m, n = len(one), len(other)

    def square(w):
        gap = w[:m] @ one - w[m:] @ other
        return gap @ gap

    sums = (
        {"type": "eq", "fun": lambda w: w[:m].sum() - 1},
        {"type": "eq", "fun": lambda w: w[m:].sum() - 1},
    )
    start = np.concatenate([np.full(m, 1 / m), np.full(n, 1 / n)])
    options = {"ftol": 1e-14, "maxiter": 500}
    found = minimize(
        square, start, bounds=[(0, 1)] * (m + n), constraints=sums, options=options, method="SLSQP"
    )
    return np.sqrt(found.fun)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([0.3, 1.0, 3.0]))
def test_convex_polygons_anywhere_are_as_far_apart_as_an_optimiser_finds(seed, spread):
    rng = np.random.default_rng(seed)
    hull = np.array([[0, 0], [2, 0], [2.5, 1], [1, 2]], dtype=float)
    one, other = placed(SQUARE, rng, spread), placed(hull, rng, spread)
    found = polygon_distance(one[None], other[None])[0]
    assert found == pytest.approx(by_optimisation(one, other), abs=2e-4)
    assert found == pytest.approx(polygon_distance(other[None], one[None])[0], abs=1e-12)


@settings(max_examples=80, deadline=None)
@given(st.floats(-1, 4), st.floats(-1, 4), st.floats(0, 6.3), st.floats(0, 2))
def test_level_polygons_with_notches_are_as_far_apart_as_shapely_says(x, y, angle, height):
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    small = 0.4 * SQUARE @ turn.T + (x, y)
    flat = shapely.distance(shapely.Polygon(NOTCHED), shapely.Polygon(small))
    lifted = np.column_stack([small, np.full(4, height)])
    level = np.column_stack([NOTCHED, np.zeros(8)])
    found = polygon_distance(level[None], lifted[None])[0]
    assert found == pytest.approx(np.hypot(flat, height), abs=1e-9)


def test_a_polygon_through_another_is_at_distance_zero_without_touching_its_edges():
    big = np.column_stack([10 * SQUARE - 5, np.zeros(4)])
    upright = np.column_stack([SQUARE[:, 0], np.zeros(4), SQUARE[:, 1] - 0.5])
    assert polygon_distance(big[None], upright[None])[0] == 0.0
    assert polygon_distance(big[None], upright[None] + (0, 0, 0.7))[0] == pytest.approx(0.2)


def test_the_nearest_sample_of_a_motion_is_found():
    """Two squares pass each other; the least of all distances, one by one."""
    t = np.linspace(-1, 1, 301)
    level = np.broadcast_to(np.column_stack([SQUARE, np.zeros(4)]), (301, 4, 3))
    passing = level + np.stack([np.full(301, 1.2), 3 * t, 0.3 * np.abs(t)], axis=1)[:, None]
    distances = polygon_distance(level, passing)
    least, sample = least_distance(level, passing)
    assert least == distances.min()
    assert distances[sample] == least


def test_what_is_known_to_be_nearer_is_not_looked_for():
    """A motion in parts: only a part that comes nearer than those before has an answer."""
    level = np.broadcast_to(np.column_stack([SQUARE, np.zeros(4)]), (3, 4, 3))
    beside = level + np.array([[2.0, 0, 0], [1.5, 0, 0], [3.0, 0, 0]])[:, None]
    assert least_distance(level, beside, 0.6) == (pytest.approx(0.5), 1)
    assert least_distance(level, beside, 0.5) is None


def test_samples_that_are_alike_but_for_rounding_are_not_all_measured():
    level = np.broadcast_to(np.column_stack([SQUARE, np.zeros(4)]), (999, 4, 3))
    rounding = np.random.default_rng(0).uniform(-1e-14, 1e-14, (999, 1, 3))
    aside = level + np.array([0.4, 2.0, 0.0]) + rounding
    with unittest.mock.patch.object(polygons, "polygon_distance", wraps=polygon_distance) as seen:
        least_distance(level, aside)
    assert sum(len(call.args[0]) for call in seen.call_args_list) < 20


@pytest.mark.parametrize("seed", range(40))
def test_of_many_tilted_pairs_the_nearest_is_found(seed):
    """Shadows bound distances from below: the pair whose shadows are nearest need not be it."""
    rng = np.random.default_rng(seed)
    one = np.stack([placed(SQUARE, rng, 0.3) for _ in range(60)])
    other = np.stack([placed(NOTCHED / 3, rng, 0.3) for _ in range(60)])
    other += (0.0, 0.0, 2.0)
    distances = polygon_distance(one, other)
    least, sample = least_distance(one, other)
    assert least == pytest.approx(distances.min(), abs=TOLERANCES.nearer)
    assert distances[sample] == pytest.approx(least, abs=1e-12)
    known = 0.999 * distances.min()
    assert least_distance(one, other, known) is None


def test_hulls_and_corners_of_few_samples_give_the_same_as_all_corners():
    rng = np.random.default_rng(5)
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 0.4], [0, 1.0]])  # with a notch
    hull = outline[[0, 1, 2, 4]]

    def moving(seed):
        rng = np.random.default_rng(seed)
        turn, place = rng.uniform(-3, 3, 200), rng.uniform(-3, 3, (200, 3))

        def corners(points, some=slice(None)):
            c, s = np.cos(turn[some])[:, None], np.sin(turn[some])[:, None]
            x, y = c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1]
            return np.stack([x, y, np.zeros_like(x)], axis=2) + place[some][:, None]

        return corners

    one, other = moving(int(rng.integers(99))), moving(int(rng.integers(99)) + 100)
    expected = least_distance(one(outline), other(outline))
    found = least_distance(
        lambda some: one(outline, some),
        lambda some: other(outline, some),
        hulls=(one(hull), other(hull)),
    )
    assert found == expected
    assert found[0] == pytest.approx(polygon_distance(one(outline), other(outline)).min())
