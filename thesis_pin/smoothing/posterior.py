"""Draws from what a fit leaves open."""

from __future__ import annotations

import numpy as np

from thesis_pin.smoothing.basis import Array
from thesis_pin.smoothing.fit import Strength


def draws(found: Strength, normal: Array, ends: Array | None = None) -> Array:
    """Coefficients of curves as probable as the data leave them.

    Args:
        found: The fit with its strength.
        normal: Standard normal variables, at least as many as coefficients,
            shape ``(at least count, draws)``.
        ends: By how much each draw's fixed first and last value differ from the
            fit's, shape ``(2, draws)``; None is zero.

    Returns:
        Coefficients, shape ``(count, draws)``.
    """
    from scipy.linalg import lapack

    fit, solution = found.fit, found.solution
    samples, free = fit.samples, fit.samples.free
    count = free.stop - free.start
    spread, _ = lapack.dtbtrs(solution.factor, normal[:count], uplo="L", trans="T")
    result = np.repeat(solution.coefficients[:, None], normal.shape[1], axis=1)
    result[free] += found.sigma * spread
    if ends is None:
        return result
    ratio = float(np.exp(found.log))
    for end, wrong in enumerate(ends):
        if samples.fixed[end] is None or not wrong.any():
            continue
        # The fit is linear in its fixed values: one more right-hand side says how it follows.
        unit = samples.with_ends(1.0 - end, float(end))
        pulled = samples.rows.moments(samples.weight * samples.rows(unit))
        pulled += ratio * fit.penalty.times(unit, fit.weight)
        follow, _ = lapack.dpbtrs(solution.factor, -pulled[free], lower=1)
        unit[free] += follow
        result += unit[:, None] * wrong
    return result
