"""Intervals of headline numbers, by hand."""

import numpy as np
import pytest

from thesis_pin.smoothing.intervals import Interval, largest_value, least_value


def test_a_margin_spreads_by_rival_draws_and_bias() -> None:
    draws = np.array([9.0, 10.0, 11.0]) - 1.0  # mean 9, deviation 1
    found = least_value(10.0, 9.5, draws, 9.0, slack=0.02)
    assert found.low == pytest.approx(9.0 - 3.0 - 1.0 - 0.02)
    assert found.high == pytest.approx(10.5 + 3.0 + 1.0 + 0.02)


def test_a_peak_spreads_up_by_friction_that_nobody_knows() -> None:
    draws = np.array([1.9, 2.0, 2.1])
    found = largest_value(2.0, 2.05, draws, 1.8, 2.2, slack=1e-3)
    assert found.low == pytest.approx(1.8 - 0.3 - 0.002)
    assert found.high == pytest.approx(2.2 + 0.05 + 0.3 + 0.002)


def test_draws_that_peak_higher_widen_a_peak_s_interval() -> None:
    draws = np.array([2.1, 2.2, 2.3])  # mean 0.2 above the curve's own, deviation 0.1
    found = largest_value(2.0, 2.0, draws)
    assert (found.low, found.high) == pytest.approx((2.0 - 0.3 - 0.2, 2.0 + 0.3 + 0.2))
    lower = largest_value(2.0, 2.0, draws - 0.4)
    assert (lower.low, lower.high) == pytest.approx((2.0 - 0.3, 2.0 + 0.3))


def test_a_peak_is_never_negative() -> None:
    assert largest_value(0.1, 0.1, np.array([0.0, 0.5])).low == 0.0


def test_which_side_of_a_limit() -> None:
    assert Interval(1.0, 0.5, 1.5).side(0.0) == 1
    assert Interval(-1.0, -1.5, -0.5).side(0.0) == -1
    assert Interval(0.1, -0.2, 0.4).side(0.0) == 0


def test_without_draws_the_rivals_difference_is_all_there_is():
    none = np.array([])
    assert least_value(1.0, 0.9, none).low == pytest.approx(0.8)
    assert largest_value(1.0, 1.1, none).high == pytest.approx(1.2)
