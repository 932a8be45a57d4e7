"""A foot's curves from samples of finite resolution: exactly still while it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import POSE_NAMES
from thesis_pin.smoothing.corners import corners, in_pieces, straight, through
from thesis_pin.smoothing.curve import (
    DRAWS,
    End,
    SmoothCurve,
    constant_curve,
    generator,
    joined,
    rest,
    smooth_curve,
)
from thesis_pin.smoothing.noise import ROUNDING, still, white_noise
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

FLOOR = (2, 3, 4)
"""z, pitch and roll: zero while a foot stands."""

_STANDS = np.array([TOLERANCES.stance_drift] * 3 + [TOLERANCES.stance_tilt] * 3)
_NEAR = np.array([TOLERANCES.stance_near] * 3 + [TOLERANCES.stance_near_tilt] * 3)
_FAR = 4.5  # standard deviations of noise by which a standing foot may seem off the floor
LEAST_ROWS = 8
"""Rows of a swing that tell its rate at an end."""

_NORMAL = 1.0484  # from the median of neighbours' differences to the deviation of each
MORE = 1.25
"""Of the way to a rate: the largest acceleration may be a little larger next to an end."""

_MISSED = 4.0  # standard deviations of a sample by which a start from rest must miss them
_STANCES = 1  # one of two kinds of streams of random numbers
_SWINGS = 2


@dataclass(frozen=True)
class Stance:
    """Rows in which a foot stands.

    Attributes:
        first, last: The rows.
        place: Where, one :class:`~thesis_pin.smoothing.curve.End` a coordinate.
    """

    first: int
    last: int
    place: tuple[End, ...]


@dataclass(frozen=True)
class Moving:
    """A stance that isn't one.

    Attributes:
        first, last: Rows that are said to stand.
        coordinate: Which moves, or is off the floor.
        size: By how much.
        off_floor: Whether it rests, but not on the floor.
    """

    first: int
    last: int
    coordinate: int
    size: float
    off_floor: bool


def runs(yes: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and last row of each run of rows that say yes."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], yes, [False]]).astype(np.int8)))
    return [(int(a), int(b) - 1) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def stances(
    poses: Array, standing: NDArray[np.bool_], quanta: Array, noise: Array, side: int
) -> list[Stance | Moving]:
    """Where a foot stands, run by run of the rows that say so.

    A row at either end of a run may find the foot already or still on its way.

    Args:
        poses: Samples of the foot's coordinates, shape ``(n, 6)``.
        standing: Rows in which it bears load, ``(n,)``.
        quanta: Resolution of the columns, ``(6,)``.
        noise: What is known of their noise beyond, ``(6,)``.
        side: 0 or 1, for the random numbers.

    Returns:
        A stance for each run, or what keeps it from being one.
    """
    found: list[Stance | Moving] = []
    for number, (first, last) in enumerate(runs(standing)):
        tried: list[Stance | Moving] = []
        for at, to in ((first, last), (first + 1, last), (first, last - 1), (first + 1, last - 1)):
            if to < at or (tried and to - at < 2):
                continue
            if (at > first == 0) or (to < last == len(poses) - 1):
                continue  # nothing comes before or after that it could be on its way from or to
            one = _stance(poses[at : to + 1], (at, to), quanta, noise, (side, number))
            whole = (at, to) == (first, last)
            if isinstance(one, Stance) and (whole or _near(poses[[first, last]], one, noise)):
                tried = [one]
                break
            tried.append(one)
        # What moves is said of the whole run, of which no part stands.
        found.append(tried[0])
    return found


def _near(ends: Array, stance: Stance, noise: Array) -> bool:
    """Whether a foot is on its place in the first and last row, or about to be."""
    place = np.array([one.value for one in stance.place])
    return bool((np.abs(ends - place) <= np.maximum(_NEAR, _FAR * noise)).all())


def foot_noise(poses: Array, standing: NDArray[np.bool_]) -> Array:
    """What a foot's samples show of their noise, above all while it stands, ``(6,)``.

    Args:
        poses: Samples of its coordinates, shape ``(n, 6)``.
        standing: Rows in which it bears load, ``(n,)``.
    """
    steps = np.diff(poses, axis=0)[standing[1:] & standing[:-1]]
    beside = np.median(np.abs(steps), axis=0) if len(steps) else np.zeros(poses.shape[1])
    still_ones = _NORMAL * beside
    return np.asarray(np.maximum(still_ones, [white_noise(column) for column in poses.T]))


def _stance(
    poses: Array, rows: tuple[int, int], quanta: Array, noise: Array, stream: tuple[int, int]
) -> Stance | Moving:
    place = []
    for k in range(len(POSE_NAMES)):
        values = poses[:, k]
        found = still(values, float(quanta[k]), float(noise[k]))
        if found is None and np.ptp(values) > _STANDS[k]:
            return Moving(*rows, k, float(np.ptp(values)), False)
        middle = float(values.mean() if np.ptp(values) > 0 else values[0])
        if k not in FLOOR and found is not None:
            place.append(rest(found, generator(_STANCES, *stream, k)))
            continue
        spread = max(float(values.std()), float(quanta[k]) * ROUNDING)
        if k in FLOOR and abs(middle) > max(_STANDS[k], _FAR * spread):
            return Moving(*rows, k, middle, True)
        place.append(End(0.0 if k in FLOOR else middle, np.zeros(DRAWS)))
    return Stance(*rows, tuple(place))


@dataclass(frozen=True)
class Moved:
    """A body's curves.

    Attributes:
        curves: One a coordinate.
        hidden: Pairs of neighbouring rows of whose motion in between nothing is known: a rate
            jumps there, or the foot leaves its place before it is said to swing.
        jumps: Row before it, coordinate and size per unit of time of each jump of a rate.
    """

    curves: tuple[SmoothCurve, ...]
    hidden: tuple[tuple[int, int], ...]
    jumps: tuple[tuple[int, int, float], ...]


def foot(
    time: Array,
    poses: Array,
    stood: Sequence[Stance],
    quanta: Array,
    noise: Array,
    side: int,
    *,
    exact: bool = False,
) -> Moved:
    """Curves of a foot that rests in its stances and swings between them.

    Args:
        time: Times of the rows, shape ``(n,)``.
        poses: Samples, ``(n, 6)``.
        stood: Its stances, in order.
        quanta: Resolution of the columns, ``(6,)``.
        noise: What is known of their noise beyond, ``(6,)``.
        side: 0 or 1, for the random numbers.
        exact: Whether swings pass through every sample.
    """
    curves: list[SmoothCurve] = []
    hidden: set[tuple[int, int]] = set()
    jumps: list[tuple[int, int, float]] = []
    for k in range(len(POSE_NAMES)):
        whole = _constant(time, poses[:, k], stood, quanta, side, k)
        if whole is not None:
            curves.append(whole)
            continue
        pieces, rows = [], [None, *stood, None]
        for number, (before, after) in enumerate(pairwise(rows)):
            if before is not None and before.last > before.first:
                span = time[before.first], time[before.last]
                pieces.append(constant_curve(*span, before.place[k]))
            first = 0 if before is None else before.last
            last = len(time) - 1 if after is None else after.first
            if last <= first:
                continue
            ends = [None if one is None else one.place[k] for one in (before, after)]
            if None in ends and len(stood) and last - first < LEAST_ROWS:
                # Too few rows to tell how a free end moves: it rests at its own sample.
                row, spread = (first, 0) if ends[0] is None else (last, 1)
                wrong = max(float(quanta[k]) * ROUNDING, float(noise[k]))
                offsets = wrong * generator(_STANCES, side, k, number).standard_normal(DRAWS)
                ends[spread] = End(float(poses[row, k]), offsets)
            swing = _Swing(time, poses[:, k], float(quanta[k]), (side, k, number), exact)
            made, found = swing.between(first, last, (ends[0], ends[1]))
            pieces += made
            hidden.update((row, row + 1) for row, _ in found)
            jumps += [(row, k, size) for row, size in found]
        curves.append(joined(pieces))
    return Moved(tuple(curves), tuple(sorted(hidden)), tuple(jumps))


def _constant(
    time: Array, values: Array, stood: Sequence[Stance], quanta: Array, side: int, k: int
) -> SmoothCurve | None:
    """The curve of a coordinate that never moves; None if it does."""
    found = still(values, float(quanta[k]))
    if found is None:
        return None
    at = rest(found, generator(_STANCES, side, len(stood), k))
    if stood and k in FLOOR:
        at = stood[0].place[k]
    return constant_curve(float(time[0]), float(time[-1]), at)


@dataclass(frozen=True)
class _Swing:
    """One coordinate of one swing."""

    time: Array
    values: Array
    quantum: float
    stream: tuple[int, int, int]
    exact: bool

    def between(
        self, first: int, last: int, ends: tuple[End | None, End | None]
    ) -> tuple[list[SmoothCurve], list[tuple[int, float]]]:
        """Curves from one row to another, and jumps of rate: row before each, and size."""
        start, stop = first, last
        jumps: list[float | None] = [None, None]
        inner = (first + (ends[0] is not None), last - (ends[1] is not None))
        if inner[1] - inner[0] >= LEAST_ROWS and any(end is not None for end in ends):
            jumps = self._jumps(*inner, ends)
        start, stop = first + (jumps[0] is not None), last - (jumps[1] is not None)
        kept = tuple(end if jump is None else None for jump, end in zip(jumps, ends, strict=True))
        rows, random = slice(start, stop + 1), generator(_SWINGS, *self.stream)
        part = self.time[rows], self.values[rows], self.quantum, random
        pieces, inside = in_pieces(*part, (kept[0], kept[1]), exact=self.exact)
        found = [(start + row, size) for row, size in inside]
        if jumps[0] is not None and ends[0] is not None:
            span = self.time[first : first + 2]
            pieces.insert(0, straight(span, _variants(ends[0]), pieces[0].variants(span[1])))
            found.append((first, jumps[0]))
        if jumps[1] is not None and ends[1] is not None:
            span = self.time[last - 1 : last + 1]
            pieces.append(straight(span, pieces[-1].variants(span[0]), _variants(ends[1])))
            found.append((last - 1, jumps[1]))
        return pieces, found

    def _fit(self, first: int, last: int, ends: tuple[End | None, End | None]) -> SmoothCurve:
        rows = slice(first, last + 1)
        if self.exact:
            return through(self.time[rows], self.values[rows], ends)
        random = generator(_SWINGS, *self.stream)
        return smooth_curve(self.time[rows], self.values[rows], self.quantum, random, ends=ends)

    def _jumps(
        self, first: int, last: int, ends: tuple[End | None, End | None]
    ) -> list[float | None]:
        """Sizes of the rate's jumps where the swing begins and ends; None where it rests there.

        A foot that starts from rest has, one row on, at most the rate that its largest
        acceleration gives it in that time. If it has the rate that this gives it on the way that
        it has made, it was said to stand a little too long, and the jump is 0. And a start from
        rest that was a little earlier must miss the samples by more than their noise.
        """
        rows = slice(first, last + 1)
        inside = corners(self.time[rows], self.values[rows], self.quantum)
        bounds = [first, *(first + k for row in inside for k in (row, row + 1)), last]
        early = self._fit(bounds[0], bounds[1], (None, None))
        late = early if not inside else self._fit(bounds[-2], bounds[-1], (None, None))
        found = []
        for end, row, neighbour, curve, part in (
            (ends[0], first, first - 1, early, bounds[:2]),
            (ends[1], last, last + 1, late, bounds[-2:]),
        ):
            fastest = float(np.abs(curve.value(self.time[part[0] : part[1] + 1], 2)).max())
            at = self.time[row]
            rate = min(abs(float(curve.value(at, 1))), abs(float(curve.rival(at, 1))))
            spread = float(curve.draws(at, 1).std(ddof=1))
            step = abs(self.time[row] - self.time[min(max(neighbour, 0), len(self.time) - 1)])
            missed = rate**2 / (2.0 * fastest) if fastest else np.inf
            way = 0.0 if end is None else abs(float(curve.value(at)) - end.value)
            noise = _MISSED * curve.sigma
            begun = rate > max(2.0 * fastest * step, 5.0 * spread) and missed > noise
            jumps = missed > MORE * way + noise
            found.append((rate if jumps else 0.0) if end is not None and begun else None)
        return found


def _variants(at: End) -> Array:
    """The value of every variant at rest, shape ``(2 + draws,)``."""
    return np.concatenate([[at.value, at.value], at.value + at.offsets])
