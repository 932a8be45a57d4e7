"""Summaries of actuators against integrals done by hand."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

from thesis_pin.report.summary import summarise, summarise_parts


def test_summary_of_a_known_motion():
    time = np.linspace(0, 2 * np.pi, 20_001)
    torque, speed = 3 * np.cos(time)[:, None], 2 * np.cos(time)[:, None]
    s = summarise(["a"], time, torque, speed)
    assert s.peak_torque[0] == pytest.approx(3)
    assert s.rms_torque[0] == pytest.approx(3 / np.sqrt(2), rel=1e-6)
    assert s.peak_power[0] == pytest.approx(6)
    assert s.net_work[0] == pytest.approx(6 * np.pi, rel=1e-6)
    assert s.negative_work[0] == pytest.approx(0, abs=1e-9)


def test_a_motion_in_parts_has_the_summary_of_the_whole():
    """Parts that share a sample, of unequal length; peaks and integrals by SciPy and hand."""
    time = np.cumsum(np.random.default_rng(2).uniform(0.5, 1.5, 60))
    torque, speed = np.random.default_rng(3).normal(size=(2, 60, 2))
    cuts = (slice(0, 8), slice(7, 41), slice(40, 60))
    found = summarise_parts(["a", "b"], ((time[p], torque[p], speed[p]) for p in cuts))
    power = torque * speed
    np.testing.assert_array_equal(found.peak_torque, np.abs(torque).max(axis=0))
    np.testing.assert_array_equal(found.peak_speed, np.abs(speed).max(axis=0))
    np.testing.assert_array_equal(found.peak_power, np.abs(power).max(axis=0))
    mean_square = trapezoid(torque**2, time, axis=0) / (time[-1] - time[0])
    np.testing.assert_allclose(found.rms_torque, np.sqrt(mean_square), rtol=1e-13)
    given, taken = (trapezoid(f(power, 0), time, axis=0) for f in (np.maximum, np.minimum))
    np.testing.assert_allclose(found.positive_work, given, rtol=1e-13)
    np.testing.assert_allclose(found.negative_work, taken, rtol=1e-13)
