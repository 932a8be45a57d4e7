"""The least size of motors with which something is in time, of functions whose border is known."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pollard_pin.study.smallest.searching import _FAR, _least
from thesis_pin.errors import BadInput
from thesis_pin.tolerances import TOLERANCES

SEVERAL = settings(max_examples=100, deadline=None, derandomize=True)


def counted(function):
    asked = []

    def excess(size):
        asked.append(size)
        return min(function(size), _FAR)

    return excess, asked


@SEVERAL
@given(st.floats(0.3, 3.0), st.floats(0.3, 2.0), st.floats(0.0, 0.9))
def test_the_least_size_is_in_time_and_just_so_in_few_tries(border, power, weight):
    """Time grows without bound towards what just holds the robot."""

    def late(size):
        if size <= weight * border:
            return math.inf
        share = (size - weight * border) / (border - weight * border)
        return -power * math.log(share)

    excess, asked = counted(late)
    found = _least(excess, 1.0)
    assert border * (1 - 1e-12) <= found <= border * (1 + TOLERANCES.motor_torque)
    assert len(asked) <= 25
    near, few = counted(late)
    _least(near, border * 1.005)
    assert len(few) <= 10


@pytest.mark.parametrize("start", [0.01, 0.4, 1.0, 1.9, 30.0])
def test_where_larger_motors_are_too_slow_the_smaller_border_is_found(start):
    excess, _ = counted(lambda size: math.log(max(1.0 / size, size / 2.0)))
    found = _least(excess, start)
    assert 1.0 <= found <= 1.0 + TOLERANCES.motor_torque


def test_what_hardly_gets_slower_with_smaller_motors_takes_no_endless_search():
    excess, asked = counted(lambda size: -1e-3 if size > 1e-3 else 1.0)
    assert 1e-3 <= _least(excess, 1.0) <= 1e-3 * (1 + TOLERANCES.motor_torque)
    assert len(asked) <= 60


def test_that_no_size_is_in_time_is_said():
    with pytest.raises(BadInput, match="however strong"):
        _least(lambda size: 0.1, 1.0)
