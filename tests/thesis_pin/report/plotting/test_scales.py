"""Axes show all values, and mark round ones by labels that read back."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pictured import said

from thesis_pin.report.plotting.scales import shown, ticks

finite = st.floats(-1e12, 1e12)

unhurried = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
"""The first example imports Matplotlib, and a machine under load draws all of them slowly."""


@unhurried
@given(st.lists(finite, min_size=1, max_size=6))
def test_every_value_is_shown_with_room_beside_it(values):
    low, high = shown([np.array(values)])
    assert low < min(values)
    assert high > max(values)


@pytest.mark.parametrize("nothing", [[], [np.empty(0)], [np.array([np.nan, np.nan])]])
def test_no_values_have_a_range_all_the_same(nothing):
    low, high = shown(nothing)
    assert low < 0 < 1 < high


@pytest.mark.parametrize("nothing", [np.nan, np.inf, -np.inf])
def test_gaps_and_infinity_have_no_place_in_the_range(nothing):
    assert shown([np.array([nothing, 2.0, 4.0]), 3.0]) == pytest.approx((1.9, 4.1))


@unhurried
@given(finite, st.floats(1e-6, 1e12), st.integers(1, 12))
def test_labels_say_the_marked_values(start, length, most):
    low, high = start, start + max(length, 1e-6 * abs(start))
    found = ticks(low, high, most)
    assert len(found.values) <= 10
    slack = 1e-6 * (high - low)
    assert all(low - slack <= value <= high + slack for value in found.values)
    np.testing.assert_allclose(said(found.labels, found.factor), found.values, rtol=0, atol=slack)
    assert len(set(found.labels)) == len(found.labels)


@pytest.mark.parametrize(
    ("low", "high", "labels", "factor"),
    [
        (-1.65, 1.1, ("−1.5", "−1.0", "−0.5", "0.0", "0.5", "1.0"), ""),
        (0.0, 9.0, ("0", "1", "2", "3", "4", "5", "6", "7", "8", "9"), ""),
        (-2e-6, 3e-6, ("−2", "−1", "0", "1", "2", "3"), "×10⁻⁶"),
        (0.0, 5e7, ("0", "1", "2", "3", "4", "5"), "×10⁷"),
        (-3.5e-6, 3.5e-6, ("−3", "−2", "−1", "0", "1", "2", "3"), "×10⁻⁶"),
        (0.0, 1.0, ("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"), ""),
        (0.1, 1.0, ("0.25", "0.50", "0.75", "1.00"), ""),
        (1.7e9, 1.7e9 + 2, ("0.0", "0.5", "1.0", "1.5", "2.0"), "+1700000000"),
        (-12345.9, -12345.7, ("0.10", "0.15", "0.20", "0.25", "0.30"), "−12346"),
        (1e3 - 2e-6, 1e3 + 2e-6, ("−2.0", "−1.0", "0.0", "1.0", "2.0"), "×10⁻⁶ +1000"),
        (1e20, 1.000004e20, ("0", "1", "2", "3", "4"), "×10¹⁴ +1×10²⁰"),
    ],
)
def test_values_are_marked_as_people_mark_them(low, high, labels, factor):
    most = max(len(labels), 4) if high != 1.0 else len(labels)
    found = ticks(low, high, most)
    assert found.factor == factor
    assert found.labels == labels


@pytest.mark.parametrize("start", [1e-20, 1.0, 1732617283.25, -4e12, 3e200])
@pytest.mark.parametrize("share", [1e-9, 1e-7, 1e-5, 1e-3])
def test_labels_far_from_zero_are_short_and_say_the_values(start, share):
    found = ticks(start, start + share * abs(start), 9)
    assert max(len(label) for label in found.labels) <= 9
    assert len(set(found.labels)) == len(found.labels) > 1
    slack = 1e-6 * share * abs(start) + 4 * np.spacing(abs(start))
    np.testing.assert_allclose(said(found.labels, found.factor), found.values, rtol=0, atol=slack)
