"""Smooth curves against truths, against thinned least squares, and against staircases."""

import numpy as np
import pytest
from scipy.interpolate import make_lsq_spline

from thesis_pin.smoothing.curve import (
    End,
    SmoothCurve,
    constant_curve,
    generator,
    joined,
    smooth_curve,
)


def truth(t: np.ndarray, order: int = 0) -> np.ndarray:
    """A motion of a walker's size, and its derivatives."""
    parts = ((0.02, 5.0, 0.3), (0.004, 11.0, 1.0))
    return np.asarray(
        sum(a * w**order * np.sin(w * t + p + order * np.pi / 2) for a, w, p in parts)
    )


def rounded(rate: float, quantum: float, seconds: float = 4.0) -> tuple[np.ndarray, np.ndarray]:
    t = np.arange(0.0, seconds + 1e-9, 1 / rate)
    return t, np.round(truth(t) / quantum) * quantum


@pytest.mark.parametrize("rate", [50, 300, 1000])
@pytest.mark.parametrize("quantum", [1e-6, 1e-5, 1e-4])
def test_accelerations_lie_within_what_the_curve_says_of_itself(
    rate: float, quantum: float
) -> None:
    curve = smooth_curve(*rounded(rate, quantum), quantum, generator(0))
    at = np.linspace(0.0, 4.0, 401)
    error = curve.value(at, 2) - truth(at, 2)
    spread = 3 * curve.draws(at, 2).std(axis=1, ddof=1)
    spread += np.abs(curve.value(at, 2) - curve.rival(at, 2))
    assert np.mean(np.abs(error) <= spread) >= 0.95
    assert np.sqrt(np.mean(error**2)) < {1e-6: 0.01, 1e-5: 0.03, 1e-4: 0.12}[quantum]


@pytest.mark.parametrize(("rate", "quantum"), [(1000, 1e-3), (1000, 1e-4), (300, 1e-4)])
def test_a_staircase_is_not_followed(rate: float, quantum: float) -> None:
    t, y = rounded(rate, quantum)
    through = np.gradient(np.gradient(y, t), t)
    curve = smooth_curve(t, y, quantum, generator(0))
    error = curve.value(t, 2) - truth(t, 2)
    assert np.abs(error).max() < 0.05 * np.abs(through - truth(t, 2)).max()
    assert np.sqrt(np.mean(error**2)) < 0.1 * np.sqrt(np.mean(truth(t, 2) ** 2))
    assert curve.sigma >= quantum / np.sqrt(12) * (1 - 1e-12)


def test_thinned_least_squares_lies_within_its_interval() -> None:
    t, y = rounded(300, 1e-4)
    knots = np.concatenate([[t[0]] * 5, t[::48], [t[-1]] * 5])
    other = make_lsq_spline(t, y, knots, k=5)(t, nu=2)
    curve = smooth_curve(t, y, 1e-4, generator(0))
    spread = 3 * curve.draws(t, 2).std(axis=1, ddof=1)
    spread += np.abs(curve.value(t, 2) - curve.rival(t, 2))
    inner = slice(60, -60)  # least squares is wild at its ends
    assert np.mean((np.abs(other - curve.value(t, 2)) <= spread)[inner]) > 0.95


def test_noise_that_digits_do_not_show_is_found() -> None:
    t = np.arange(0.0, 4.0, 0.005)
    y = truth(t) + 1e-4 * np.random.default_rng(5).standard_normal(len(t))
    curve = smooth_curve(t, y, 1e-9, generator(0))
    assert curve.sigma == pytest.approx(1e-4, rel=0.15)


def test_a_jump_of_acceleration_is_met_by_local_strength() -> None:
    t = np.arange(0.0, 2.0 + 1e-9, 0.005)
    y = np.round(np.where(t > 1.0, 0.5 * (t - 1.0) ** 2, 0.0), 5)  # at rest, then 1 m/s²
    curve = smooth_curve(t, y, 1e-5, generator(0))
    away = np.abs(t - 1.0) > 0.1
    expected = np.where(t > 1.0, 1.0, 0.0)
    assert np.abs(curve.value(t, 2) - expected)[away].max() < 0.1
    assert np.abs(curve.value(t, 2)[t < 0.8]).max() < 0.01


def test_ends_at_rest_hold_their_value_and_rest_in_every_draw() -> None:
    t = np.linspace(0.0, 1.0, 101)
    y = np.round(0.05 * (10 * t**3 - 15 * t**4 + 6 * t**5), 4)
    first, last = End(0.0, np.full(16, 1e-5)), End(0.05, np.linspace(-1e-5, 1e-5, 16))
    curve = smooth_curve(t, y, 1e-4, generator(0), ends=(first, last))
    ends = np.array([0.0, 1.0])
    assert curve.value(ends).tolist() == pytest.approx([0.0, 0.05], abs=1e-15)
    assert np.abs(curve.value(ends, 1)).max() < 1e-12
    assert np.abs(curve.rival(ends, 1)).max() < 1e-12
    np.testing.assert_allclose(curve.draws(ends), np.stack([first.offsets, 0.05 + last.offsets]))
    assert np.abs(curve.draws(ends, 1)).max() < 1e-12


def test_the_same_samples_give_the_same_draws_and_columns_differ() -> None:
    t, y = rounded(100, 1e-4)
    one, same, other = (smooth_curve(t, y, 1e-4, generator(k)) for k in (0, 0, 1))
    assert np.array_equal(one.variants.c, same.variants.c)
    assert not np.array_equal(one.variants.c[..., 2:], other.variants.c[..., 2:])
    assert np.array_equal(one.variants.c[..., 0], other.variants.c[..., 0])


@pytest.mark.parametrize("unit", [1e-3, 1e3])
def test_units_do_not_matter(unit: float) -> None:
    t, y = rounded(100, 1e-4)
    one = smooth_curve(t, y, 1e-4, generator(0))
    other = smooth_curve(t * unit, y * 7.0, 7e-4, generator(0))
    np.testing.assert_allclose(
        other.value(t * unit, 2) * unit**2 / 7.0, one.value(t, 2), rtol=1e-5, atol=1e-7
    )


def test_two_samples_almost_at_once_do_no_harm() -> None:
    t, y = rounded(100, 1e-5)
    k = 200
    t2, y2 = np.insert(t, k, t[k] - 1e-9), np.insert(y, k, y[k])
    plain = smooth_curve(t, y, 1e-5, generator(0)).value
    twice = smooth_curve(t2, y2, 1e-5, generator(0)).value
    at = np.linspace(0.0, 4.0, 200)
    assert np.abs(plain(at, 2) - twice(at, 2)).max() < 0.05


@pytest.mark.parametrize("count", [5, 6, 8, 13])
def test_few_samples_still_give_a_curve(count: int) -> None:
    t = np.linspace(0.0, 1.0, count)
    curve = smooth_curve(t, np.round(t**2, 3), 1e-3, generator(0))
    assert np.abs(curve.value(t) - t**2).max() < 5e-3
    assert np.isfinite(curve.variants.c).all()


def test_a_fast_motion_in_a_long_file_is_not_taken_for_noise() -> None:
    t = np.arange(0.0, 40.0, 1 / 300)
    y = np.round(0.02 * np.sin(40 * t), 5)
    curve = smooth_curve(t, y, 1e-5, generator(0))
    inner = (t > 0.5) & (t < 39.5)
    error = curve.value(t, 2) + 32.0 * np.sin(40 * t)
    assert np.abs(error[inner]).max() < 0.02 * 32.0


def test_pieces_join_to_one_curve() -> None:
    rest = constant_curve(0.0, 1.0, End(0.1, np.zeros(16)))
    t = np.linspace(1.0, 2.0, 60)
    rise = smooth_curve(
        t, 0.1 + (t - 1) ** 3, 1e-6, generator(0), ends=(End(0.1, np.zeros(16)), None)
    )
    whole = joined([rest, rise])
    assert isinstance(whole, SmoothCurve)
    np.testing.assert_allclose(whole.value([0.5, 1.5]), [0.1, rise.value(1.5)])
    assert whole.draws(np.array([0.2, 1.2])).shape == (2, 16)


def test_where_zero_is_does_not_matter() -> None:
    t, y = rounded(100, 1e-4)
    one = smooth_curve(t, y, 1e-4, generator(0))
    other = smooth_curve(t, y + 400.0, 1e-4, generator(0))
    np.testing.assert_allclose(other.variants(t) - 400.0, one.variants(t), atol=1e-9)


def test_the_rival_is_better_where_an_acceleration_jumps_and_worse_where_nothing_does() -> None:
    t = np.arange(0.0, 2.0 + 1e-9, 0.005)
    jerky = smooth_curve(
        t, np.round(np.where(t > 1.0, 0.5 * (t - 1.0) ** 2, 0.0), 5), 1e-5, generator(0)
    )
    at = np.linspace(0.9, 1.1, 101)
    own, rival = (
        np.sqrt(np.mean((curve(at, 2) - (at > 1.0)) ** 2)) for curve in (jerky.value, jerky.rival)
    )
    assert rival < 0.95 * own
    smooth = smooth_curve(*rounded(300, 1e-5), 1e-5, generator(0))
    at = np.linspace(0.0, 4.0, 401)
    own, rival = (
        np.sqrt(np.mean((curve(at, 2) - truth(at, 2)) ** 2))
        for curve in (smooth.value, smooth.rival)
    )
    assert own < 0.5 * rival


def test_the_errors_of_a_staircase_are_counted_once_a_step() -> None:
    """Some hundred rows a step: they don't average out as independent ones would."""
    t, y = rounded(1000, 3e-3)
    curve = smooth_curve(t, y, 3e-3, generator(0))
    for order in (0, 2):
        spread = 3 * curve.draws(t, order).std(axis=1, ddof=1)
        assert np.mean(np.abs(curve.value(t, order) - truth(t, order)) <= spread) > 0.97


def test_less_is_left_open_at_rest_than_in_motion() -> None:
    t = np.arange(0.0, 4.0, 0.005)
    u = np.clip(t - 2.0, 0.0, 1.0)
    noise = 1e-5 * np.random.default_rng(4).standard_normal(len(t))
    curve = smooth_curve(t, 0.05 * (10 * u**3 - 15 * u**4 + 6 * u**5) + noise, 1e-7, generator(0))
    spread = curve.draws(t, 2).std(axis=1, ddof=1)
    rest, motion = spread[(t > 0.2) & (t < 1.5)], spread[(t > 2.1) & (t < 2.9)]
    assert rest.mean() < 0.5 * motion.mean()
    assert np.sqrt(np.mean(curve.value(t[t < 1.5], 2) ** 2)) < 1.1e-3
