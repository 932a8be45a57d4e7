"""What samples can carry, held against samples whose true derivatives are known."""

import numpy as np
import pytest

from thesis_pin.loops.motion.sampled import resolution_warning, with_derivatives


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
