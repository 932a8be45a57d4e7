"""Worst cases against all signs tried, and against what can be said without trying."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pollard_pin.study.accuracy.extremes import farthest, root_of_squares, sums


def of_all_signs(vectors):
    """The farthest of all 2^k corners."""
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=vectors.shape[1])))
    return np.linalg.norm(signs @ vectors.T, axis=1).max()


@pytest.mark.parametrize("seed", range(40))
def test_no_choice_of_signs_leads_farther(seed):
    rng = np.random.default_rng(seed)
    vectors = rng.normal(size=(3, 12)) * 10.0 ** rng.uniform(-2, 0, 12)
    size, signs = farthest(vectors[None])
    assert size[0] == pytest.approx(of_all_signs(vectors), rel=1e-12)
    assert size[0] == pytest.approx(np.linalg.norm(vectors @ signs[0]), rel=1e-12)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("shape", [(1, 1, 1), (1, 0.2, 0.05), (1, 0.1, 0), (1, 1, 0)])
def test_no_direction_leads_farther_where_many_vectors_nearly_share_a_line(seed, shape):
    """Local maxima abound there; 40 000 directions, as seen by the vectors, find no better one."""
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    vectors = turn @ (np.array(shape)[:, None] * rng.normal(size=(3, 56)))
    size, _ = farthest(vectors[None])
    stretch = 1.0 / np.maximum(shape, 1e-3)
    directions = (rng.normal(size=(40_000, 3)) * stretch) @ turn.T
    corners = np.where(directions @ vectors < 0.0, -1.0, 1.0) @ vectors.T
    assert np.linalg.norm(corners, axis=1).max() <= size[0] * (1 + 1e-9)


@settings(deadline=None)
@given(st.lists(st.tuples(*[st.floats(-1, 1)] * 3), min_size=1, max_size=8))
def test_it_lies_between_root_of_squares_and_sums(rows):
    vectors = np.array(rows).T[None]
    size, _ = farthest(vectors)
    assert root_of_squares(vectors)[0] <= size[0] * (1 + 1e-9) + 1e-12
    assert size[0] <= np.linalg.norm(sums(vectors)[0]) * (1 + 1e-9) + 1e-12
    assert size[0] >= sums(vectors).max() * (1 - 1e-9) - 1e-12


def test_vectors_along_one_line_add_up():
    line = np.outer([1.0, 2.0, -2.0], [0.5, -1.0, 0.25])
    assert farthest(line[None])[0][0] == pytest.approx(3 * 1.75)


def test_nothing_reaches_nowhere():
    size, signs = farthest(np.zeros((2, 3, 4)))
    assert not size.any()
    assert signs.shape == (2, 4)
