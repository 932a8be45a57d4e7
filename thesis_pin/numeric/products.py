"""Products of tall matrices, in blocks that BLAS doesn't share among threads."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.numeric.elementwise import blocks

ONE_THREAD = 2**18
"""Multiplications of a matrix product that OpenBLAS leaves to one thread: shared out to two on a
busy machine, one of twice as many takes a hundred times as long."""


def furthest(vectors: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far vectors go along that of some normals along which they go furthest.

    Args:
        vectors: Shape ``(n, d)``.
        normals: Shape ``(m, d)``, m ≥ 1.

    Returns:
        Shape ``(n,)``.
    """
    most = np.empty(len(vectors))
    # Threads of a larger product wait for each other: where another program has a core, that takes
    # ten times as long.
    for part in blocks(len(vectors), max(1, ONE_THREAD // normals.size)):
        most[part] = (vectors[part] @ normals.T).max(axis=-1)
    return most
