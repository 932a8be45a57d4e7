"""A swinging foot takes off and lands at rest."""

import numpy as np
import pytest

from scout_pin.study.plan.swing import swing_curves


def test_a_swing_is_at_rest_and_without_acceleration_at_both_ends_and_as_high_as_asked():
    y, z = swing_curves(0.3, 0.8, -0.02, 0.05, 0.013)
    for curve, first, last in ((y, -0.02, 0.05), (z, 0.0, 0.0)):
        assert curve(0.3) == first
        assert curve(0.8) == pytest.approx(last, abs=1e-15)
        for order in (1, 2):
            assert np.abs(curve([0.3, 0.8], order)).max() < 1e-11
    t = np.linspace(0.3, 0.8, 1001)
    assert z(t).max() == pytest.approx(0.013, rel=1e-12)
    assert z(t).min() > -1e-15
    assert (np.diff(y(t)) > -1e-15).all()
