"""Whole turns: what limits hold, motions without jumps, and where they may start."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.numeric.turns import fitted, need_turns, started, unwound

ANGLES = st.floats(-20, 20)


def brute(angle, lower, upper):
    """By how much the best of many whole turns leaves the limits."""
    tried = angle + 2 * np.pi * np.arange(-12, 13)
    return np.maximum(np.maximum(lower - tried, tried - upper), 0).min()


@given(ANGLES, st.floats(-10, 10), st.floats(0, 15))
def test_an_angle_is_turned_into_its_limits_if_some_whole_turn_does(angle, lower, width):
    upper = lower + width
    found = float(fitted(np.array(angle), np.array(lower), np.array(upper)))
    turns = (found - angle) / (2 * np.pi)
    assert turns == pytest.approx(round(turns), abs=1e-9)
    excess, least = max(lower - found, found - upper, 0.0), brute(angle, lower, upper)
    if least == 0.0:
        assert excess <= 1e-8
    if lower <= angle <= upper or least > 1e-8:
        assert found == angle


@given(st.floats(-10, 10), st.floats(0, 15), st.lists(st.floats(-3.14159, np.pi), min_size=30))
def test_turns_are_needed_where_limits_hold_an_angle_only_with_one(lower, width, angles):
    lower, upper = np.array([lower]), np.array([lower + width])
    tried = np.array([*angles, np.pi, -3.1415926])
    if not need_turns(lower, upper):
        inside = (tried >= lower - 1e-9) & (tried <= upper + 1e-9)
        held = fitted(tried, lower, upper)
        held = (held >= lower - 1e-9) & (held <= upper + 1e-9)
        np.testing.assert_array_equal(held, inside)


@pytest.mark.parametrize(
    ("lower", "upper", "need"),
    [(-90, 90, 0), (-360, 360, 0), (-180, 180, 0), (-200, 70, 1), (-180, 90, 1), (0, 270, 1)],
)
def test_usual_ranges_need_no_turns(lower, upper, need):
    assert need_turns(np.radians([lower, -10]), np.radians([upper, 10])) == bool(need)


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
