"""Sums and products that leave out zeros and ones, against NumPy's that don't."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.numeric import sparing
from thesis_pin.numeric.rotations import euler_parts, euler_placement

PARTS = st.sampled_from([0.0, 1.0, -0.7, np.array([0.0, 1.0, 0.4]), np.array([-2.0, 0.3, 1.0])])
VECTORS = st.tuples(PARTS, PARTS, PARTS)
COUNT = 3


def full(part):
    return part + np.zeros(COUNT)


@given(a=PARTS, b=PARTS)
def test_sums_and_products_are_numpys(a, b):
    np.testing.assert_array_equal(full(sparing.times(a, b)), full(a) * full(b))
    np.testing.assert_array_equal(full(sparing.plus(a, b)), full(a) + full(b))
    np.testing.assert_array_equal(full(sparing.minus(a, b)), full(a) - full(b))


@given(a=VECTORS, b=VECTORS)
def test_a_cross_product_is_numpys(a, b):
    found = sparing.spread(sparing.cross(a, b), (COUNT,))
    expected = np.cross([full(x) for x in a], [full(x) for x in b], axis=0)
    np.testing.assert_allclose(found, expected, atol=1e-15)


@given(angles=VECTORS, rates=VECTORS, seconds=VECTORS, axes=st.sampled_from(["xyz", "zxz", "yyx"]))
def test_constant_angles_turn_as_arrays_of_them_do(angles, rates, seconds, axes):
    turned = euler_parts(axes, angles, rates, seconds)
    whole = (np.stack([full(x) for x in part], axis=-1) for part in (angles, rates, seconds))
    for parts, expected in zip(turned, euler_placement(axes, *whole), strict=True):
        found = sparing.spread(parts, (COUNT,)).T
        np.testing.assert_allclose(found, expected.reshape(COUNT, -1), atol=1e-14)


def test_what_costs_nothing_stays_a_float():
    one, still = (0.0, 0.0, 0.3), (0.0, 0.0, 0.0)
    rotation, omega, alpha = euler_parts("xyz", one, still, still)
    assert all(isinstance(part, float) for part in (*rotation, *omega, *alpha))
    assert (omega, alpha) == ([0.0] * 3, [0.0] * 3)
