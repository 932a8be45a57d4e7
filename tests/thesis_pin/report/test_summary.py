"""Summaries of actuators against integrals done by hand."""

import numpy as np
import pytest

from thesis_pin.report.summary import summarise


def test_summary_of_a_known_motion():
    time = np.linspace(0, 2 * np.pi, 20_001)
    torque, speed = 3 * np.cos(time)[:, None], 2 * np.cos(time)[:, None]
    s = summarise(["a"], time, torque, speed)
    assert s.peak_torque[0] == pytest.approx(3)
    assert s.rms_torque[0] == pytest.approx(3 / np.sqrt(2), rel=1e-6)
    assert s.peak_power[0] == pytest.approx(6)
    assert s.net_work[0] == pytest.approx(6 * np.pi, rel=1e-6)
    assert s.negative_work[0] == pytest.approx(0, abs=1e-9)
