"""Which joints are known to move, by spreads and biases that are known."""

import numpy as np
import pytest

from thesis_pin.smoothing.rates import resting

TIME = np.linspace(0.0, 1.0, 5)
KEEP = np.array([0, 2, 4])


def found(rate, spread=0.0, bias=None):
    """One joint at one rate; two draws with a standard deviation, and a rival with a bias."""
    rates = np.full((5, 1), rate)
    draws = rate + np.array([1.0, -1.0])[:, None, None] * np.full((3, 1), spread / np.sqrt(2))
    rival = None if bias is None else np.full((3, 1), rate + bias)
    still, open_ = resting(TIME, KEEP, rates, draws, rival)
    assert (still == still[0]).all()
    assert (open_ == open_[0]).all()
    return bool(still[0, 0]), bool(open_[0, 0])


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize(("rate", "rests"), [(0.39, True), (0.41, False)])
def test_four_standard_deviations_from_zero_are_known_to_move(rate, rests, way):
    assert found(way * rate, spread=0.1) == (rests, rests)


@pytest.mark.parametrize("bias", [0.2, -0.2])
@pytest.mark.parametrize(("rate", "rests"), [(0.59, True), (0.61, False)])
def test_what_the_rival_s_curve_differs_by_comes_on_top(rate, rests, bias):
    assert found(rate, spread=0.1, bias=bias)[0] is rests


def test_a_joint_at_rest_whose_rate_nothing_leaves_open_rests_for_certain():
    assert found(0.0) == (True, False)


def test_a_joint_that_creeps_within_ringing_may_have_friction():
    assert found(5e-4) == (True, True)


def test_between_the_samples_that_were_judged_the_spread_is_interpolated():
    draws = np.array([1.0, -1.0])[:, None, None] * np.array([[0.0], [0.0], [0.1]]) / np.sqrt(2)
    still, _ = resting(TIME, KEEP, np.full((5, 1), 0.1), 0.1 + draws, None)
    assert still[:, 0].tolist() == [False, False, False, True, True]


def test_one_draw_alone_says_nothing_of_a_spread():
    assert not resting(TIME, KEEP, np.ones((5, 1)), np.zeros((1, 3, 1)), None)[0].any()
