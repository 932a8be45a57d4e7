"""Planes at some height and slope."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.contacts.floor import Floor
from thesis_pin.errors import BadInput

SLOPES = st.floats(0.0, 1.2)
HEADINGS = st.floats(-7.0, 7.0)


def test_a_level_floor_has_the_world_s_axes():
    assert np.allclose(Floor(0.3).axes, np.eye(3), atol=1e-15)
    assert Floor(0.3).above(np.array([1.0, 2.0, 0.5])) == pytest.approx(0.2)


@given(SLOPES, HEADINGS)
def test_axes_are_right_handed_and_the_floor_rises_uphill_by_its_slope(slope, uphill):
    floor = Floor(1.0, slope, uphill)
    assert np.allclose(floor.axes.T @ floor.axes, np.eye(3), atol=1e-12)
    assert np.linalg.det(floor.axes) == pytest.approx(1.0)
    ahead = np.array([np.cos(uphill), np.sin(uphill), np.tan(slope)]) + floor.origin
    assert floor.above(ahead) == pytest.approx(0.0, abs=1e-12)
    assert floor.normal[2] > 0


@pytest.mark.parametrize("values", [(np.nan, 0, 0), (0, -0.1, 0), (0, 1.6, 0), (0, 0, np.inf)])
def test_what_is_no_floor_is_refused(values):
    with pytest.raises(BadInput, match="floor"):
        Floor(*values)
