"""Which limit binds when, by hand."""

import numpy as np
import pytest

from thesis_pin.timing.binding import FREE, shares, stretches
from thesis_pin.timing.judging import Use, use
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.track import Grid

from .tracks import Wheel

LAW = Law(np.arange(5.0), np.array([0.0, 1.0, 1.0, 1.0, 0.0]))  # at 0, 2, 3, 4 and 6 s
USE = Use(
    ("a", "b"),
    np.array([0.999, 0.999]),
    np.array([0.5, 3.5]),
    np.array([0.999, 0.95, 0.99, 0.999]),
    np.array([0, 0, 1, 1]),
    20,
)


def test_what_is_nearly_used_up_binds_and_a_twentieth_less_is_free():
    found = [(one.limit, one.start, one.end, one.place) for one in stretches(LAW, USE)]
    assert found == [("a", 0.0, 2.0, 0.0), (FREE, 2.0, 3.0, 1.0), ("b", 3.0, 6.0, 2.0)]


def test_shares_are_those_of_the_time_the_largest_first():
    found = shares(LAW, USE)
    assert list(found) == ["b", "a", FREE]
    assert list(found.values()) == pytest.approx([1 / 2, 1 / 3, 1 / 6])


def test_a_peak_is_told_where_it_is_between_the_places():
    """Up to 1 rad/s and down again: |u + 0.2| / 2 + v / 4 is largest just before the middle."""
    track, places = Wheel(1.0, 1.0, 0.2), np.array([0.0, 0.5, 1.0])
    grid = Grid(track, (places,), (track.values(0, places),))
    limits = Limits(("m",), np.array([2.0]), np.array([4.0]), line=True)
    found = use(Law(places, np.array([0.0, 1.0, 0.0])), grid, limits, 20)
    last = 0.5 * 39 / 40  # the last of twenty points inside the first interval
    rate = np.sqrt(39 / 40)
    assert found.names[0] == "torque–speed line of m"
    assert found.place[0] == pytest.approx(last)
    assert found.peak[0] == pytest.approx(1.2 / 2 + rate / 4)
    assert found.worst == pytest.approx([1.2 / 2 + rate / 4, 0.8 / 2 + rate / 4])
