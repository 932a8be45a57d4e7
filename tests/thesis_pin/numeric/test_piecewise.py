"""Piecewise polynomials against SciPy's."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import PPoly

from thesis_pin.numeric.piecewise import Piecewise, jet

SHAPES = st.sampled_from([(), (3,), (2, 2)])


def made(seed, order, pieces, shape=()):
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.01, 2, pieces + 1)) - 3
    c = rng.normal(size=(order, pieces, *shape)) * 10.0 ** rng.integers(
        -5, 5, (order, pieces, *shape)
    )
    c[rng.random(c.shape) < 0.2] = -0.0
    around = rng.uniform(x[0] - 1, x[-1] + 1, 40)
    return c, x, np.concatenate([around, x, [np.nan, -0.0]])


@given(
    seed=st.integers(0, 2**32 - 1), order=st.integers(1, 7), pieces=st.integers(1, 6), shape=SHAPES
)
@settings(max_examples=100, deadline=None)
def test_values_and_derivatives_are_scipys_to_the_bit(seed, order, pieces, shape):
    c, x, t = made(seed, order, pieces, shape)
    ours, scipys = Piecewise(c, x), PPoly(c, x)
    for nu in range(4):
        assert ours(t, nu).tobytes() == scipys(t, nu).tobytes()
        assert ours(t.reshape(-1, 1), nu).shape == scipys(t.reshape(-1, 1), nu).shape
        assert ours(x[0], nu).shape == scipys(x[0], nu).shape
    for nu in (1, 2):
        np.testing.assert_array_equal(ours.derivative(nu).c, scipys.derivative(nu).c)


def test_what_else_a_ppoly_has_is_there():
    c, x, _ = made(1, 4, 3)
    ours, scipys = Piecewise(c, x), PPoly(c, x)
    np.testing.assert_array_equal(ours.roots(), scipys.roots())
    assert ours.integrate(x[0], x[-1]) == scipys.integrate(x[0], x[-1])
    assert isinstance(ours.ppoly, PPoly)
    with pytest.raises(AttributeError, match="nonsense"):
        ours.nonsense  # noqa: B018


def test_copies_and_pickles_are_the_same_curve():
    c, x, t = made(2, 3, 4)
    curve = Piecewise(c, x)
    for again in (copy.deepcopy(curve), pickle.loads(pickle.dumps(curve))):
        np.testing.assert_array_equal(again(t), curve(t))


def test_curves_through_nodes_need_no_scipy():
    code = (
        "import sys\n"
        "from thesis_pin.numeric.interpolation import interpolate\n"
        "for method in ('linear', 'quadratic', 'cubic', 'quintic'):\n"
        "    interpolate([0, 1, 2.5, 3], [0, 1, 0, 2], method)([0.5], 1)\n"
        "print('scipy' in sys.modules)\n"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout == "False\n"


@given(
    seed=st.integers(0, 2**32 - 1),
    order=st.integers(1, 7),
    pieces=st.integers(1, 6),
    count=st.sampled_from([1, 2, 40, 500]),
    ordered=st.booleans(),
)
@settings(max_examples=100, deadline=None)
def test_a_jet_is_scipys_value_rate_and_acceleration(seed, order, pieces, count, ordered):
    """One sample, some, and so many that it goes from piece to piece."""
    c, x, _ = made(seed, order, pieces)
    t = np.random.default_rng(seed).uniform(x[0] - 1, x[-1] + 1, count)
    t[: len(x)] = x[:count]  # the piece on the right holds at a knot
    t = np.sort(t) if ordered else t
    scipys = PPoly(c, x)
    for curve in (Piecewise(c, x), scipys):
        for nu, found in enumerate(jet(curve, t)):
            # Each sum is as exact as the largest of its terms.
            size = PPoly(np.abs(c), x)(x[:-1] + 3.0, nu).max() + 1e-300
            np.testing.assert_allclose(
                found + np.zeros(count), scipys(t, nu), rtol=1e-9, atol=1e-9 * size
            )


def test_a_jet_that_is_the_same_everywhere_is_a_float():
    t = np.linspace(0.0, 2.0, 200)
    assert jet(Piecewise([[0.3]], [0.0, 1.0]), t) == (0.3, 0.0, 0.0)
    value, rate, second = jet(Piecewise([[1.0, 1.0], [0.0, 1.0]], [0.0, 1.0, 2.0]), t)
    np.testing.assert_allclose(value, t, atol=1e-15)
    assert (rate, second) == (1.0, 0.0)
