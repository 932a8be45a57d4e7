"""Distances from cones against certificates of optimality, and where SciPy's nnls is wrong."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.polar import beyond_cone

SOLE = Contact.from_outline(np.array([(0.1, 0.06), (-0.1, 0.06), (-0.1, -0.06), (0.1, -0.06)]), 0.6)
TALOS = Contact.from_outline(
    np.array([(0.105, 0.065), (-0.105, 0.065), (-0.105, -0.065), (0.105, -0.065)]), 0.6
)


@settings(deadline=None)
@given(st.lists(st.one_of(st.just(0.0), st.floats(-5, 5)), min_size=6, max_size=6))
def test_what_is_left_over_is_orthogonal_and_what_was_taken_off_is_in_the_cone(values):
    wrench = np.array(values)
    rest = beyond_cone(SOLE.rays.T, wrench)
    size = 3 * np.abs(wrench).max()
    assert (SOLE.rays @ rest).max() <= 1e-9 * size  # in the polar cone
    assert abs(rest @ (wrench - rest)) <= 1e-9 * size**2
    assert (SOLE.facets @ (wrench - rest)).max() <= 1e-9 * size
    if not rest.any():
        assert (SOLE.facets @ wrench).max() <= 1e-9 * size


def test_a_wrench_with_components_of_rounding_is_as_far_as_without_them():
    # SciPy's nnls says 0 here: found on talos on one foot, 18.6 mm beyond its sole.
    exact = np.array([0.0, 0.0, 1.0, -0.678290110, -0.0460200356, 0.0])
    rounded = exact + np.array([-3.51030834e-18, 0, 0, 0, 0, -6.41684037e-19])
    for wrench in (exact, rounded):
        rest = beyond_cone(TALOS.rays.T, wrench)
        assert np.linalg.norm(rest) == pytest.approx((TALOS.facets @ wrench).max(), rel=1e-9)


def test_nothing_is_left_of_nothing_and_all_of_it_without_a_cone():
    assert not beyond_cone(SOLE.rays.T, np.zeros(6)).any()
    assert beyond_cone(np.zeros((3, 0)), np.array([1.0, 2, 3])).tolist() == [1, 2, 3]
