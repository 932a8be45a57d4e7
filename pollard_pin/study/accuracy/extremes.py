"""What many small errors come to: at worst, and by the root of their squares.

Errors that are independent and small add up as vectors: δx = J δp with |δp_k| ≤ t_k. What δx can be
is a zonotope, and its farthest corner has δp_k = t_k sign(n · J_k) for the direction n in which it
lies.
"""

from __future__ import annotations

import itertools

import numpy as np

_TURNS = 12

_FARTHER = 1.0 + 1e-12


def _directions() -> np.ndarray:
    """From the centre of a cube to its faces, edges and corners, one of each pair, ``(13, 3)``."""
    every = [one for one in itertools.product((-1, 0, 1), repeat=3) if one > (0, 0, 0)]
    found = np.array(every, dtype=float)
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


DIRECTIONS = _directions()


def farthest(vectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The farthest point that vectors reach with a sign each.

    From each of thirteen directions it is gone to the corner that lies farthest along it, and on
    along the direction of that corner, until it stays; each step leads farther.

    Args:
        vectors: Shape ``(n, 3, k)``.

    Returns:
        Its distance ``(n,)``, and the signs ``(n, k)``. Never more than the length of
        :func:`sums`.
    """
    count = len(vectors)
    along = np.broadcast_to(DIRECTIONS, (count, *DIRECTIONS.shape))
    best, signs = np.full(count, -1.0), np.ones((count, vectors.shape[2]))
    for _ in range(_TURNS):
        tried = np.where(along @ vectors < 0.0, -1.0, 1.0)
        corners = tried @ vectors.swapaxes(1, 2)
        size = np.sqrt((corners * corners).sum(axis=-1))
        pick = size.argmax(axis=1)
        rows = np.arange(count)
        farther = size[rows, pick] > best * _FARTHER
        if not farther.any():
            break
        best = np.where(farther, size[rows, pick], best)
        signs = np.where(farther[:, None], tried[rows, pick], signs)
        along = corners / np.where(size > 0.0, size, 1.0)[..., None]
    return best, signs


def sums(vectors: np.ndarray) -> np.ndarray:
    """Largest size of each component, the sum of what each vector has of it: ``(n, 3)``."""
    return np.asarray(np.abs(vectors).sum(axis=-1))


def root_of_squares(vectors: np.ndarray) -> np.ndarray:
    """Root of the sum of the squares of lengths, shape ``(n,)``."""
    return np.asarray(np.sqrt((vectors * vectors).sum(axis=(1, 2))))
