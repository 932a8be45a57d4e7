"""What samples show of their own resolution: quantum, noise, stillness."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ROUNDING = 1.0 / math.sqrt(12.0)
"""Standard deviation of rounding, in quanta: errors lie evenly within ± half of one."""

GAIN = 6.0
"""A cubic spline through samples of noise σ, a step h apart, has second derivatives that are
wrong by GAIN·σ/h² (root mean square at the samples; measured, not-a-knot ends)."""

RATE_GAIN = 1.2
"""The same of first derivatives: RATE_GAIN·σ/h."""

_NORMAL = 1.4826  # from the median of sizes to the standard deviation of a normal variable
_FEW = 8  # samples that don't tell noise from motion by themselves
_FAR = 4.5  # standard deviations that noise doesn't reach
_ODD = 6.0  # standard deviations that none of many samples of noise reaches
_FALLS = 0.6  # of white noise, estimates by higher differences stay; of motion they fall


def acceleration_noise(sigma: float, step: float) -> float:
    """Error of second derivatives that a spline through noisy samples has.

    Args:
        sigma: Noise of the samples.
        step: Time between two.
    """
    return GAIN * sigma / step**2


def rate_noise(sigma: float, step: float) -> float:
    """Error of first derivatives that a spline through noisy samples has.

    Args:
        sigma: Noise of the samples.
        step: Time between two.
    """
    return RATE_GAIN * sigma / step


def difference_noise(values: Array, order: int) -> float:
    """Standard deviation of noise by the median of differences; 0 if there are too few.

    Args:
        values: Samples at equal steps, shape ``(n,)``.
        order: How many times neighbours are subtracted.
    """
    if len(values) < order + 4:
        return 0.0
    size = float(np.median(np.abs(np.diff(values, order))))
    return _NORMAL * size / math.sqrt(math.comb(2 * order, order))


def white_noise(values: Array) -> float:
    """Noise that is there whatever the text's digits say; 0 where differences show motion.

    Differences of white noise grow by a known factor with each order, those of a motion
    that is sampled finely enough don't.

    Args:
        values: Samples at equal steps, shape ``(n,)``.
    """
    found = [difference_noise(values, order) for order in (6, 8, 10)]
    if min(found) <= 0 or found[1] < _FALLS * found[0] or found[2] < _FALLS * found[1]:
        return 0.0
    return min(found)


def uneven(time: Array, quantum: float) -> float:
    """Noise of time stamps that are written in steps of ``quantum`` [s]; 0 if steps are equal."""
    steps = np.diff(time)
    return quantum * ROUNDING if np.ptp(steps) > 0.5 * quantum else 0.0


def run_lengths(values: Array) -> Array:
    """For each sample, how many neighbours in a row share its value, itself included."""
    change = np.flatnonzero(np.diff(values)) + 1
    lengths = np.diff(np.concatenate([[0], change, [len(values)]]))
    return np.repeat(lengths, lengths).astype(np.float64)


@dataclass(frozen=True)
class Still:
    """A stretch of samples that shows no motion.

    Attributes:
        value: Where it rests.
        sd: Standard deviation of that.
    """

    value: float
    sd: float


def still(values: Array, quantum: float, noise: float = 0.0) -> Still | None:
    """Whether samples of one stretch are those of something at rest, and where; None if not.

    Args:
        values: Samples, shape ``(n,)``.
        quantum: Smallest step that their text resolves.
        noise: What else is known of their noise.

    Source: J. von Neumann, "Distribution of the ratio of the mean square successive
    difference to the variance", Ann. Math. Stat. 12 (1941): 1 for noise, less for motion.
    """
    count = len(values)
    # A mean of equal values may differ from them.
    middle = float(values.mean() if np.ptp(values) > 0 else values[0])
    rounding, spread = quantum * ROUNDING, float(values.std(ddof=1)) if count > 1 else 0.0
    if float(np.ptp(values)) <= 1.01 * quantum:
        # Rounding of a constant is a bias that no number of samples averages out.
        return Still(middle, rounding)
    if count < _FEW:
        known = max(rounding, noise)
        if np.abs(values - middle).max() >= _FAR * known:
            return None
        return Still(middle, known)
    ratio = float(np.mean(np.diff(values) ** 2)) / (2.0 * spread**2)
    u = np.linspace(-1.0, 1.0, count)
    slope = abs(float(u @ (values - middle) / (u @ u)))
    moves = ratio < max(0.25, 1.0 - 4.0 / math.sqrt(count))
    odd = float(np.abs(values - middle).max()) >= _ODD * spread
    if moves or odd or slope >= 4.0 * spread / math.sqrt(count / 3.0):
        return None
    averaged = spread / math.sqrt(count)
    return Still(middle, averaged if spread > quantum else max(averaged, rounding))


def sample_noise(time: Array, values: Array, quantum: float, time_quantum: float = 0.0) -> float:
    """Noise of samples as far as they show it: rounding, what differences tell, uneven times.

    Args:
        time: Sample times, ascending, shape ``(n,)``.
        values: Samples, shape ``(n,)``.
        quantum: Smallest step that their text resolves.
        time_quantum: The same of the times.
    """
    sigma = max(quantum * ROUNDING, white_noise(values))
    if not time_quantum:
        return sigma
    rate = float(np.quantile(np.abs(np.diff(values) / np.diff(time)), 0.95))
    return math.hypot(sigma, rate * uneven(time, time_quantum))
