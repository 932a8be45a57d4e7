"""Corners of a motion: found where a rate or a value changes in an instant, and only there."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from thesis_pin.smoothing.corners import corners, in_pieces, through
from thesis_pin.smoothing.curve import DRAWS, End, generator

RATES = [25, 60, 100, 300, 1000]


def swing(t):
    return 0.02 * np.sin(3.0 * t) + 0.01 * np.sin(7.0 * t)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("jump", [0.3, -1.0])
@pytest.mark.parametrize("quantum", [0.0, 1e-7])
def test_a_jump_of_rate_is_found_between_its_rows(rate, jump, quantum):
    t = np.arange(0.013 / 7, 2.0, 1.0 / rate)
    values = swing(t) + jump * np.maximum(t - 0.987, 0.0)
    if quantum:
        values = np.round(values / quantum) * quantum
    (row,) = corners(t, values, quantum)
    assert t[row] <= 0.987 <= t[row + 1]


def test_a_step_of_the_value_is_found():
    t = np.arange(0.0, 2.0, 0.001)
    values = swing(t) + 1.6e-5 * (t > 0.9995)
    (row,) = corners(t, values, 0.0)
    assert t[row] < 0.9995 < t[row + 1]


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("quantum", [0.0, 1e-7, 1e-5, 1e-3])
@pytest.mark.parametrize("noise", [0.0, 1e-5, 1e-4])
def test_smooth_motions_have_none_whatever_their_resolution(rate, quantum, noise):
    t = np.arange(0.0, 2.0, 1.0 / rate)
    u = np.clip(t - 0.5, 0.0, 1.0)
    rest_to_rest = 0.05 * (10 * u**3 - 15 * u**4 + 6 * u**5)
    jerky = np.where(t < 1.0, 0.0, (t - 1.0) ** 2)  # an acceleration that jumps
    for values in (swing(t), rest_to_rest, jerky):
        rough = values + noise * np.random.default_rng(rate).standard_normal(len(t))
        rough = np.round(rough / quantum) * quantum if quantum else rough
        assert corners(t, rough, quantum) == []


def test_exact_pieces_pass_through_every_sample_and_rest_where_they_are_held():
    t = np.linspace(0.0, 1.0, 40)
    values = 0.1 + t**2 * (3.0 - 2.0 * t)
    curve = through(t, values, (End(values[0], np.zeros(DRAWS)), None))
    assert np.array_equal(curve.value(t[:-1]), values[:-1])
    assert abs(curve.value(0.0, 1)) < 1e-15
    want = CubicSpline(t, values, bc_type=("clamped", "not-a-knot"))
    inside = np.linspace(0.0, 0.999, 200)
    np.testing.assert_allclose(curve.value(inside, 2), want(inside, 2), atol=1e-10)


@pytest.mark.parametrize("exact", [False, True])
def test_accelerations_beside_a_corner_are_the_motion_s(exact):
    t = np.arange(0.0, 2.0, 0.01)
    values = swing(t) + 0.3 * np.maximum(t - 0.987, 0.0)
    pieces, ((row, size),) = in_pieces(t, values, 1e-12, generator(7), exact=exact)
    assert size == pytest.approx(0.3, rel=0.1)  # and what the motion's own rate makes of 10 ms
    true = -0.02 * 9.0 * np.sin(3.0 * t) - 0.01 * 49.0 * np.sin(7.0 * t)
    for piece, rows in ((pieces[0], t <= t[row]), (pieces[-1], t > t[row])):
        np.testing.assert_allclose(piece.value(t[rows], 2), true[rows], atol=0.02)


@pytest.mark.parametrize("noise", [1e-6, 1e-5, 1e-4])
@pytest.mark.parametrize("seed", range(6))
def test_what_only_looks_like_a_corner_is_none(noise, seed, monkeypatch):
    """Of thousands of noisy samples some do; the curves on both sides don't tell any jump."""
    random = np.random.default_rng(seed)
    t = np.arange(0.0, 4.0, 1.0 / 300)
    values = np.round(swing(t) + noise * random.standard_normal(len(t)), 7)
    looks = sorted(random.choice(np.arange(40, len(t) - 40), 3, replace=False).tolist())
    monkeypatch.setattr("thesis_pin.smoothing.corners.corners", lambda *_: looks)
    pieces, jumps = in_pieces(t, values, 1e-7, generator(9, seed))
    assert (len(pieces), jumps) == (1, [])
    assert np.sqrt(np.mean((pieces[0].value(t) - swing(t)) ** 2)) < noise / 2


@pytest.mark.parametrize("seed", range(5))
def test_a_jump_above_the_noise_is_told_with_its_size(seed):
    t = np.arange(0.001, 3.0, 1.0 / 300)
    values = swing(t) + 0.3 * np.maximum(t - 1.4, 0.0)
    values += 1e-6 * np.random.default_rng(seed).standard_normal(len(t))
    pieces, ((row, size),) = in_pieces(t, np.round(values, 7), 1e-7, generator(9, seed))
    assert t[row] <= 1.4 <= t[row + 1]
    assert size == pytest.approx(0.3, abs=0.02)
    assert len(pieces) == 3
