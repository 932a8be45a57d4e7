"""Least squares with weights that aren't negative, for few rows: no SciPy to import."""

from __future__ import annotations

import numpy as np


def nonnegative(matrix: np.ndarray, target: np.ndarray) -> tuple[np.ndarray, float]:
    """The weights x ≥ 0 with the least ‖matrix x − target‖, and that length.

    Args:
        matrix: Shape ``(m, k)``.
        target: Shape ``(m,)``.

    Returns:
        Weights ``(k,)``, at most m of them not zero, and the length of what is missing.

    Source: C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, chapter 23 (NNLS).
    """
    rows, count = matrix.shape
    size = float(np.abs(matrix).sum(axis=0).max()) * float(np.abs(target).max())
    tiny = 10 * max(rows, count) * np.finfo(float).eps * size
    weights = np.zeros(count)
    used, barred = np.zeros((2, count), dtype=bool)
    gradient = matrix.T @ target
    for _ in range(3 * count):  # each turn lessens what is missing; SciPy's bound
        open_ones = np.where(used | barred, -np.inf, gradient)
        best = int(np.argmax(open_ones))
        if open_ones[best] <= tiny:
            break
        used[best] = True
        while True:
            some = np.flatnonzero(used)
            found = np.linalg.lstsq(matrix[:, some], target, rcond=None)[0]
            if found.min() > 0:
                break
            # Go towards it until the first weight is zero, and leave that one out.
            falling = np.flatnonzero(found <= 0)
            way = weights[some[falling]] - found[falling]
            ratio = weights[some[falling]] / np.where(way > 0, way, 1.0)
            weights[some] += ratio.min() * (found - weights[some])
            used[some[falling[ratio == ratio.min()]]] = False
            weights = np.where(used, np.maximum(weights, 0.0), 0.0)
            if not used[best]:
                break
        barred[best] = not used[best]  # by rounding it lessens nothing; others may
        if not used[best]:
            continue
        barred[:] = False
        weights = np.zeros(count)
        weights[some] = found
        gradient = matrix.T @ (target - matrix @ weights)
    missing = target - matrix @ weights
    return weights, float(np.sqrt(missing @ missing))
