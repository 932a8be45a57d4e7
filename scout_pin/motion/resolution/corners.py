"""Corners that exact samples of a foot show: rates that jump.

A spline through all samples rings there, and its accelerations are those of no motion.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scout_pin.motion.resolution.feet import LEAST_ROWS, MORE, runs
from thesis_pin.numeric.interpolation import free, free_quintic
from thesis_pin.smoothing.corners import corners
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]


def starts_with_a_jump(time: Array, poses: Array, standing: NDArray[np.bool_]) -> bool:
    """Whether any rate of a foot jumps where a swing begins or ends, or inside.

    A foot that starts from rest has at most the rate that its largest acceleration gives it
    on the way that it has made.

    Args:
        time: Times of the rows [s], shape ``(n,)``.
        poses: Exact samples of the foot's coordinates, ``(n, 6)``.
        standing: Rows in which it bears load, ``(n,)``.
    """
    for first, last in runs(~standing):
        before, after = first - 1, last + 1
        if before >= 0:  # rows at which the foot is still on its place are no swing
            first += int(np.argmax(_away(poses[first : last + 1], poses[before])))
        if after < len(poses):
            last -= int(np.argmax(_away(poses[first : last + 1], poses[after])[::-1]))
        for k in range(poses.shape[1]):
            if last - first >= LEAST_ROWS and np.ptp(poses[first : last + 1, k]) > 0:
                rows = (before, first), (after, last)
                swing = time[first : last + 1]
                inside = corners(swing, poses[first : last + 1, k], 0.0)
                if inside or _jumps(swing, poses[:, k], rows):
                    return True
    return False


def _away(poses: Array, place: Array) -> NDArray[np.bool_]:
    return np.asarray((np.abs(poses - place) > TOLERANCES.seam / 10.0).any(axis=1))


def _jumps(time: Array, values: Array, rows: tuple[tuple[int, int], tuple[int, int]]) -> bool:
    """Whether one coordinate of a swing starts or ends faster than from rest.

    Args:
        time: Times of the swing's rows.
        values: The coordinate in all rows.
        rows: At its start and at its end, the row at rest, and that of the swing next to it.
    """
    inner = values[rows[0][1] : rows[1][1] + 1]
    curve, rival = free(time, inner), free_quintic(time, inner)
    fastest = float(np.abs(curve(time, 2)).max())
    for (place, row), at in zip(rows, time[[0, -1]], strict=True):
        if 0 <= place < len(values):
            rate = min(abs(float(one(at, 1))) for one in (curve, rival))
            way = abs(float(values[row] - values[place]))
            if rate > TOLERANCES.rate_jump and rate**2 > MORE * 2.0 * fastest * way:
                return True
    return False
