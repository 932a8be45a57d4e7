"""Strength that differs along a curve: rest, swing and jumps in one.

An expectation-maximisation: the prior's variance in each span is what draws from the
posterior show there, averaged over a few neighbours and a little drawn to the mean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.smoothing.basis import Array
from thesis_pin.smoothing.fit import Fit, Strength, strongest
from thesis_pin.smoothing.posterior import draws

STEPS = 4
"""Of the expectation-maximisation."""
_NEAR = 3  # spans on either side that count as the same place
_LOW, _HIGH = 1e-6, 30.0  # of the relative penalty; more would spoil the equations
_SPOILT = 4.0  # growth of the residuals after which a step is taken back
_GAUSS = np.array([0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)])


def localised(found: Strength, floor: float, noise: float, normal: Array) -> Strength:
    """The same fit with a strength of its own in each span.

    Args:
        found: The fit with one strength.
        floor: See :func:`~thesis_pin.smoothing.fit.strongest`.
        noise: See there.
        normal: See :func:`~thesis_pin.smoothing.posterior.draws`.
    """
    samples = found.fit.samples
    count = len(samples.values)
    allowance = count * floor**2 / 3.0  # (q/6)² a sample
    for _ in range(STEPS):
        weight = _weights(_energy(found, normal))
        fit = Fit(samples, found.fit.order, weight)
        tried = strongest(fit, floor, noise, found.log)
        before, after = found.solution.misfit, tried.solution.misfit
        if not np.isfinite(after) or after > _SPOILT * before + allowance:
            break
        found = tried
    return found


def _energy(found: Strength, normal: Array) -> Array:
    """Mean over draws of ∫(x⁽ᵐ⁾)² in each span, shape ``(spans,)``."""
    penalty = found.fit.penalty
    drawn = penalty.windows(draws(found, normal))
    high: NDArray[np.float64] = np.einsum("kj,kjd->kd", penalty.middle, drawn)
    return np.asarray((high**2).mean(axis=1))


def _weights(energy: Array) -> Array:
    """Relative penalties at Gauss's points, ``(spans, 3)``."""
    energy = np.maximum(energy, 1e-200)
    middle = float(np.exp(np.log(energy).mean()))
    window = np.ones(2 * _NEAR + 1)
    # In a curve shorter than the window "same" would have the window's length.
    total = np.convolve(energy, window)[_NEAR : _NEAR + len(energy)]
    count = np.convolve(np.ones(len(energy)), window)[_NEAR : _NEAR + len(energy)]
    local = (total + middle) / (count + 1)
    relative = np.clip(np.exp(np.log(local).mean()) / local, _LOW, _HIGH)
    spans = np.arange(len(energy))
    at = spans[:, None] + _GAUSS
    return np.asarray(np.exp(np.interp(at, spans + 0.5, np.log(relative))))
