"""Curves that repeat themselves."""

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from scout_pin.study.plan.cycles.splines import KNOTS, Cyclic
from scout_pin.study.plan.way import BEHIND, Way

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
    curves = cyclic.curves(coefficients, TIME, Way(0.0, LENGTH, 0.0))
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
    curves = cyclic.curves(coefficients, 1.0, Way(0.0, 0.0, 0.0))
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


def test_curves_that_turn_are_those_of_the_frame_that_goes_round(rng):
    """As smooth as walks are: between new knots within a micrometre and a microradian."""
    from scipy.spatial.transform import Rotation

    way, cyclic = Way(0.01, 0.03, 0.2), Cyclic(2)
    at = np.arange(2 * KNOTS) / KNOTS
    waves = [np.sin(np.pi * n * at + phase) for n, phase in ((1, 0.3), (2, 1.0), (3, 2.0))]
    coefficients = rng.normal(size=(6, 3)) / [1, 4, 9] @ waves
    coefficients *= np.array([[0.04], [0.02], [0.02], [0.2], [0.2], [0.2]])
    straight = cyclic.curves(coefficients, TIME, Way(0.0, 0.0, 0.0))
    curves = cyclic.curves(coefficients, TIME, way)
    u = np.concatenate([np.arange(17) / KNOTS, rng.uniform(0.0, 2.0, 60)])
    local, world = (np.stack([one(TIME * u) for one in six], axis=1) for six in (straight, curves))
    # x + iy goes round on the arc ∫ exp(i turn u) (aside + i ahead) du.
    turn, along = way.turn, way.aside + 1j * way.ahead
    place = along * (np.exp(1j * turn * u) - 1) / (1j * turn)
    place = place + np.exp(1j * turn * u) * (local[:, 0] + 1j * local[:, 1])
    np.testing.assert_allclose(world[:, 0] + 1j * world[:, 1], place, atol=1e-6)
    np.testing.assert_allclose(world[:, 2], local[:, 2], atol=1e-6)
    expected = Rotation.from_euler("z", turn * (u - BEHIND)[:, None]) * Rotation.from_euler(
        "XYZ", local[:, 3:]
    )
    off = expected.inv() * Rotation.from_euler("XYZ", world[:, 3:])
    assert off.magnitude().max() < 1e-6
