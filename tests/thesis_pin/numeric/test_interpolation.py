"""Curves through nodes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.errors import NotFinite, TrajectoryError, UnknownName
from thesis_pin.numeric.interpolation import (
    METHODS,
    constant,
    free_quintic,
    interpolate,
    join,
    jumps,
    polynomial,
)

SMOOTH = {"linear": 0, "quadratic": 1, "cubic": 2, "free": 2, "quintic": 4}


def nodes(seed, count):
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.uniform(0.2, 2, count)), rng.normal(size=count)


@given(
    seed=st.integers(0, 2**32 - 1), count=st.integers(2, 9), method=st.sampled_from(list(METHODS))
)
@settings(max_examples=80, deadline=None)
def test_curves_pass_through_their_nodes_and_are_as_smooth_as_promised(seed, count, method):
    t, value = nodes(seed, count)
    curve = interpolate(t, value, method)
    np.testing.assert_allclose(curve(t), value, atol=1e-7)
    for order in range(SMOOTH[method] + 1):
        below = curve(np.nextafter(t[1:-1], -np.inf), order)
        above = curve(np.nextafter(t[1:-1], np.inf), order)
        scale = 1 + np.abs(above).max(initial=0)
        np.testing.assert_allclose(below, above, atol=1e-6 * scale)


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(2, 9))
@settings(max_examples=40, deadline=None)
def test_quadratic_curve_solves_equations_c3_to_c5(seed, count):
    """The 3m equations of appendix C, as one linear system, give the same pieces."""
    t, value = nodes(seed, count)
    m = count - 1
    matrix, right = np.zeros((3 * m, 3 * m)), np.zeros(3 * m)
    row = 0
    for k in range(m):  # C.3
        for end in (k, k + 1):
            matrix[row, 3 * k : 3 * k + 3] = t[end] ** 2, t[end], 1
            right[row] = value[end]
            row += 1
    for k in range(m - 1):  # C.4
        matrix[row, 3 * k : 3 * k + 6] = 2 * t[k + 1], 1, 0, -2 * t[k + 1], -1, 0
        row += 1
    matrix[row, 0] = 1  # C.5
    solved = np.linalg.solve(matrix, right).reshape(m, 3)
    curve = interpolate(t, value, "quadratic")
    for k in range(m):
        inside = np.linspace(t[k], t[k + 1], 5)[:-1]
        np.testing.assert_allclose(curve(inside), np.polyval(solved[k], inside), atol=1e-6)


@pytest.mark.parametrize(("method", "orders"), [("cubic", 1), ("quintic", 2)])
def test_smooth_curves_start_and_end_at_rest(method, orders):
    curve = interpolate([0, 1, 3], [1.0, 2.0, -1.0], method)
    for order in range(1, orders + 1):
        np.testing.assert_allclose(curve([0.0, 3.0], order), 0.0, atol=1e-12)


def test_samples_of_a_cubic_give_it_back_when_the_ends_are_free():
    t = np.linspace(0, 2, 9)
    curve = interpolate(t, t**3 - t, "free")
    probe = np.linspace(0, 2, 31)
    np.testing.assert_allclose(curve(probe), probe**3 - probe, atol=1e-13)
    np.testing.assert_allclose(curve(probe, 1), 3 * probe**2 - 1, atol=1e-12)


def test_samples_of_a_quintic_give_it_back():
    t = np.array([0, 0.3, 1.1, 1.5, 2.4, 3.0, 3.1])
    true = np.polynomial.Polynomial([1, -2, 0.5, 0.3, -0.4, 0.1])
    curve, at = free_quintic(t, true(t)), np.linspace(0, 3.1, 50)
    for order in range(4):
        expected = true.deriv(order)(at) if order else true(at)
        np.testing.assert_allclose(curve(at, order), expected, atol=1e-9)
    few = free_quintic(t[:5], true(t[:5]))
    np.testing.assert_array_equal(few(at), interpolate(t[:5], true(t[:5]), "free")(at))


def test_jumps_are_found_at_inner_knots():
    curve = join([constant(0, 1, 2.0), polynomial(1, 3, [1.0, 1.5]), constant(3, 4, 4.5)])
    np.testing.assert_allclose(jumps(curve), [0.5, 0.0], atol=1e-15)
    np.testing.assert_allclose(jumps(curve, 1), [1.0, -1.0], atol=1e-15)


def test_printed_polynomials_and_joined_pieces_keep_their_values():
    # y_B of appendix D, whose second piece starts at 20.
    first = polynomial(15, 20, [0.0333, 1.2333, 46])
    second = polynomial(20, 25, [-0.2427, 12.275, -64.4167])
    joined = join([first, second, constant(25, 40, 90.76)])
    for t, expected in (
        (17.0, 0.0333 * 17**2 + 1.2333 * 17 + 46),
        (20.0, -0.2427 * 400 + 12.275 * 20 - 64.4167),  # the later piece holds
        (30.0, 90.76),
    ):
        assert joined(t) == pytest.approx(expected, abs=1e-10)
    assert joined(17.0, 1) == pytest.approx(2 * 0.0333 * 17 + 1.2333)


@pytest.mark.parametrize(
    ("t", "value", "method", "error", "says"),
    [
        ([0, 1], [0, 1], "bezier", UnknownName, "quintic"),
        ([0, 1, 1], [0, 1, 2], "cubic", TrajectoryError, "from 1 to 1 at node 2"),
        ([0, 1], [0, 1, 2], "linear", TrajectoryError, "as many values"),
        ([0], [0], "linear", TrajectoryError, "at least 2"),
        ([0, np.nan], [0, 1], "linear", NotFinite, "t isn't finite"),
    ],
)
def test_bad_nodes_are_refused(t, value, method, error, says):
    with pytest.raises(error, match=says):
        interpolate(t, value, method)


def test_steps_too_short_and_polynomials_too_long_or_too_large_are_refused():
    with pytest.raises(TrajectoryError, match="steps of at least 1e-09"):
        interpolate([0.0, 1e-300], [0.0, 1.0])
    with pytest.raises(TrajectoryError, match="40 coefficients; allowed: at most 32"):
        polynomial(0.0, 1.0, [1.0] * 40)
    with pytest.raises(TrajectoryError, match="a polynomial overflows"):
        polynomial(1e12, 2e12, [1e12] * 30)
