"""Inequalities in one number, against trying them on a grid."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.numeric.inequalities import Intervals, rest_of, where_lines_hold, where_positive

LOW, HIGH = 0.2, 5.0
numbers = st.floats(-10, 10).map(lambda x: round(x, 3)) | st.sampled_from([0.0, 1.0, -1.0])


@settings(max_examples=300, deadline=None)
@given(st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=6))
def test_a_quadratic_is_positive_just_inside_its_intervals_and_nowhere_else(rows):
    a, b, c = np.array(rows).T
    start, end, which = where_positive((a, b, c), LOW, HIGH)
    assert (start < end).all()
    grid = np.linspace(LOW, HIGH, 999)[1:-1]
    for k in range(len(a)):
        value = (a[k] * grid + b[k]) * grid + c[k]
        inside = np.zeros(len(grid), dtype=bool)
        for s, e in zip(start[which == k], end[which == k], strict=True):
            inside |= (grid > s) & (grid < e)
        scale = abs(a[k]) * grid**2 + abs(b[k]) * grid + abs(c[k])
        clear = np.abs(value) > 1e-9 * (scale + 1e-9)
        np.testing.assert_array_equal(inside[clear], value[clear] > 0)


@settings(max_examples=200, deadline=None)
@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=8))
def test_lines_hold_between_the_ends_and_break_beyond(lines):
    offset, slope = np.array(lines).T
    low, high = (ends[0] for ends in where_lines_hold(offset[None], slope[None]))
    for x in np.linspace(-20, 20, 801):
        value = offset + slope * x
        if np.abs(value).min() > 1e-9:
            assert (value <= 0).all() == (low <= x <= high)


@settings(max_examples=300, deadline=None)
@given(st.lists(st.tuples(st.floats(0, 6), st.floats(0, 2)), max_size=8))
def test_what_is_left_is_what_no_interval_covers_and_each_end_names_its_interval(spans):
    start = np.array([a for a, _ in spans])
    end = start + np.array([width for _, width in spans])
    taken = Intervals(start, end, np.arange(len(spans))[:, None])
    left = rest_of(taken, LOW, HIGH)
    for x in np.linspace(LOW, HIGH, 643)[1:-1]:
        if len(spans) and np.abs(np.concatenate([start, end]) - x).min() < 1e-9:
            continue
        covered = bool(((start < x) & (x < end)).any())
        assert covered != any(one.low < x < one.high for one in left)
    for one in left:
        assert one.low == (LOW if one.below is None else end[one.below])
        assert one.high == (HIGH if one.above is None else start[one.above])


def test_no_interval_leaves_everything():
    (one,) = rest_of(Intervals.joined([], 1), 1.0, 2.0)
    assert (one.low, one.high, one.below, one.above) == (1.0, 2.0, None, None)


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e12])
def test_nearly_equal_numbers_dont_cancel_in_a_root(scale):
    """x² − 10⁸ x + 1 is negative between 10⁻⁸ and nearly 10⁸."""
    row = tuple(np.array([scale * x]) for x in (1.0, -1e8, 1.0))
    start, end, _ = where_positive(row, 1e-10, 1.0)
    assert (start[0], end[0]) == (1e-10, pytest.approx(1e-8, rel=1e-12))
