"""Curves between rest and a jet: both ends to the last digits, held against SciPy's derivatives."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from scout_pin.study.plan.walks.clamped import Clamped

numbers = some.floats(-3.0, 3.0)


@settings(max_examples=30, deadline=None)
@given(
    some.integers(4, 14),
    some.floats(0.2, 5.0),
    some.lists(numbers, min_size=18, max_size=18),
    some.booleans(),
    some.integers(0, 10_000),
)
def test_one_end_rests_and_the_other_has_the_jet(intervals, duration, jet, first, seed):
    jet = np.reshape(jet, (6, 3))
    clamped = Clamped(duration, intervals, jet, first)
    free = np.random.default_rng(seed).normal(size=(intervals, 6))
    rest, join = (0.0, duration) if first else (duration, 0.0)
    for k, curve in enumerate(clamped.curves(free)):
        place = free[0 if first else -1, k]
        # At the end of the last piece, where rounding grows with the rates between knots.
        step = duration / intervals
        for order, scale in enumerate((1.0, 1 / step, 1 / step**2)):
            want = place if order == 0 else 0.0
            assert curve(rest, order) == pytest.approx(want, abs=1e-10 * scale)
            assert curve(join, order) == pytest.approx(jet[k, order], abs=1e-10 * scale)


@pytest.mark.parametrize("first", [True, False])
def test_jets_are_those_of_the_curves(first):
    rng = np.random.default_rng(1)
    clamped = Clamped(0.9, 9, rng.normal(size=(6, 3)), first)
    free, t = rng.normal(size=(9, 6)), np.linspace(0.0, 0.9, 37)
    matrix, jets = clamped.maps(t)
    jets = jets + (matrix @ free).transpose(1, 0, 2).reshape(len(t), 18)
    for k, curve in enumerate(clamped.curves(free)):
        for order in range(3):
            np.testing.assert_allclose(jets[:, 6 * order + k], curve(t, order), atol=1e-9)


def test_curves_are_smooth_to_the_fourth_derivative():
    rng = np.random.default_rng(2)
    clamped = Clamped(1.0, 8, rng.normal(size=(6, 3)), True)
    for curve in clamped.curves(rng.normal(size=(8, 6))):
        before = np.nextafter(curve.x[1:-1], 0.0)
        for order in range(5):
            jump = np.abs(curve(before, order) - curve(curve.x[1:-1], order))
            assert jump.max() < 1e-9 * np.abs(curve(before, order)).max()


def test_what_a_curve_can_be_is_fitted_to_the_last_digits():
    rng = np.random.default_rng(3)
    clamped = Clamped(0.7, 8, rng.normal(size=(6, 3)), False)
    free, t = rng.normal(size=(8, 6)), np.linspace(0.0, 0.7, 50)
    wanted = np.stack([curve(t) for curve in clamped.curves(free)], axis=1)
    np.testing.assert_allclose(clamped.fitted(t, wanted), free, atol=1e-10)
