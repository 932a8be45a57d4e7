"""Whole turns: what limits hold, motions without jumps, and where they may start."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.numeric.turns import fitted, started, unwound

ANGLES = st.floats(-20, 20)


def brute(angle, lower, upper):
    """By how much the best of many whole turns leaves the limits, and how near that stays."""
    tried = angle + 2 * np.pi * np.arange(-12, 13)
    return np.maximum(np.maximum(lower - tried, tried - upper), 0).min()


@given(ANGLES, st.floats(-10, 10), st.floats(0, 15))
def test_an_angle_is_turned_into_its_limits_if_some_whole_turn_does(angle, lower, width):
    upper = lower + width
    found = float(fitted(np.array(angle), np.array(lower), np.array(upper)))
    turns = (found - angle) / (2 * np.pi)
    assert turns == pytest.approx(round(turns), abs=1e-9)
    excess = max(lower - found, found - upper, 0.0)
    assert excess == pytest.approx(brute(angle, lower, upper), abs=1e-8)
    if lower <= angle <= upper:
        assert found == angle


def test_angles_on_their_limits_and_nan_stay():
    limits = np.radians(-200.0), np.radians(70.0)
    kept = np.array([*limits, np.nan, 0.0])
    np.testing.assert_array_equal(fitted(kept, *limits), kept)
    np.testing.assert_allclose(np.degrees(fitted(np.radians([179.99]), *limits)), [-180.01])


def test_a_motion_without_jumps_is_the_one_it_was_made_from():
    time = np.linspace(0, 5, 9000)
    smooth = np.column_stack([8 * time, -5 * np.sin(time), 0.1 * time])
    wrapped = np.angle(np.exp(1j * smooth))
    np.testing.assert_allclose(unwound(wrapped), smooth, atol=1e-12)


@pytest.mark.parametrize(
    ("least", "most", "start"),
    [
        (0, 500, -360),  # −360° to 140°: one turn back
        (-500, 0, 360),
        (10, 350, 0),  # fits as it is
        (90, 810, 0),  # 720° wide, but no whole turn makes it fit
        (100, 370, -360),  # both ends in −260° to 10°
        (-180, 540, 0),  # more than the limits hold from any of its starts
    ],
)
def test_a_motion_starts_where_its_limits_hold_all_of_it(least, most, start):
    q = np.radians(np.linspace(least, most, 11))[:, None]
    found = np.degrees(started(q, np.radians([-360.0]), np.radians([360.0])))
    np.testing.assert_allclose(found[:, 0] - np.linspace(least, most, 11), start, atol=1e-9)
