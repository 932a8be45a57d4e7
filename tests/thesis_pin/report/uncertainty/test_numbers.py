"""When shares of limits decide, and the intervals of peaks by hand."""

import numpy as np
import pytest

from thesis_pin.report.uncertainty.numbers import band, few_draws, peaks, within
from thesis_pin.smoothing.intervals import Interval

BELOW, ABOVE, OPEN = Interval(0.8, 0.7, 0.9), Interval(1.2, 1.1, 1.3), Interval(1.0, 0.9, 1.1)


@pytest.mark.parametrize(
    ("uses", "few", "verdict"),
    [
        ([BELOW, BELOW], False, True),
        ([BELOW, BELOW], True, None),
        ([BELOW, OPEN], False, None),
        ([OPEN, ABOVE], False, False),
        ([BELOW, ABOVE], True, False),
        ([], False, True),
    ],
)
def test_one_share_above_is_a_no_and_all_below_a_yes_if_draws_are_enough(uses, few, verdict):
    assert within(uses, few) is verdict


@pytest.mark.parametrize(("lost", "left", "few"), [(8, 8, False), (9, 7, True), (0, 0, False)])
def test_half_of_the_draws_must_have_been_worked_out(lost, left, few):
    assert few_draws(lost, left) is few


def test_what_may_come_on_top_widens_peaks_and_bands_and_leaves_the_value():
    own = np.array([[1.0], [2.0]])
    draws = np.stack([own, own])
    (plain,), (more,) = peaks(own, own, draws), peaks(own, own, draws, 0.5)
    assert plain.value == more.value == 2.0
    assert plain.high == pytest.approx(2.0, rel=1e-3)
    assert more.high == pytest.approx(2.5, rel=1e-3)
    np.testing.assert_allclose(band(own, own + 0.1, draws, 0.5)[:, :, 0], [[0.4, 1.4], [1.6, 2.6]])
