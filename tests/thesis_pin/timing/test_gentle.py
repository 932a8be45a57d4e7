"""The law of least load, against laws worked out by hand."""

import numpy as np
import pytest

from thesis_pin.errors import TrajectoryError
from thesis_pin.timing.gentle import gentlest
from thesis_pin.timing.judging import use
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.track import Grid

from .tracks import Wheel

INERTIA, WAY, STALL, FREE = 0.02, 6.0, 0.5, 8.0


def wheel(**more):
    limits = Limits(("m",), np.array([STALL]), np.array([FREE]), **more)
    return Grid.of(Wheel(INERTIA, WAY), 2000), limits


def test_a_wheel_is_sped_up_for_half_of_the_time_and_slowed_for_the_other():
    grid, limits = wheel()
    law, share = gentlest(grid, limits, 2.0)
    by_hand = INERTIA * WAY / (2.0 / 2) ** 2 / STALL  # way / 2 = a (t / 2)² / 2
    assert law.duration == pytest.approx(2.0)
    assert share == pytest.approx(by_hand, rel=2e-3)
    assert use(law, grid, limits, 20).peak[0] == pytest.approx(by_hand, rel=2e-3)


def test_of_a_torque_speed_line_the_largest_use_is_the_least():
    """A share of stall and no-load speed alike leaves the time constant as it is."""
    grid, limits = wheel(line=True)
    law, share = gentlest(grid, limits, 2.0)
    constant, half = INERTIA * FREE / STALL, 2.0 / 2
    way = FREE * (half - constant * (1 - np.exp(-half / constant)))  # of the whole line
    assert law.duration == pytest.approx(2.0)
    assert share == pytest.approx(WAY / 2 / way, rel=5e-3)
    assert use(law, grid, limits, 20).peak[0] == pytest.approx(WAY / 2 / way, rel=5e-3)


def test_less_time_than_the_limits_leave_is_refused():
    with pytest.raises(TrajectoryError, match=r"shall take 0\.5 s"):
        gentlest(*wheel(), 0.5)
