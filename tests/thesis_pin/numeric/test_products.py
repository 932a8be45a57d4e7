"""The vector that goes furthest along some normals, in blocks."""

import numpy as np
import pytest

from thesis_pin.numeric import products
from thesis_pin.numeric.products import furthest


@pytest.mark.parametrize("count", [0, 1, 100, 1001])
def test_the_furthest_along_any_normal_is_the_largest_product(count, monkeypatch):
    monkeypatch.setattr(products, "ONE_THREAD", 300)
    rng = np.random.default_rng(1)
    vectors, normals = rng.normal(size=(count, 3)), rng.normal(size=(8, 3))
    expected = [max(float(n @ v) for n in normals) for v in vectors]
    np.testing.assert_allclose(furthest(vectors, normals), expected, atol=1e-14)


def test_one_normal_of_very_many_entries_still_gets_a_row_at_a_time(monkeypatch):
    monkeypatch.setattr(products, "ONE_THREAD", 2)
    assert furthest(np.eye(3), np.ones((1, 3))).tolist() == [1.0, 1.0, 1.0]
