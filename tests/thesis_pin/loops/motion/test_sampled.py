"""Derivatives of samples, held against samples whose true ones are known."""

import numpy as np

from thesis_pin.loops.motion.sampled import with_derivatives


def test_given_rates_are_not_touched_and_accelerations_come_from_them():
    time = np.linspace(0, 2, 201)
    rate, acceleration = with_derivatives(time, np.sin(time), np.cos(time), None)
    np.testing.assert_array_equal(rate, np.cos(time))
    np.testing.assert_allclose(acceleration, -np.sin(time), atol=1e-6)
