"""Plots as data: what can't be drawn is refused before anything draws it."""

import numpy as np
import pytest

from thesis_pin.errors import WrongShape
from thesis_pin.report.curves import Curve, Plot, both_signs, evenly

TIME = np.linspace(0.0, 1.0, 4)


@pytest.mark.parametrize(
    ("time", "curve"),
    [
        (TIME, Curve("knee", np.zeros(3), "#000000")),
        (TIME, Curve("knee", np.zeros((4, 2)), "#000000")),
        (TIME, Curve("knee", np.zeros(4), "#000000", x=np.zeros(5))),
        (None, Curve("knee", np.zeros(4), "#000000")),
    ],
)
def test_a_curve_without_a_place_for_each_value_is_named(time, curve):
    with pytest.raises(WrongShape, match="curve 'knee' of plot 'Torques'"):
        Plot("Torques", "", "torque [N·m]", [curve], time)


def test_samples_are_spread_evenly_with_both_ends_and_all_if_few():
    np.testing.assert_array_equal(evenly(4, 10), [0, 1, 2, 3])
    some = evenly(100_001, 11)
    np.testing.assert_array_equal(some, np.arange(11) * 10_000)


def test_a_limit_of_size_stands_on_both_sides_once():
    limits = both_signs("stall", np.array([2.0, 1.0, 2.0]))
    assert [limit.value for limit in limits] == [1.0, -1.0, 2.0, -2.0]
