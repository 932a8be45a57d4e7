"""Distances from cones: by certificates of optimality, construction and SciPy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls

from thesis_pin.contacts import polar
from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.polar import beyond_cone
from thesis_pin.errors import NoSolution

SOLE = Contact.from_outline(np.array([(0.1, 0.06), (-0.1, 0.06), (-0.1, -0.06), (0.1, -0.06)]), 0.6)
TALOS = Contact.from_outline(
    np.array([(0.105, 0.065), (-0.105, 0.065), (-0.105, -0.065), (0.105, -0.065)]), 0.6
)


@settings(deadline=None)
@given(st.lists(st.one_of(st.just(0.0), st.floats(-5, 5)), min_size=6, max_size=6))
def test_what_is_left_over_is_orthogonal_and_what_was_taken_off_is_in_the_cone(values):
    wrench = np.array(values)
    rest, weights = beyond_cone(SOLE.rays.T, wrench)
    size = 3 * np.abs(wrench).max()
    tiny = np.finfo(float).tiny  # numbers below it have no relative precision
    assert (SOLE.rays @ rest).max() <= 1e-9 * size + tiny  # in the polar cone
    assert abs(rest @ (wrench - rest)) <= 1e-9 * size**2 + tiny
    assert (SOLE.facets @ (wrench - rest)).max() <= 1e-9 * size + tiny
    assert (weights >= 0).all()
    np.testing.assert_allclose(SOLE.rays.T @ weights, wrench - rest, atol=1e-11 * size + tiny)
    if not rest.any():
        assert (SOLE.facets @ wrench).max() <= 1e-9 * size + tiny


def test_a_wrench_with_components_of_rounding_is_as_far_as_without_them():
    # SciPy's nnls says 0 here: found on talos on one foot, 18.6 mm beyond its sole.
    exact = np.array([0.0, 0.0, 1.0, -0.678290110, -0.0460200356, 0.0])
    rounded = exact + np.array([-3.51030834e-18, 0, 0, 0, 0, -6.41684037e-19])
    for wrench in (exact, rounded):
        rest, _ = beyond_cone(TALOS.rays.T, wrench)
        assert np.linalg.norm(rest) == pytest.approx((TALOS.facets @ wrench).max(), rel=1e-9)


@given(
    seed=st.integers(0, 2**32 - 1),
    rows=st.integers(1, 8),
    count=st.integers(1, 60),
    kind=st.sampled_from(["any", "twins", "whole numbers", "attainable"]),
)
@settings(max_examples=200, deadline=None)
def test_what_is_left_over_is_as_little_as_scipy_finds(seed, rows, count, kind):
    rng = np.random.default_rng(seed)
    rays = rng.normal(size=(rows, count))
    if kind == "twins":
        rays[:, rng.integers(count)] = rays[:, rng.integers(count)]
    if kind == "whole numbers":
        rays = np.round(rays)
    target = rng.normal(size=rows) * 10.0 ** rng.uniform(-3, 3)
    if kind == "attainable":
        target = rays @ np.abs(rng.normal(size=count))
    rest, weights = beyond_cone(rays, target)
    size = np.linalg.norm(target)
    assert (weights >= 0).all()
    assert (weights > 0).sum() <= rows
    np.testing.assert_allclose(rays @ weights, target - rest, atol=1e-11 * size)
    np.testing.assert_allclose(np.linalg.norm(rest), nnls(rays, target)[1], atol=1e-11 * size)


@pytest.mark.parametrize("feet", [1, 2])
def test_from_a_facet_it_is_as_far_as_one_goes_along_its_normal(feet):
    # Rays orthogonal to the normal are on the facet; the second foot's cone is moved so that it
    # lies behind it.
    rng = np.random.default_rng(7)
    for k in range(300):
        contact = SOLE if k % 2 else TALOS
        normal = contact.facets[rng.integers(len(contact.facets))]
        on = np.abs(contact.rays @ normal) < 1e-12
        chosen = contact.rays[on] * rng.integers(0, 2, size=(on.sum(), 1))
        rays = contact.rays.T
        if feet == 2:
            other = rng.normal(size=(6, 30))
            rays = np.column_stack([rays, other * -np.sign(normal @ other)])
        away = float(rng.choice([0.0, 1e-8, 1e-4, 1.0])) * float(np.abs(chosen).sum())
        rest, _ = beyond_cone(rays, chosen.sum(axis=0) + away * normal)
        np.testing.assert_allclose(rest, away * normal, atol=1e-10 * np.abs(chosen).sum())


def test_a_wrench_barely_beyond_a_corner_of_the_cone_is_not_taken_for_further_out():
    # A random sole on which a solver that is right to 1e-12 says 5.8e-7, twice the distance.
    outline = [
        (0.4345931655102778, -0.2723234963715458),
        (0.345249167755049, -0.19857479643097245),
        (0.5852198465723922, -0.1304224440757461),
        (0.3113940956626929, -0.38835805422947955),
    ]
    wrench = [0.6652191690775311, 0.26481501913096983, 0.5640113002005639]
    wrench += [-0.814340024096592, -1.305551119607882, 2.5185995401179797]
    contact = Contact.from_outline(np.array(outline), 3.0)
    rest, _ = beyond_cone(contact.rays.T, np.array(wrench))
    beyond = (contact.facets @ wrench).max()
    assert beyond == pytest.approx(3.0889e-07, abs=1e-10)
    assert np.linalg.norm(rest) == pytest.approx(beyond, abs=1e-10)


def test_nothing_is_left_of_nothing_and_all_of_it_without_a_cone():
    for rest in beyond_cone(SOLE.rays.T, np.zeros(6)):
        assert not rest.any()
    assert beyond_cone(np.zeros((3, 0)), np.array([1.0, 2, 3]))[0].tolist() == [1, 2, 3]
    rest, weights = beyond_cone(np.array([[0.0, 2.0], [0.0, 0.0]]), np.array([3.0, -4.0]))
    np.testing.assert_allclose(rest, [0, -4], atol=1e-14)
    np.testing.assert_allclose(weights, [0, 1.5], atol=1e-14)


def test_a_load_for_which_the_solver_never_ends_is_refused(monkeypatch):
    asked = []
    answer = (np.zeros(6), 0.0, -2, {})
    monkeypatch.setattr(
        polar.daqp, "solve", lambda *a, **k: asked.append(k["primal_tol"]) or answer
    )
    with pytest.raises(NoSolution, match="distance of a wrench from a cone"):
        beyond_cone(SOLE.rays.T, np.ones(6))
    assert asked[0] < 1e-13
    assert asked[-1] < 1e-7
