"""Which limit binds when, by hand."""

import numpy as np
import pytest

from thesis_pin.timing.binding import FREE, shares, stretches
from thesis_pin.timing.judging import Use
from thesis_pin.timing.law import Law

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
