"""Limits as rows: those of vectors are strict and nearly full, and rows of ṡ² alone cap it."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from thesis_pin.timing.passes import Spans, ceiling, largest
from thesis_pin.timing.rows import disc, two_sided

VECTORS = arrays(float, (3, 3), elements=st.integers(-8, 8).map(lambda k: k / 4))


@settings(deadline=None, derandomize=True)
@given(VECTORS, st.floats(-3, 3), st.floats(0, 2))
def test_rows_of_a_vector_hold_only_within_its_limit_and_almost_up_to_it(linear, bend, rate):
    """Its constant part may point anywhere, also out of the plane of the others."""
    a, b, d = linear
    assume(not 0.99 < np.linalg.norm(d) / 2.0 <= 1.0)
    size = np.linalg.norm(a * bend + b * rate**2 + d)
    rows = disc((a[None], b[None], d[None]), 2.0, "force")
    kept = (rows.use(np.array([rate]), np.array([bend])) <= 1.0).all()
    if kept:
        assert size <= 2.0 * (1 + 1e-9)
    elif np.linalg.norm(d) < 2.0:
        # Half a per cent of the disc in the plane is cut off, whatever is across.
        assert size >= 0.994 * 2.0


@pytest.mark.parametrize("constant", [[0.0, 0.0, 3.0], [0.1, 0.0, 3.0], [3.0, 0.0, 0.0]])
def test_a_constant_that_is_too_large_by_itself_is_told_by_its_own_share(constant):
    """Whether across the plane of what s̈ and ṡ² do, along it, or both."""
    rows = disc((np.eye(3)[:1], np.eye(3)[1:2], np.array([constant])), 2.0, "force")
    share = rows.use(np.array([0.1]), np.array([0.2])).max()
    assert share == pytest.approx(np.linalg.norm(constant) / 2.0)
    assert rows.use(np.zeros(1), np.zeros(1)).max() == share


def sides(square, count):
    """A motor that only ṡ² asks something of: |square ṡ²| ≤ 1 at each of some places."""
    parts = np.zeros((count, 1)), np.reshape(square, (count, 1)), np.zeros((count, 1))
    return two_sided(parts, np.ones(1), ["torque"])


def test_rows_without_acceleration_cap_the_rate_at_both_ends_of_an_interval():
    """Of the second place its left side says more, of the first only its right one there is."""
    left, right = sides([0.5, 0.1], 2), sides([2.0, 0.1], 2)
    spans = Spans(np.ones(2), left, right, np.full(3, 100.0))
    np.testing.assert_allclose(ceiling(spans, np.ones(3)), [2.0, 10.0])
    np.testing.assert_allclose(largest(spans, np.ones(3)), [2.0, 0.5, 10.0])
