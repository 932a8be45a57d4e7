"""Curves that repeat themselves."""

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from scout_pin.study.plan.cycles.splines import KNOTS, Cyclic

SIGNS = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
TIME, LENGTH = 0.7, 0.04


@pytest.fixture(params=[1, 2])
def cyclic(request):
    return Cyclic(request.param)


def jets(cyclic, coefficients, u):
    return np.einsum("ndck,ck->ndc", cyclic.basis(u), coefficients)


def test_half_a_cycle_says_all_and_its_mirror_image_follows(rng):
    cyclic = Cyclic(1)
    coefficients = rng.normal(size=(6, KNOTS))
    u = rng.uniform(0.0, 1.0, 50)
    first, second = jets(cyclic, coefficients, u), jets(cyclic, coefficients, u + 1.0)
    np.testing.assert_allclose(second, SIGNS * first, atol=1e-10)
    np.testing.assert_allclose(jets(cyclic, coefficients, u + 2.0), first, atol=1e-10)
    whole = jets(Cyclic(2), cyclic.spread(coefficients), u + 1.0)
    np.testing.assert_allclose(whole, second, atol=1e-10)


def test_a_whole_cycle_comes_back_after_two_steps(rng):
    cyclic = Cyclic(2)
    coefficients = rng.normal(size=(6, 2 * KNOTS))
    u = rng.uniform(0.0, 2.0, 50)
    here = jets(cyclic, coefficients, u)
    np.testing.assert_allclose(jets(cyclic, coefficients, u + 2.0), here, atol=1e-9)
    assert np.abs(jets(cyclic, coefficients, u + 1.0) - here).max() > 0.1


def test_curves_are_the_quintic_splines_that_scipy_makes(cyclic, rng):
    wanted = rng.normal(size=(cyclic.size, 6))
    coefficients = cyclic.fitted(wanted)
    if cyclic.steps == 1:
        wanted = np.concatenate([wanted, SIGNS * wanted])
    at = TIME * np.arange(2 * KNOTS + 1) / KNOTS
    curves = cyclic.curves(coefficients, TIME, LENGTH)
    t = rng.uniform(0.0, 2 * TIME, 60)
    for k, curve in enumerate(curves):
        values = np.append(wanted[:, k], wanted[0, k])
        expected = make_interp_spline(at, values, 5, bc_type="periodic")
        for order, size in ((0, 1.0), (1, 1e2), (2, 1e4)):
            forward = {0: LENGTH / TIME * t, 1: LENGTH / TIME}.get(order, 0.0) if k == 1 else 0.0
            found = curve(t, order)
            np.testing.assert_allclose(found, expected(t, order) + forward, atol=1e-10 * size)


def test_values_of_the_basis_are_the_curves(cyclic, rng):
    coefficients = rng.normal(size=(6, cyclic.size))
    curves = cyclic.curves(coefficients, 1.0, 0.0)
    u = rng.uniform(0.0, 2.0, 40)
    found = jets(cyclic, coefficients, u)
    for order in range(3):
        expected = np.stack([curve(u, order) for curve in curves], axis=1)
        np.testing.assert_allclose(found[:, order], expected, atol=1e-9)


def test_coefficients_bound_the_curves(cyclic, rng):
    coefficients = rng.normal(size=(6, cyclic.size))
    values = jets(cyclic, coefficients, np.linspace(0.0, 2.0, 400))[:, 0]
    assert (values.max(axis=0) <= cyclic.spread(coefficients).max(axis=1) + 1e-12).all()
    assert (values.min(axis=0) >= cyclic.spread(coefficients).min(axis=1) - 1e-12).all()
