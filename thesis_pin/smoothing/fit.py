"""Bayesian smoothing splines: strength and noise of one curve by marginal likelihood.

Samples yᵢ = x(tᵢ) + eᵢ with var eᵢ = σ²Lᵢ, where Lᵢ is the length of the run of equal values
around i (a staircase's errors aren't independent), and a prior under which the m-th
derivative of x is white noise. Rounding to a quantum q is noise of at least q/√12: that one
bound is what keeps a curve from following the staircase.

Source: G. Wahba, "Bayesian confidence intervals for the cross-validated smoothing spline",
J. R. Stat. Soc. B 45 (1983); R. Kohn and C. F. Ansley, "A new algorithm for spline
smoothing based on smoothing a stochastic process", SIAM J. Sci. Stat. Comput. 8 (1987).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.smoothing.basis import Array, Penalty, penalty
from thesis_pin.smoothing.samples import Samples

LEAST, MOST = -16.0, 18.0
"""Bounds of log λ; above, coefficients go wild without an error."""
CONDITION = 23.0
"""Largest log λ·max(w): beyond, the equations' condition leaves no digits."""
_GRID = np.linspace(LEAST, MOST, 18)
_SHORTEST = -1.2  # logarithm of the least reach, in spans
_STEP = 2.0  # of log λ; between, the likelihood is a parabola


@dataclass(frozen=True)
class Solution:
    """The curve of one strength.

    Attributes:
        coefficients: Its coefficients, shape ``(count,)``.
        factor: Lower Cholesky factor of the free ones' equations, bands.
        misfit: Σ W r².
        total: The same and λ times the penalty.
        determinant: log |A|.
    """

    coefficients: Array
    factor: Array
    misfit: float
    total: float
    determinant: float


class Fit:
    """One order's fit of one curve, for one distribution of strength over its spans.

    Args:
        samples: What is fitted.
        order: m, the derivative that is penalised.
        weight: Relative penalty at Gauss's points ``(spans, 3)``; None is one everywhere.
    """

    def __init__(self, samples: Samples, order: int, weight: Array | None = None) -> None:
        self.samples, self.order = samples, order
        self.penalty: Penalty = penalty(samples.rows.basis.spans, order)
        self.weight = np.ones((samples.rows.basis.spans, 3)) if weight is None else weight
        self._bands = self.penalty.bands(weight)
        self._pull = self.penalty.times(samples.base, self.weight)
        self._known: dict[float, Solution] = {}
        count = len(samples.values)
        free = samples.free.stop - samples.free.start
        loose = max(0, order - (samples.rows.basis.count - free))
        self.degrees, self._rank = max(count - loose, 1), free - loose
        self.most = min(MOST, CONDITION - float(np.log(self.weight.max())))
        # Weaker than this, nothing would hold the curve between its samples.
        dense = float(samples.weight.sum()) / samples.rows.basis.spans
        self.least = max(LEAST, 2 * order * _SHORTEST + float(np.log(dense)))

    def at(self, strength: float) -> Solution:
        """The solution of one log λ."""
        if strength not in self._known:
            self._known[strength] = self._solve(strength)
        return self._known[strength]

    def _solve(self, strength: float) -> Solution:
        from scipy.linalg import lapack

        samples, ratio = self.samples, float(np.exp(strength))
        free = samples.free
        band = (samples.gram + ratio * self._bands)[:, free]
        factor, failed = lapack.dpbtrf(band, lower=1)
        if failed:  # only ever rounding: a little more on the diagonal
            band[0] *= 1.0 + 1e-10
            factor, _ = lapack.dpbtrf(band, lower=1)
        right = samples.moments[free] - ratio * self._pull[free]
        inner, _ = lapack.dpbtrs(factor, right, lower=1)
        coefficients = samples.base.copy()
        coefficients[free] = inner
        misfit = samples.misfit(coefficients)
        rough = float((self.weight * self.penalty.roots(coefficients) ** 2).sum())
        determinant = 2.0 * float(np.log(factor[0]).sum())
        return Solution(coefficients, factor, misfit, misfit + ratio * rough, determinant)

    def sigma(self, strength: float) -> float:
        """The noise that one strength leaves."""
        return float(np.sqrt(self.at(strength).total / self.degrees))

    def criterion(self, strength: float, sigma: float | None, least: float) -> float:
        """−2 log of the marginal likelihood; with σ free where it is None."""
        found = self.at(strength)
        prior = found.determinant - self._rank * strength
        if sigma is None:
            variance = max(found.total / self.degrees, least**2)
            return float(self.degrees * np.log(variance) + prior)
        return float(self.degrees * np.log(sigma**2) + found.total / sigma**2 + prior)

    def best(self, sigma: float | None, least: float, near: float | None = None) -> float:
        """log λ of the largest likelihood, σ given or free; ``near`` a known one if given."""

        def cost(strength: float) -> float:
            return self.criterion(strength, sigma, least)

        if near is None:
            tried = _GRID[(self.least <= _GRID) & (self.most >= _GRID)]
        else:
            tried = np.clip(near + _STEP * np.array([-1.0, 0.0, 1.0]), self.least, self.most)
        costs = [cost(float(strength)) for strength in tried]
        while (k := int(np.argmin(costs))) in (0, len(tried) - 1):
            beyond = float(tried[k] + (_STEP if k else -_STEP))
            if not self.least <= beyond <= self.most:
                return float(tried[k])
            tried, costs = np.insert(tried, k + (k > 0), beyond), [*costs]
            costs.insert(k + (k > 0), cost(beyond))
        x = _vertex(tried[k - 1 : k + 2], costs[k - 1 : k + 2])
        return x if cost(x) < costs[k] else float(tried[k])


def _vertex(x: Array, y: Sequence[float]) -> float:
    """Where the parabola through three points is least; the middle one is the least."""
    left, right = x[1] - x[0], x[2] - x[1]
    if not (left > 0 and right > 0):
        return float(x[1])
    fall, rise = (y[0] - y[1]) / left, (y[2] - y[1]) / right
    bend = fall + rise
    middle = (fall * right - rise * left) / 2.0
    return float(x[1] + (middle / bend if bend > 0 else 0.0))


@dataclass(frozen=True)
class Strength:
    """What the likelihood says of a fit.

    Attributes:
        fit: The fit.
        log: log λ.
        sigma: Noise σ.
    """

    fit: Fit
    log: float
    sigma: float

    @property
    def solution(self) -> Solution:
        """The curve."""
        return self.fit.at(self.log)

    @property
    def reach(self) -> float:
        """How far a sample is felt, in spans: less than about one is the basis's own limit."""
        samples = self.fit.samples
        dense = float(samples.weight.sum()) / samples.rows.basis.spans
        local = np.log(np.median(self.fit.weight))
        return float(np.exp((self.log + local - np.log(dense)) / (2 * self.fit.order)))


def strongest(fit: Fit, floor: float, noise: float, near: float | None = None) -> Strength:
    """Strength and noise of a fit by marginal likelihood.

    Args:
        fit: The fit.
        floor: Least σ: a quantum over √12, or what is known otherwise.
        noise: σ by high differences, taken where the curve would follow every sample.
        near: log λ to search around; None searches everywhere.
    """
    least = max(floor, 1e-15 * float(np.ptp(fit.samples.values)), 1e-300)
    log = fit.best(None, least, near)
    sigma = fit.sigma(log)
    if sigma < floor:
        sigma = floor
        log = fit.best(sigma, least, near)
    if log < max(-8.0, fit.least + _STEP) and noise > 2.0 * sigma:
        sigma = noise
        log = fit.best(sigma, least)
    return Strength(fit, log, max(sigma, least))
