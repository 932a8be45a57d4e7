"""Strength and posterior against dense Gaussian algebra."""

import numpy as np
import pytest
from scipy.interpolate import BSpline
from scipy.linalg import null_space

from thesis_pin.smoothing.basis import Basis, penalty
from thesis_pin.smoothing.fit import Fit, strongest
from thesis_pin.smoothing.posterior import draws
from thesis_pin.smoothing.samples import Samples

SPANS = 24
BASIS = Basis(0.0, 2.0, SPANS)
RANDOM = np.random.default_rng(7)
TIME = np.sort(RANDOM.uniform(0.0, 2.0, 60))
VALUES = np.sin(3 * TIME) + 0.01 * RANDOM.standard_normal(60)
WEIGHT = RANDOM.uniform(0.2, 1.0, 60)


def samples(first: float | None = None, last: float | None = None) -> Samples:
    return Samples(BASIS.rows(TIME), VALUES, WEIGHT, 0.0, (first, last))


def matrices(order: int) -> tuple[np.ndarray, np.ndarray]:
    """B and P, dense, by SciPy and by differences of its Gram matrix."""
    knots = np.concatenate([[0.0] * 5, BASIS.knots, [2.0] * 5])
    every = BSpline(knots, np.eye(BASIS.count), 5)
    places = np.linspace(0.0, 2.0, 20 * SPANS + 1)
    middle = (places[1:] + places[:-1]) / 2
    half = (places[1] - places[0]) / 2
    p = np.zeros((BASIS.count, BASIS.count))
    for shift in (-np.sqrt(0.6), 0.0, np.sqrt(0.6)):
        value = every(middle + shift * half, order) * BASIS.step**order
        p += (8 / 9 if shift == 0 else 5 / 9) * half / BASIS.step * value.T @ value
    return every(TIME), p


@pytest.mark.parametrize("order", [3, 4])
def test_the_curve_is_the_penalised_least_squares_one(order: int) -> None:
    b, p = matrices(order)
    a = b.T @ (WEIGHT[:, None] * b) + np.exp(2.0) * p
    expected = np.linalg.solve(a, b.T @ (WEIGHT * VALUES))
    found = Fit(samples(), order).at(2.0)
    np.testing.assert_allclose(found.coefficients, expected, rtol=1e-6, atol=1e-7)
    assert found.determinant == pytest.approx(np.linalg.slogdet(a)[1], abs=1e-6)
    rest = VALUES - b @ expected
    total = WEIGHT @ rest**2 + np.exp(2.0) * expected @ p @ expected
    assert found.total == pytest.approx(total, rel=1e-8)


@pytest.mark.parametrize("order", [3, 4])
def test_the_criterion_is_the_restricted_likelihood_of_the_gaussian_process(order: int) -> None:
    b, p = matrices(order)
    values, vectors = np.linalg.eigh(p)
    rough = vectors[:, order:] / np.sqrt(values[order:])  # P's pseudo-inverse is rough roughᵀ
    contrasts = null_space((b @ vectors[:, :order]).T)  # what polynomials of low degree leave
    fit, sigma = Fit(samples(), order), 0.013

    def dense(strength: float) -> float:
        covariance = sigma**2 * (
            np.diag(1 / WEIGHT) + (b @ rough) @ (b @ rough).T / np.exp(strength)
        )
        inner = contrasts.T @ covariance @ contrasts
        y = contrasts.T @ VALUES
        return float(np.linalg.slogdet(inner)[1] + y @ np.linalg.solve(inner, y))

    for one, other in ((-2.0, 1.0), (1.0, 5.0)):
        ours = fit.criterion(one, sigma, 0.0) - fit.criterion(other, sigma, 0.0)
        assert ours == pytest.approx(dense(one) - dense(other), rel=1e-5, abs=1e-4)


def test_fixed_ends_hold_value_and_rest() -> None:
    fit = Fit(samples(first=0.2, last=-0.4), 4)
    c = fit.at(1.0).coefficients
    assert (c[:2] == 0.2).all()
    assert (c[-2:] == -0.4).all()
    b, p = matrices(4)
    a = b.T @ (WEIGHT[:, None] * b) + np.exp(1.0) * p
    inner = slice(2, -2)
    fixed = np.zeros(BASIS.count)
    fixed[:2], fixed[-2:] = 0.2, -0.4
    right = (b.T @ (WEIGHT * VALUES) - a @ fixed)[inner]
    np.testing.assert_allclose(c[inner], np.linalg.solve(a[inner, inner], right), atol=1e-7)


def test_draws_have_the_posteriors_mean_and_covariance() -> None:
    b, p = matrices(4)
    found = strongest(Fit(samples(), 4), 0.01, 0.0)
    a = b.T @ (WEIGHT[:, None] * b) + np.exp(found.log) * p
    made = draws(found, np.random.default_rng(1).standard_normal((BASIS.count, 4000)))
    at = b[::7]
    np.testing.assert_allclose(
        (at @ made).mean(axis=1), at @ found.solution.coefficients, atol=1e-3
    )
    expected = found.sigma**2 * at @ np.linalg.solve(a, at.T)
    np.testing.assert_allclose(np.cov(at @ made), expected, atol=0.08 * expected.max())


def test_draws_follow_their_fixed_ends() -> None:
    found = strongest(Fit(samples(first=0.0), 4), 0.01, 0.0)
    made = draws(found, np.zeros((BASIS.count, 2)), np.array([[0.0, 0.3], [0.0, 0.0]]))
    moved = Fit(samples(first=0.3), 4).at(found.log).coefficients
    np.testing.assert_allclose(made[:, 0], found.solution.coefficients)
    np.testing.assert_allclose(made[:, 1], moved, atol=1e-8)


def test_many_samples_a_span_give_the_same_sums_as_each_alone() -> None:
    time = np.linspace(0.0, 2.0, 900)
    values = np.cos(2 * time) + 0.01 * RANDOM.standard_normal(900)
    basis, weight = Basis(0.0, 2.0, 20), RANDOM.uniform(0.1, 1.0, 900)
    many = Samples(basis.rows(time), values, weight, 0.0, (None, None))
    c = RANDOM.standard_normal(basis.count)
    rest = values - many.rows(c)
    assert many._few is not None
    assert many.misfit(c) == pytest.approx(float(weight @ rest**2), rel=1e-12)


def test_noise_is_never_below_the_floor() -> None:
    time = np.linspace(0.0, 1.0, 400)
    staircase = np.round(0.3 * time**2, 2)
    basis = Basis(0.0, 1.0, 100)
    one = Samples(basis.rows(time), staircase, np.ones(400), 0.0, (None, None))
    found = strongest(Fit(one, 4), 0.01 / np.sqrt(12), 0.0)
    assert found.sigma >= 0.01 / np.sqrt(12)


@pytest.mark.parametrize("order", [3, 4])
def test_strength_is_the_least_of_the_criterion(order: int) -> None:
    fit = Fit(samples(), order)
    found = strongest(fit, 0.0, 0.0)
    finely = min(fit.criterion(x, None, 0.0) for x in np.linspace(-15, 17.5, 400))
    assert fit.criterion(found.log, None, 0.0) <= finely + 0.3
    assert found.sigma == pytest.approx(0.01, rel=0.4)


def test_penalties_are_made_once() -> None:
    assert penalty(SPANS, 4) is penalty(SPANS, 4)
