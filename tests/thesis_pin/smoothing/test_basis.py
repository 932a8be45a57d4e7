"""B-splines and penalties against SciPy's dense ones and quadrature."""

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.interpolate import BSpline, PPoly

from thesis_pin.smoothing.basis import Basis, penalty


def dense(band: np.ndarray) -> np.ndarray:
    """A symmetric matrix from its lower bands."""
    n = band.shape[1]
    full = np.zeros((n, n))
    for d, line in enumerate(band):
        for j in range(n - d):
            full[j + d, j] = full[j, j + d] = line[j]
    return full


def spline(basis: Basis, coefficients: np.ndarray) -> BSpline:
    """The same spline by SciPy."""
    knots = np.concatenate([[basis.start] * 5, basis.knots, [basis.end] * 5])
    return BSpline(knots, coefficients, 5)


@pytest.mark.parametrize("spans", [3, 11, 40])
def test_values_and_powers_are_those_of_scipys_spline(spans: int) -> None:
    basis, random = Basis(-1.0, 2.5, spans), np.random.default_rng(spans)
    c, t = random.standard_normal(basis.count), np.sort(random.uniform(-1.0, 2.5, 200))
    expected = spline(basis, c)
    np.testing.assert_allclose(basis.rows(t)(c), expected(t), atol=1e-13)
    made = PPoly(basis.polynomials(c), basis.knots)
    for order in range(6):
        np.testing.assert_allclose(made(t, order), expected(t, order), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("spans", [1, 2, 5, 12, 300])
def test_b_splines_are_scipys_to_the_bit(spans: int) -> None:
    basis = Basis(0.0, float(spans), spans)
    t = np.sort(np.append(np.random.default_rng(spans).uniform(0, spans, 500), basis.knots))
    knots = np.concatenate([[0.0] * 5, basis.knots, [float(spans)] * 5])
    expected, rows = BSpline.design_matrix(t, knots, 5), basis.rows(t)
    np.testing.assert_array_equal(rows.values.ravel(), expected.data)
    np.testing.assert_array_equal(rows.first, expected.indices[::6])


def test_polynomials_take_several_splines_at_once() -> None:
    basis = Basis(0.0, 1.0, 20)
    c = np.random.default_rng(1).standard_normal((basis.count, 3))
    together = basis.polynomials(c)
    for k in range(3):
        np.testing.assert_allclose(together[..., k], basis.polynomials(c[:, k]), rtol=1e-12)


@pytest.mark.parametrize("spans", [4, 17])
@pytest.mark.parametrize("order", [3, 4])
def test_the_penalty_is_the_integral_of_the_squared_derivative(spans: int, order: int) -> None:
    basis = Basis(0.0, float(spans), spans)
    every = spline(basis, np.eye(basis.count))
    expected = sum(
        quad_vec(lambda t: np.outer(every(t, order), every(t, order)), k + 1e-12, k + 1 - 1e-12)[0]
        for k in range(spans)
    )
    np.testing.assert_allclose(dense(penalty(spans, order).bands()), expected, atol=1e-9)


def test_a_weighted_penalty_weighs_each_span() -> None:
    spans, order = 9, 4
    weight = np.random.default_rng(2).uniform(0.1, 3.0, spans)
    every = spline(Basis(0.0, 9.0, spans), np.eye(spans + 5))
    expected = sum(
        w * quad_vec(lambda t: np.outer(every(t, order), every(t, order)), k, k + 1 - 1e-12)[0]
        for k, w in enumerate(weight)
    )
    made = penalty(spans, order)
    at_points = np.repeat(weight[:, None], 3, axis=1)
    np.testing.assert_allclose(dense(made.bands(at_points)), expected, atol=1e-9)
    c = np.random.default_rng(3).standard_normal(spans + 5)
    np.testing.assert_allclose(made.times(c, at_points), expected @ c, atol=1e-8)
    np.testing.assert_allclose((at_points * made.roots(c) ** 2).sum(), c @ expected @ c, rtol=1e-9)


def test_normal_equations_are_sums_over_samples() -> None:
    basis, random = Basis(0.0, 1.0, 13), np.random.default_rng(4)
    t, w, y = (
        np.sort(random.uniform(0.3, 0.9, 50)),
        random.uniform(0.1, 1, 50),
        random.normal(0, 1, 50),
    )
    rows = basis.rows(t)  # some spans are empty
    matrix = spline(basis, np.eye(basis.count))(t)
    np.testing.assert_allclose(dense(rows.gram(w)), matrix.T @ (w[:, None] * matrix), atol=1e-13)
    np.testing.assert_allclose(rows.moments(w * y), matrix.T @ (w * y), atol=1e-13)
