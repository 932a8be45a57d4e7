"""What is orthogonal to some rows: null spaces without a full singular value decomposition."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def complement(rows: Array) -> Array:
    """Orthonormal columns orthogonal to orthonormal rows.

    A full SVD gives the same at many times the cost where there are few rows, and much
    more where BLAS threads wait for one another.

    Args:
        rows: Orthonormal, shape ``(..., k, n)``.

    Returns:
        Shape ``(..., n, n − k)``.
    """
    count, size = rows.shape[-2:]
    if not count:
        return np.broadcast_to(np.eye(size), (*rows.shape[:-2], size, size)).copy()
    basis: Array = np.linalg.qr(np.swapaxes(rows, -1, -2), mode="complete")[0]
    return basis[..., count:]
