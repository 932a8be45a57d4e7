"""Products with components first, against NumPy's with components last."""

import numpy as np
import pytest

from thesis_pin.numeric.rotations import rotation
from thesis_pin.numeric.vectors import cross, dot, into, rows


@pytest.mark.parametrize("shape", [(3,), (3, 7), (3, 2, 7)])
def test_products_are_numpys_for_one_vector_and_for_stacks(shape):
    rng = np.random.default_rng(5)
    a, b = rng.normal(size=(2, *shape))
    np.testing.assert_allclose(cross(a, b), np.cross(a, b, axis=0), atol=1e-15)
    np.testing.assert_allclose(dot(a, b), (a * b).sum(axis=0), atol=1e-15)


def test_a_vector_broadcasts_over_the_axes_before_the_samples():
    rng = np.random.default_rng(6)
    a, b = rng.normal(size=(3, 1, 7)), rng.normal(size=(3, 4, 7))
    np.testing.assert_allclose(cross(a, b)[:, 2], np.cross(a[:, 0], b[:, 2], axis=0), atol=1e-15)


def test_components_in_a_frame_are_the_transposed_rotations():
    rng = np.random.default_rng(7)
    turn = rotation("x", rng.normal(size=9)) @ rotation("z", rng.normal(size=9))
    vectors = rng.normal(size=(9, 3))
    expected = np.einsum("nji,nj->ni", turn, vectors)
    np.testing.assert_allclose(into(rows(turn), rows(vectors)).T, expected, atol=1e-15)
    product = into(rows(turn), rows(turn))
    np.testing.assert_allclose(product, np.eye(3)[..., None] + np.zeros(9), atol=1e-15)
    assert rows(turn).flags.c_contiguous
