"""Plots as data: what can't be drawn is refused before anything draws it."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from thesis_pin.errors import WrongShape
from thesis_pin.report.curves import (
    DOTS,
    LINES,
    STROKES,
    Curve,
    Plot,
    apart,
    both_signs,
    condensed,
    evenly,
    telling,
)

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


def test_the_first_curves_differ_in_colour_and_dash_and_no_two_of_36_in_neither():
    first = [apart(k) for k in range(6)]
    assert [len(set(part)) for part in zip(*first, strict=True)] == [6, 6]
    assert len({apart(k) for k in range(36)}) == 36
    assert len({STROKES[dash] for dash in (*LINES, *DOTS)}) == 12


def test_samples_are_spread_evenly_with_both_ends_and_all_if_few():
    np.testing.assert_array_equal(evenly(4, 10), [0, 1, 2, 3])
    some = evenly(100_001, 11)
    np.testing.assert_array_equal(some, np.arange(11) * 10_000)


def test_a_limit_of_size_stands_on_both_sides_once():
    limits = both_signs("stall", np.array([2.0, 1.0, 2.0]))
    assert [limit.value for limit in limits] == [1.0, -1.0, 2.0, -2.0]


unhurried = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
"""A machine under load draws hundreds of numbers slowly; the law is none the worse."""


@st.composite
def sampled(draw):
    """Times, values with gaps, and a number of stretches."""
    count = draw(st.integers(2, 120))
    steps = draw(st.lists(st.sampled_from([1e-9, 0.1, 1.0, 40.0]), min_size=count, max_size=count))
    value = st.sampled_from([np.nan, -2.0, -1.0, 0.0, 1.0, 2.0])
    values = draw(st.lists(value, min_size=count, max_size=count))
    return np.cumsum(steps), np.array(values), draw(st.integers(1, 30))


@unhurried
@given(sampled())
def test_each_stretch_shows_its_least_and_greatest_value_both_ends_and_its_gaps(given_):
    time, values, stretches = given_
    keep = telling(time, (values,), stretches)
    assert (np.diff(keep) > 0).all()
    assert (keep[0], keep[-1]) == (0, len(time) - 1)
    gaps = 4 if np.isnan(values).any() else 0
    assert len(keep) <= 1 + (3 + gaps) * (stretches + 1)
    stretch = np.floor((time - time[0]) / (time[-1] - time[0]) * stretches)
    for one in np.unique(stretch):
        inside = np.flatnonzero(stretch == one)
        drawn = keep[np.isin(keep, inside)]
        assert drawn[0] == inside[0]
        # What is drawn in it and on the way to the next stretch spans all that is in it.
        here = values[np.append(drawn, keep[np.searchsorted(keep, inside[-1], "right") :][:1])]
        assert np.isnan(values[drawn]).any() == np.isnan(values[inside]).any()
        if not np.isnan(values[inside]).all():
            assert np.nanmin(here) <= np.nanmin(values[inside])
            assert np.nanmax(here) >= np.nanmax(values[inside])


@unhurried
@given(sampled())
def test_no_line_crosses_a_gap_that_reaches_beyond_one_stretch(given_):
    time, values, stretches = given_
    keep = telling(time, (values,), stretches)
    stretch = np.floor((time - time[0]) / (time[-1] - time[0]) * stretches)
    for left, right in pairwise(keep):
        if not np.isnan(values[[left, right]]).any():
            between = np.arange(left, right + 1)
            assert (stretch[between[np.isnan(values[between])]] == stretch[left]).all()


def test_values_that_stand_alone_between_gaps_for_less_than_a_stretch_are_drawn_as_a_line():
    values = np.full(1000, np.nan)
    values[512:515] = 1.0
    keep = telling(np.linspace(0.0, 1.0, 1000), (values,), 10)
    np.testing.assert_array_equal(keep[~np.isnan(values[keep])], [512, 514])
    assert {511, 515} <= set(keep)


def test_a_smooth_curve_is_drawn_by_evenly_spread_samples_and_its_turns():
    time = np.linspace(0.0, 1.0, 10_001)
    keep = telling(time, (np.cos(2 * np.pi * time),), 100)
    np.testing.assert_array_equal(keep, np.arange(0, 10_001, 100))
    shifted = telling(time, (np.cos(2 * np.pi * (time - 0.0053)),), 100)
    np.testing.assert_array_equal(np.setdiff1d(shifted, keep), [53, 5053])


def test_samples_far_apart_are_all_drawn_beside_a_crowd():
    time = np.concatenate([np.linspace(0.0, 1.0, 50_001), np.arange(2.0, 100.0)])
    values = np.concatenate([np.zeros(50_001), np.arange(98) % 2])
    keep = telling(time, (values,), 1000)
    assert set(range(50_001, 50_099)) <= set(keep)


@pytest.mark.parametrize("spike", [7, 4321, 9998])
def test_one_sample_s_spike_is_drawn_over_time_and_in_a_plane_along_either_axis(spike):
    time, level = np.linspace(0.0, 1.0, 10_001), np.zeros(10_001)
    peak = level.copy()
    peak[spike] = 5.0
    rough = Plot(
        "Rough",
        "",
        "[m]",
        [Curve("up", peak, "#000000"), Curve("down", -peak, "#000000")],
        time,
    )
    for curve, value in zip(condensed(rough, 100).curves, (5.0, -5.0), strict=True):
        assert curve.x[curve.y == value] == [time[spike]]
        assert len(curve.y) <= 103
    plane = [Curve("up", peak, "#000000", x=time), Curve("across", time, "#000000", x=-peak)]
    up, across = condensed(Plot("Plane", "", "[m]", plane), 100).curves
    assert up.x[up.y == 5.0] == [time[spike]]
    assert across.y[across.x == -5.0] == [time[spike]]


def test_a_curve_of_few_samples_stays_whole():
    plot = Plot("Few", "", "[m]", [Curve("knee", TIME, "#000000")], TIME)
    (curve,) = condensed(plot, 4).curves
    np.testing.assert_array_equal([plot.places(curve), curve.y], [TIME, TIME])
