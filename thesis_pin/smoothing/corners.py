"""Corners of a motion: rates, or values, that change in an instant between two samples.

A smooth curve through one has accelerations that are those of the samples' spacing. Pieces
that end there, and a straight way in between of which nothing is judged, have none.
"""

from __future__ import annotations

from math import factorial

import numpy as np

from thesis_pin.numeric.interpolation import free, free_quintic
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.smoothing.basis import DEGREE, Array
from thesis_pin.smoothing.curve import (
    DRAWS,
    End,
    SmoothCurve,
    constant_curve,
    fitted,
    smooth_curve,
)
from thesis_pin.smoothing.windows import greatest
from thesis_pin.tolerances import TOLERANCES

_AROUND = 8  # samples on either side that say what acceleration is usual
_TIMES = 5.0  # what a rate's change must exceed that by
_QUANTA = 2.0  # by which neighbours of one motion may differ for their text's sake
_TOLD = 6.0  # standard deviations by which the pieces on both sides of a corner must differ


def corners(time: Array, values: Array, quantum: float) -> list[int]:
    """Samples after which a rate or a value changes in an instant.

    The change is many times what the largest acceleration of the samples on both sides
    would make of it until the next sample; noise raises that acceleration too.

    Args:
        time: Times, ascending, shape ``(n,)``.
        values: Samples, shape ``(n,)``.
        quantum: Smallest step that their text resolves.

    Returns:
        Numbers of the samples before, at least eight from each other and from both ends.
    """
    count = len(time)
    if count < 2 * _AROUND + 2:
        return []
    step = np.diff(time)
    rate = np.diff(values) / step
    bend = 2.0 * np.diff(rate) / (step[1:] + step[:-1])  # at samples 1 … n − 2
    k = np.arange(_AROUND + 1, count - _AROUND - 2)
    if not k.size:
        return []
    before = rate[k - 1] + bend[k - 2] * step[k - 1] / 2.0
    after = rate[k + 1] - bend[k + 1] * step[k + 1] / 2.0
    changes = np.abs([rate[k] - before, rate[k] - after, after - before]).max(axis=0)
    # Of eight bends: those up to sample k − 1, those from sample k + 2 on.
    size, half = np.abs(bend), _AROUND // 2
    most = greatest(size, _AROUND)
    usual = np.maximum(most[k - 1 - half], most[k + 1 + half])
    bound = _TIMES * (usual * step[k] + _QUANTA * quantum / step[k])
    excess = np.where(changes > np.maximum(bound, TOLERANCES.rate_jump), changes, 0.0)
    highest = (excess > 0) & (excess >= greatest(excess, 2 * _AROUND + 1))
    found: list[int] = []
    for row in k[highest].tolist():
        if not found or row - found[-1] > _AROUND:
            found.append(row)
    return found


def in_pieces(
    time: Array,
    values: Array,
    quantum: float,
    random: np.random.Generator,
    ends: tuple[End | None, End | None] = (None, None),
    *,
    exact: bool = False,
) -> tuple[list[SmoothCurve], list[tuple[int, float]]]:
    """Fit one column between its corners.

    Args:
        time: Times, ascending, shape ``(n,)``.
        values: Samples, shape ``(n,)``.
        quantum: Smallest step that their text resolves.
        random: See :func:`~thesis_pin.smoothing.curve.generator`.
        ends: See :func:`~thesis_pin.smoothing.curve.smooth_curve`.
        exact: Whether to go through every sample, see :func:`through`.

    Returns:
        Curves that follow each other, and the sample before each corner with the size of
        its jump of rate.
    """
    rows = corners(time, values, quantum)
    while True:
        pieces = _pieces(time, values, rows, quantum, random, ends, exact)
        sides = zip(rows, pieces[:-1], pieces[1:], strict=True)
        # Of thousands of noisy samples some look like corners; their pieces don't tell one.
        told = [r for r, before, after in sides if exact or _differ(time[r + 1], before, after)]
        if told == rows:
            break
        rows = told
    made, found = pieces[:1], []
    for row, before, after in zip(rows, pieces[:-1], pieces[1:], strict=True):
        span = time[row : row + 2]
        made += [straight(span, before.variants(span[0]), after.variants(span[1])), after]
        jump = float(after.value(span[1], 1) - before.value(span[0], 1))
        found.append((row, abs(jump)))
    return made, found


def _pieces(
    time: Array,
    values: Array,
    rows: list[int],
    quantum: float,
    random: np.random.Generator,
    ends: tuple[End | None, End | None],
    exact: bool,
) -> list[SmoothCurve]:
    """A curve up to each of the rows, and one from the last."""
    pieces: list[SmoothCurve] = []
    for first, last in zip([0, *(row + 1 for row in rows)], [*rows, len(time) - 1], strict=True):
        held = (ends[0] if first == 0 else None, ends[1] if last == len(time) - 1 else None)
        part = time[first : last + 1], values[first : last + 1]
        if exact:
            pieces.append(through(*part, held))
        elif held == (None, None):
            pieces.append(fitted(*part, quantum, random))
        else:
            pieces.append(smooth_curve(*part, quantum, random, ends=held))
    return pieces


def _differ(at: float, before: SmoothCurve, after: SmoothCurve) -> bool:
    """Whether two pieces differ in value or rate by more than their samples leave open."""
    for order in (0, 1):
        gap = after.variants(at, order) - before.variants(at, order)
        spread = float(gap[2:].std(ddof=1))
        if min(abs(gap[:2])) > _TOLD * spread and gap[0] * gap[1] > 0:
            return True
    return False


def through(
    time: Array, values: Array, ends: tuple[End | None, End | None] = (None, None)
) -> SmoothCurve:
    """A cubic spline through samples that are exact; its rival is a quintic one.

    Args:
        time: Times, ascending, shape ``(n,)``.
        values: Samples, shape ``(n,)``.
        ends: Where the curve starts and ends at rest; of their values the rate counts.
    """
    if not np.ptp(values) > 0:
        return constant_curve(
            float(time[0]), float(time[-1]), End(float(values[0]), np.zeros(DRAWS))
        )
    from scipy.interpolate import CubicSpline

    known = tuple("not-a-knot" if end is None else "clamped" for end in ends)
    curve = CubicSpline(time, values, bc_type=known)
    rival = free_quintic(time, values) if ends == (None, None) else free(time, values)
    powers = range(DEGREE, -1, -1)
    own, other = (
        np.stack([one(time[:-1], power) / factorial(power) for power in powers])
        for one in (curve, rival)
    )
    c = np.stack([own, other, *[own] * DRAWS], axis=-1)
    return SmoothCurve(Piecewise(c, time), 0.0)


def straight(span: Array, low: Array, high: Array) -> SmoothCurve:
    """The straight way between two samples of which nothing is known, in every variant.

    Args:
        span: Times of the two.
        low: Values of all variants at the first, shape ``(2 + draws,)``.
        high: The same at the second.
    """
    c = np.stack([(high - low) / (span[1] - span[0]), low])[:, None]
    return SmoothCurve(Piecewise(c, span), 0.0)
