"""What many small errors come to: at worst, and by the root of their squares.

Errors that are independent and small add up as vectors: δx = J δp with |δp_k| ≤ t_k. What δx can be
is a zonotope, and its farthest corner has δp_k = t_k sign(n · J_k) for the direction n in which it
lies.
"""

from __future__ import annotations

import numpy as np

_TRIED, _KEPT = 96, 12
"""Directions from which the farthest corner is looked for, and those that are followed."""

_TURNS = 12

_FARTHER = 1.0 + 1e-12

_THIN = 1e-8
"""Square of the ratio at which what is across a line is nothing."""


def _directions() -> np.ndarray:
    """Directions spread evenly over half a sphere, ``(_TRIED, 3)``: opposites are alike."""
    golden = np.pi * (3.0 - np.sqrt(5.0))
    height = (np.arange(_TRIED) + 0.5) / _TRIED
    around, out = golden * np.arange(_TRIED), np.sqrt(1.0 - height * height)
    return np.stack([out * np.cos(around), out * np.sin(around), height], axis=1)


_DIRECTIONS = np.concatenate([np.eye(3), _directions()])


def farthest(vectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The farthest point that vectors reach with a sign each.

    From 195 directions, the axes among them, it is gone to the corner that lies farthest along
    each. From the best it is gone on along the direction of the corner, until it stays; each step
    leads farther.

    Args:
        vectors: Shape ``(n, 3, k)``.

    Returns:
        Its distance ``(n,)``, and the signs ``(n, k)``. Never more than the length of
        :func:`sums`.
    """
    count, rows = len(vectors), np.arange(len(vectors))
    best, signs = np.full(count, -1.0), np.ones((count, vectors.shape[2]))
    along = _starts(vectors)
    for turn in range(_TURNS):
        tried = np.where(along @ vectors < 0.0, -1.0, 1.0)
        corners = tried @ vectors.swapaxes(1, 2)
        size = np.sqrt((corners * corners).sum(axis=-1))
        pick = size.argmax(axis=1)
        farther = size[rows, pick] > best * _FARTHER
        if not farther.any():
            break
        best = np.where(farther, size[rows, pick], best)
        signs = np.where(farther[:, None], tried[rows, pick], signs)
        along = corners / np.where(size > 0.0, size, 1.0)[..., None]
        if turn == 0:
            kept = np.argpartition(-size, _KEPT, axis=1)[:, :_KEPT, None]
            along = np.take_along_axis(along, kept, axis=1)
    return _flipped(vectors, best, signs)


def _flipped(
    vectors: np.ndarray, best: np.ndarray, signs: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The same, one sign after the other turned round while that leads farther."""
    rows = np.arange(len(vectors))
    for _ in range(_TURNS):
        corner = (vectors @ signs[..., None])[..., 0]
        turned = corner[..., None] - 2.0 * signs[:, None, :] * vectors
        size = np.sqrt((turned * turned).sum(axis=1))
        pick = size.argmax(axis=1)
        farther = size[rows, pick] > best * _FARTHER
        if not farther.any():
            break
        best = np.where(farther, size[rows, pick], best)
        signs[rows[farther], pick[farther]] *= -1.0
    return best, signs


def _starts(vectors: np.ndarray) -> np.ndarray:
    """Directions from which to look, ``(n, 195, 3)``: evenly spread, and as seen by the vectors.

    Where vectors nearly share a line, what is across it decides among corners that lie alike along
    it; scaled to be as long either way, they are met evenly.
    """
    values, axes = np.linalg.eigh(vectors @ vectors.swapaxes(1, 2))
    least = np.maximum(values[:, -1:] * _THIN, np.finfo(float).tiny)
    scaled = axes / np.sqrt(np.maximum(values, least))[:, None, :] @ axes.swapaxes(1, 2)
    seen = _DIRECTIONS[3:] @ scaled
    plain = np.broadcast_to(_DIRECTIONS, (len(vectors), *_DIRECTIONS.shape))
    return np.concatenate([plain, seen], axis=1)


def sums(vectors: np.ndarray) -> np.ndarray:
    """Largest size of each component, the sum of what each vector has of it: ``(n, 3)``."""
    return np.asarray(np.abs(vectors).sum(axis=-1))


def root_of_squares(vectors: np.ndarray) -> np.ndarray:
    """Root of the sum of the squares of lengths, shape ``(n,)``."""
    return np.asarray(np.sqrt((vectors * vectors).sum(axis=(1, 2))))
