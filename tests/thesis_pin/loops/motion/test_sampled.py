"""What samples can carry, held against samples whose true derivatives are known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.loops.motion.sampled import quantum, resolution_warning, with_derivatives


@given(st.integers(1, 6), st.floats(0.2, 2.0), st.integers(0, 10**6))
@settings(deadline=None, max_examples=30)
def test_the_step_of_rounded_samples_is_found_from_their_digits(places, size, seed):
    values = size * np.sin(np.random.default_rng(seed).uniform(0, 3, 200))
    cells = [f"{value:.{places}f}" for value in values]
    assert quantum(cells, np.array(cells, dtype=float)) == pytest.approx(10.0**-places)


def test_the_step_of_a_counter_is_found_though_it_is_written_with_all_digits():
    step = 2 * np.pi / 4096
    values = step * np.round(0.5 * np.sin(np.linspace(0, 3, 2000)) / step)
    assert quantum([repr(x) for x in values.tolist()], values) == pytest.approx(step, rel=1e-6)


def test_a_ramp_of_even_steps_is_not_taken_for_a_counter():
    values = np.linspace(0, 1, 101)
    assert quantum([repr(x) for x in values.tolist()], values) < 1e-15


@pytest.mark.parametrize("rate", [100, 500, 2000])
@pytest.mark.parametrize("places", [3, 4, 5, 6, 7, 8])
def test_a_warning_is_given_where_rounding_really_spoils_the_acceleration(rate, places):
    time = np.arange(0, 1, 1 / rate)
    true = -0.3 * 9 * np.sin(3 * time)
    rounded = np.round(0.3 * np.sin(3 * time), places)
    acceleration = with_derivatives(time, rounded, None, None)[1]
    inner = slice(5, -5)  # a spline's ends are worse
    spoilt = np.abs(acceleration - true)[inner].max() / np.abs(true).max()
    said = bool(resolution_warning("hip", time, 10.0**-places, acceleration, True))
    if spoilt > 0.3:
        assert said
    if spoilt < 0.01:
        assert not said


def test_given_rates_are_not_touched_and_accelerations_come_from_them():
    time = np.linspace(0, 2, 201)
    rate, acceleration = with_derivatives(time, np.sin(time), np.cos(time), None)
    np.testing.assert_array_equal(rate, np.cos(time))
    np.testing.assert_allclose(acceleration, -np.sin(time), atol=1e-6)
