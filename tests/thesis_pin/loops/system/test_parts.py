"""Decompositions part by part against those of whole matrices."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.loops.system.parts import Parts, inverted


@st.composite
def stacks(draw):
    """A pattern of a few parts in any order, and matrices of it."""
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    sizes = draw(st.lists(st.tuples(st.integers(1, 4), st.integers(1, 4)), min_size=1, max_size=4))
    idle = draw(st.integers(0, 2))
    touches = np.zeros((sum(r for r, _ in sizes), sum(c for _, c in sizes) + idle), dtype=bool)
    row = column = 0
    for rows, columns in sizes:
        touches[row : row + rows, column : column + columns] = True
        row, column = row + rows, column + columns
    touches = touches[random.permutation(row)][:, random.permutation(touches.shape[1])]
    return touches, random.normal(size=(3, *touches.shape)) * touches


@settings(deadline=None, max_examples=50)
@given(stacks())
def test_singular_values_are_those_of_the_whole_matrices(stack):
    touches, matrices = stack
    parts, whole = Parts(touches), np.linalg.svd(matrices, compute_uv=False)
    np.testing.assert_allclose(parts.values(matrices), whole, atol=1e-13)
    left, values, right = parts.svd(matrices)
    np.testing.assert_allclose(values, whole[:, : parts.most], atol=1e-13)
    np.testing.assert_allclose(left * values[:, None] @ right, matrices, atol=1e-13)
    assert (np.diff(values, axis=1) <= 0).all()


@settings(deadline=None, max_examples=50)
@given(stacks(), st.sampled_from([0.0, 0.3, 1.0]), st.sampled_from([None, 1, 3]))
def test_pseudo_inverses_are_those_of_the_whole_truncated_matrices(stack, cut, rank):
    touches, matrices = stack
    found, counts = Parts(touches).pseudo_inverses(matrices, max(cut, 1e-9), rank)
    for matrix, inverse, count in zip(matrices, found, counts, strict=True):
        left, values, right = np.linalg.svd(matrix, full_matrices=False)
        strong = values > max(cut, 1e-9)
        if rank is not None:
            strong[rank:] = False
        expected = (right[strong].T / values[strong]) @ left[:, strong].T
        np.testing.assert_allclose(
            inverse, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max(initial=0)
        )
        assert count == strong.sum()


@settings(deadline=None, max_examples=50)
@given(stacks(), st.integers(0, 3))
def test_complements_are_orthogonal_to_what_was_kept_and_complete_it(stack, most):
    touches, matrices = stack
    parts = Parts(touches)
    rows = parts.svd(matrices[0])[2][: min(most, parts.most)]
    found = parts.complement(rows)
    basis = np.concatenate([rows.T, found], axis=1)
    np.testing.assert_allclose(basis @ basis.T, np.eye(touches.shape[1]), atol=1e-12)


@pytest.mark.parametrize("shape", [(3, 5), (5, 3), (4, 4)])
def test_inverses_of_full_rank_are_pinv_and_know_how_weak_they_are(shape):
    matrices = np.random.default_rng(0).normal(size=(6, *shape))
    matrices[5, :, 0] = matrices[5, :, 1]
    matrices[5, 0] = matrices[5, 1]
    found = inverted(matrices)
    np.testing.assert_allclose(found.pseudo[:5], np.linalg.pinv(matrices[:5]), atol=1e-12)
    least = np.linalg.svd(matrices, compute_uv=False)[:, -1]
    assert (found.weakest <= least + 1e-12).all()
    assert (found.weakest[:5] * np.sqrt(min(shape)) >= least[:5] - 1e-12).all()
    assert found.weakest[5] < 1e-12
