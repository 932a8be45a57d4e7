"""From samples to a curve with its rival and its draws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.smoothing.basis import DEGREE, Array, Basis
from thesis_pin.smoothing.fit import Fit, Strength, strongest
from thesis_pin.smoothing.local import localised
from thesis_pin.smoothing.noise import ROUNDING, Still, difference_noise, run_lengths, still
from thesis_pin.smoothing.posterior import draws as posterior_draws
from thesis_pin.smoothing.samples import Samples

DRAWS = 16
"""Draws from the posterior: enough for a standard deviation to ± 18 %."""
SEED = 20190523
"""Of the draws, so that the same file gives the same report."""
ORDER, RIVAL = 4, 3
"""Derivative whose square is penalised, and that of the fit held against it: order 4 is the
better one for smooth motions, order 3 where a jerk or an acceleration jumps."""

_FIRST = 300  # spans tried first
_MOST = 4000
_SHORT, _LONG = 0.6, 1.6  # spans over which a sample is felt: more spans below, fewer above
_LEAST_SPANS = 8
_TRIES = 5


@dataclass(frozen=True)
class SmoothCurve:
    """A curve through samples of finite resolution, as far as they determine it.

    Attributes:
        variants: Order 4's curve, order 3's, then draws of order 4; a piecewise
            polynomial with values of shape ``(2 + draws,)``.
        sigma: Noise of a sample, standard deviation.
    """

    variants: Piecewise
    sigma: float

    @property
    def value(self) -> Piecewise:
        """The curve."""
        return self._one(0)

    @property
    def rival(self) -> Piecewise:
        """Order 3's curve: where the two differ, the samples leave a bias open."""
        return self._one(1)

    @property
    def draws(self) -> Piecewise:
        """Curves as probable as the samples leave them, values ``(draws,)``."""
        return Piecewise(self.variants.c[..., 2:], self.variants.x)

    def _one(self, k: int) -> Piecewise:
        return Piecewise(self.variants.c[..., k], self.variants.x)


@dataclass(frozen=True)
class End:
    """A value at which a curve starts or ends at rest.

    Attributes:
        value: The value.
        offsets: By how much it is off in each draw, shape ``(draws,)``.
    """

    value: float
    offsets: Array


def generator(*stream: int) -> np.random.Generator:
    """Random numbers of one column: the same for the same numbers, independent for others."""
    return np.random.default_rng([SEED, *stream])


def rest(still: Still, random: np.random.Generator, draws: int = DRAWS) -> End:
    """Where something stands still, and how far each draw is off."""
    return End(still.value, still.sd * random.standard_normal(draws))


def constant_curve(start: float, end: float, at: End) -> SmoothCurve:
    """A curve that rests."""
    values = np.concatenate([[at.value, at.value], at.value + at.offsets])
    sd = float(at.offsets.std()) if at.offsets.any() else 0.0
    return SmoothCurve(Piecewise(values[None, None], np.array([start, end])), sd)


def fitted(
    time: Array,
    values: Array,
    quantum: float,
    random: np.random.Generator,
    runs: Array | None = None,
) -> SmoothCurve:
    """The curve of one column that nobody holds: of something at rest, or :func:`smooth_curve`."""
    at_rest = still(values, quantum)
    if at_rest is not None:
        return constant_curve(float(time[0]), float(time[-1]), rest(at_rest, random))
    return smooth_curve(time, values, quantum, random, runs=runs)


def smooth_curve(
    time: Array,
    values: Array,
    quantum: float,
    random: np.random.Generator,
    *,
    ends: tuple[End | None, End | None] = (None, None),
    draws: int = DRAWS,
    runs: Array | None = None,
) -> SmoothCurve:
    """Fit one column.

    Args:
        time: Times, ascending, shape ``(n,)``.
        values: Samples, shape ``(n,)``.
        quantum: Smallest step that their text resolves, same unit; 0 if unknown.
        random: See :func:`generator`.
        ends: Where the curve starts and ends at rest; None where it goes on.
        draws: How many draws.
        runs: Samples in a row whose errors are one, of values that were made from others,
            shape ``(n,)``; None for runs of equal values.

    Source: see :mod:`thesis_pin.smoothing.fit`; two orders because intervals of one smoothing
    spline cover on average, not pointwise: D. Nychka, "Bayesian confidence intervals
    for smoothing splines", J. Am. Stat. Assoc. 83 (1988).
    """
    floor, noise = quantum * ROUNDING, difference_noise(values, 6)
    weight = 1.0 / (run_lengths(values) if runs is None else runs)
    main = _with_enough_spans(time, values, weight, floor, noise, ends)
    samples = main.fit.samples
    rival = strongest(Fit(samples, RIVAL), floor, noise)
    count = samples.rows.basis.count
    # The curve itself depends on its samples only: all curves share these numbers.
    shared = generator().standard_normal((count, DRAWS))
    main, rival = (localised(one, floor, noise, shared) for one in (main, rival))
    normal = random.standard_normal((count, draws))
    offsets = np.stack([np.zeros(draws) if end is None else end.offsets for end in ends])
    drawn = posterior_draws(main, normal, offsets)
    every = np.column_stack([main.solution.coefficients, rival.solution.coefficients, drawn])
    basis = samples.rows.basis
    c = basis.polynomials(every)
    c[-1] += samples.origin
    return SmoothCurve(Piecewise(c, basis.knots), main.sigma)


def _with_enough_spans(
    time: Array,
    values: Array,
    weight: Array,
    floor: float,
    noise: float,
    ends: tuple[End | None, End | None],
) -> Strength:
    """Order 4's fit on as many spans as the samples fill."""
    most = max(min(len(time) - 1, _MOST), _LEAST_SPANS)
    spans = min(most, max(_FIRST, len(time) // 8))
    for _ in range(_TRIES):
        basis = Basis(float(time[0]), float(time[-1]), spans)
        found = strongest(Fit(_samples(basis, time, values, weight, ends), ORDER), floor, noise)
        if found.sigma > 2.0 * max(floor, noise) and spans < most:
            wanted = 2 * spans  # the basis can't follow what isn't noise
        elif _SHORT <= found.reach <= _LONG:
            break
        else:
            wanted = round(spans * min(max(1.0 / found.reach, 0.25), 4.0))
        wanted = min(max(wanted, _LEAST_SPANS), most)
        if wanted == spans:
            break
        spans = wanted
    return found


def _samples(
    basis: Basis,
    time: Array,
    values: Array,
    weight: Array,
    ends: tuple[End | None, End | None],
) -> Samples:
    first, last = (None if end is None else end.value for end in ends)
    # A fixed end first: a mean would leave the difference of two large numbers there.
    origin = first if first is not None else last if last is not None else float(values.mean())
    fixed = tuple(None if value is None else value - origin for value in (first, last))
    return Samples(
        basis.rows(time),
        values - origin,
        weight,
        origin,
        (fixed[0], fixed[1]),
    )


def joined(pieces: Sequence[SmoothCurve]) -> SmoothCurve:
    """Curves that follow each other, as one."""
    padded = []
    for piece in pieces:
        c = piece.variants.c
        padded.append(np.concatenate([np.zeros((DEGREE + 1 - len(c), *c.shape[1:])), c]))
    knots = [pieces[0].variants.x, *(piece.variants.x[1:] for piece in pieces[1:])]
    sigma = max(piece.sigma for piece in pieces)
    return SmoothCurve(Piecewise(np.concatenate(padded, axis=1), np.concatenate(knots)), sigma)
