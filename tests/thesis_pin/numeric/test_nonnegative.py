"""Non-negative least squares against SciPy's."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls

from thesis_pin.numeric.nonnegative import nonnegative


@given(
    seed=st.integers(0, 2**32 - 1),
    rows=st.integers(1, 8),
    count=st.integers(1, 60),
    kind=st.sampled_from(["any", "twins", "whole numbers", "attainable"]),
)
@settings(max_examples=200, deadline=None)
def test_what_is_missing_is_as_little_as_scipy_finds(seed, rows, count, kind):
    rng = np.random.default_rng(seed)
    matrix = rng.normal(size=(rows, count))
    if kind == "twins":
        matrix[:, rng.integers(count)] = matrix[:, rng.integers(count)]
    if kind == "whole numbers":
        matrix = np.round(matrix)
    target = rng.normal(size=rows) * 10.0 ** rng.uniform(-3, 3)
    if kind == "attainable":
        target = matrix @ np.abs(rng.normal(size=count))
    weights, size = nonnegative(matrix, target)
    assert (weights >= 0).all()
    assert (weights > 0).sum() <= rows
    np.testing.assert_allclose(size, np.linalg.norm(matrix @ weights - target), rtol=1e-12)
    np.testing.assert_allclose(size, nnls(matrix, target)[1], atol=1e-11 * np.linalg.norm(target))


def test_by_hand():
    weights, size = nonnegative(np.eye(2), np.array([3.0, -4.0]))
    assert (weights.tolist(), size) == ([3.0, 0.0], 4.0)
    weights, size = nonnegative(np.eye(2), np.array([-3.0, -4.0]))
    assert (weights.tolist(), size) == ([0.0, 0.0], 5.0)
