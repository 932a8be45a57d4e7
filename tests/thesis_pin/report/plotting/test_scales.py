"""Axes show all values, and mark round ones by labels that read back."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.report.plotting.scales import shown, ticks

finite = st.floats(-1e12, 1e12)


def read(found):
    sign = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
    power = float(found.factor[3:].translate(sign)) if found.factor else 0.0
    return [float(label.translate(sign)) * 10.0**power for label in found.labels]


@given(st.lists(finite, min_size=1, max_size=6))
def test_every_value_is_shown_with_room_beside_it(values):
    low, high = shown([np.array(values)])
    assert low < min(values)
    assert high > max(values)


@pytest.mark.parametrize("nothing", [[], [np.empty(0)], [np.array([np.nan, np.nan])]])
def test_no_values_have_a_range_all_the_same(nothing):
    low, high = shown(nothing)
    assert low < 0 < 1 < high


def test_gaps_have_no_place_in_the_range():
    assert shown([np.array([np.nan, 2.0, 4.0]), 3.0]) == pytest.approx((1.9, 4.1))


@settings(deadline=None)  # the first imports Matplotlib
@given(finite, st.floats(1e-6, 1e12), st.integers(1, 12))
def test_labels_say_the_marked_values(start, length, most):
    low, high = start, start + max(length, 1e-6 * abs(start))
    found = ticks(low, high, most)
    assert len(found.values) <= 10
    slack = 1e-6 * (high - low)
    assert all(low - slack <= value <= high + slack for value in found.values)
    np.testing.assert_allclose(read(found), found.values, rtol=0, atol=slack)
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
    ],
)
def test_values_are_marked_as_people_mark_them(low, high, labels, factor):
    most = max(len(labels), 4) if high != 1.0 else len(labels)
    found = ticks(low, high, most)
    assert found.factor == factor
    assert found.labels == labels
