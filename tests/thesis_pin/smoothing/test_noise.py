"""Quantum, noise, stillness: on samples whose noise is known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.numeric.interpolation import interpolate
from thesis_pin.smoothing.noise import (
    acceleration_noise,
    difference_noise,
    rate_noise,
    run_lengths,
    still,
    uneven,
    white_noise,
)

TIME = np.linspace(0.0, 6.0, 601)
MOTION = 0.02 * np.sin(5 * TIME) + 0.01 * np.cos(2 * TIME)


@given(st.integers(0, 10_000))
def test_white_noise_is_found_to_a_fifth(seed: int) -> None:
    noisy = MOTION + 1e-4 * np.random.default_rng(seed).standard_normal(len(TIME))
    assert white_noise(noisy) == pytest.approx(1e-4, rel=0.3)
    assert difference_noise(noisy, 6) == pytest.approx(1e-4, rel=0.3)


@pytest.mark.parametrize("every", [1, 4, 10, 20])
def test_a_motion_without_noise_shows_none(every: int) -> None:
    assert white_noise(MOTION[::every]) < 1e-13


def test_a_splines_acceleration_is_as_wrong_as_promised() -> None:
    random, h, found = np.random.default_rng(3), 0.01, []
    t = h * np.arange(400)
    for _ in range(10):
        curve = interpolate(t, 1e-4 * random.standard_normal(400), "free")
        found.append(np.sqrt(np.mean(curve(t[20:-20], 2) ** 2)))
    assert np.mean(found) == pytest.approx(acceleration_noise(1e-4, h), rel=0.1)


def test_a_splines_rate_is_as_wrong_as_promised() -> None:
    random, h, found = np.random.default_rng(3), 0.01, []
    t = h * np.arange(400)
    for _ in range(10):
        curve = interpolate(t, 1e-4 * random.standard_normal(400), "free")
        found.append(np.sqrt(np.mean(curve(t[20:-20], 1) ** 2)))
    assert np.mean(found) == pytest.approx(rate_noise(1e-4, h), rel=0.1)


@pytest.mark.parametrize("order", [2, 6, 10])
def test_noise_by_differences_is_right_on_average(order: int) -> None:
    random = np.random.default_rng(order)
    found = [difference_noise(random.standard_normal(5000), order) for _ in range(40)]
    assert np.mean(found) == pytest.approx(1.0, rel=0.02)


def test_runs_are_counted() -> None:
    assert run_lengths(np.array([1.0, 1, 2, 3, 3, 3])).tolist() == [2, 2, 1, 3, 3, 3]


def test_rounded_time_stamps_are_uneven_and_even_ones_not() -> None:
    assert uneven(np.round(np.arange(100) / 60, 4), 1e-4) == pytest.approx(1e-4 / np.sqrt(12))
    assert uneven(np.arange(100) / 50, 1e-2) == 0.0


@pytest.mark.parametrize("seed", range(20))
def test_noise_about_a_constant_is_still_and_averages_out(seed: int) -> None:
    values = 0.3 + 1e-4 * np.random.default_rng(seed).standard_normal(100)
    found = still(values, 1e-7)
    assert found is not None
    assert found.sd == pytest.approx(1e-5, rel=0.35)
    assert abs(found.value - 0.3) < 5 * found.sd


def test_a_rounded_constant_keeps_the_bias_of_rounding() -> None:
    found = still(np.full(1000, 0.03), 1e-3)
    assert found is not None
    assert found.sd == pytest.approx(1e-3 / np.sqrt(12))


def test_a_drift_is_not_still() -> None:
    drift = np.round(np.linspace(0.0, 0.01, 200), 3)
    assert still(drift, 1e-3) is None
    noisy = 1e-4 * np.random.default_rng(1).standard_normal(200) + np.linspace(0.0, 2e-4, 200)
    assert still(noisy, 1e-6) is None


def test_a_few_samples_are_still_within_what_is_known_of_their_noise() -> None:
    values = np.array([0.0, 1e-4, -1e-4, 2e-4])
    assert still(values, 1e-6) is None
    assert still(values, 1e-6, noise=1e-4) is not None


@pytest.mark.parametrize("seed", range(30))
@pytest.mark.parametrize("count", [8, 12, 30, 300])
def test_noise_of_any_length_is_still(seed: int, count: int) -> None:
    assert still(np.random.default_rng(seed).standard_normal(count), 1e-6) is not None


def test_a_motion_is_not_still() -> None:
    assert still(0.01 * np.sin(np.linspace(0.0, 3.0, 40)), 1e-6) is None
