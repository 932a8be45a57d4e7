"""Polygons of standing soles: each sample has that of its own stance."""

import numpy as np
import pytest

from thesis_pin.contacts.feet import support_polygons
from thesis_pin.numeric.elementwise import BLOCK
from thesis_pin.numeric.trajectory import BodyMotion

OUTLINE = np.array([[-1.0, -2.0], [1.0, -2.0], [1.0, 2.0], [-1.0, 2.0]]) / 100


@pytest.mark.parametrize("each", [7, BLOCK - 5, 2 * BLOCK])
def test_each_stance_has_its_own_polygon_in_however_many_blocks_it_lies(each):
    """A foot that steps on after so many samples, and comes back to its first place."""
    steps = np.repeat([0.0, 0.3, 0.1, 0.0], each)
    zero = np.zeros((len(steps), 3))
    place = np.column_stack([steps, zero[:, 0], zero[:, 0]])
    turn = np.broadcast_to(np.eye(3), (len(steps), 3, 3))
    foot = BodyMotion(turn, place, zero, zero, zero, zero)
    found = support_polygons(np.ones((len(steps), 1), dtype=bool), [foot], [OUTLINE])
    assert len(found) == 3
    seen = np.concatenate([samples for samples, _ in found])
    np.testing.assert_array_equal(np.sort(seen), np.arange(len(steps)))
    for samples, corners in found:
        middle = corners.mean(axis=0)
        np.testing.assert_allclose(middle[1], 0.0, atol=1e-15)
        np.testing.assert_allclose(steps[samples], middle[0], atol=1e-12)
