"""Splines as dense systems against SciPy's."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline, make_interp_spline

from thesis_pin.numeric.interpolation import interpolate
from thesis_pin.numeric.splines import (
    MOST_NODES,
    MOST_UNEVEN,
    hermite_quintic,
    resting_cubic,
    resting_quintic,
    solvable,
)

REST = [(1, 0.0), (2, 0.0)]


def scipys_cubic(x, y):
    return CubicSpline(x, y, bc_type="clamped")


def scipys_quintic(x, y):
    return make_interp_spline(x, y, k=5, bc_type=(REST, REST))


PAIRS = [(resting_cubic, scipys_cubic), (resting_quintic, scipys_quintic)]


@pytest.mark.parametrize(("ours", "scipys"), PAIRS)
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(2, MOST_NODES))
@settings(max_examples=60, deadline=None)
def test_splines_are_scipys_to_rounding_wherever_they_are_taken(ours, scipys, seed, count):
    rng = np.random.default_rng(seed)
    size = 10.0 ** rng.uniform(-4, 2)
    x = (
        np.cumsum(size * np.exp(rng.uniform(0, np.log(MOST_UNEVEN), count)))
        + rng.uniform(-9, 9) * size
    )
    y = rng.normal(size=count)
    assert solvable(x) or np.ptp(np.diff(x)) > 0
    t = np.linspace(x[0], x[-1], 400)
    for order in range(3):
        expected = scipys(x, y)(t, order)
        found = ours(x, y)(t, order)
        np.testing.assert_allclose(found, expected, rtol=0, atol=2e-11 * np.abs(expected).max())


@pytest.mark.parametrize("method", ["cubic", "quintic"])
@pytest.mark.parametrize(
    "x", [np.arange(MOST_NODES + 1.0), np.array([0, 1e-4, 1, 2])], ids=["many", "uneven"]
)
def test_what_is_beyond_them_is_left_to_scipy(method, x):
    y = np.sin(x)
    assert not solvable(x)
    expected = {"cubic": scipys_cubic, "quintic": scipys_quintic}[method](x, y)
    curve = interpolate(x, y, method)
    np.testing.assert_array_equal(curve.x, x)
    t = np.linspace(x[0], x[-1], 200)
    for order in range(3):
        scale = np.abs(expected(t, order)).max()
        np.testing.assert_allclose(curve(t, order), expected(t, order), rtol=0, atol=1e-9 * scale)


def test_a_hermite_quintic_has_its_values_and_derivatives_at_its_knots():
    rng = np.random.default_rng(3)
    x = np.cumsum(rng.uniform(0.3, 2, 6))
    wanted = rng.normal(size=(3, 6))
    curve = hermite_quintic(x, *wanted)
    for order in range(3):
        np.testing.assert_allclose(curve(x, order), wanted[order], atol=1e-9)
        before = curve(np.nextafter(x[1:], -np.inf), order)
        np.testing.assert_allclose(before, wanted[order, 1:], atol=1e-9)
