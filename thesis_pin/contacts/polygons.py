"""How near flat soles come to each other: distances of polygons in space, in closed form."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from thesis_pin.numeric.elementwise import Samples
from thesis_pin.tolerances import TOLERANCES

Moving: TypeAlias = np.ndarray | Callable[[Samples], np.ndarray]
"""Corners of a moving polygon, or what gives those of some samples."""

_LINES = np.array(
    [[np.cos(a), np.sin(a), 0.0] for a in np.pi * np.arange(8) / 8] + [[0.0, 0.0, 1.0]]
)
_TOGETHER = 16  # pairs of polygons worked on at a time, those likely nearest first


def polygon_distance(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Least distance of two flat polygons' areas, zero where they meet.

    The least distance is that of two edges, or of a corner of one to the area of the other;
    if an edge of one passes through the other it is zero. Polygons needn't be convex.

    Args:
        one: Corners in order [m], shape ``(n, corners, 3)``.
        other: The same of the other polygon.

    Returns:
        Distances [m], shape ``(n,)``.
    """
    edges = _segment_distance(one, other)
    corners = np.minimum(_corners_to_area(one, other), _corners_to_area(other, one))
    return np.asarray(np.minimum(edges, corners))


def least_distance(
    one: Moving,
    other: Moving,
    known: float = np.inf,
    hulls: tuple[np.ndarray, np.ndarray] | None = None,
) -> tuple[float, int] | None:
    """Where two moving polygons are nearest: the distance [m], and the sample.

    Args:
        one: Corners of one polygon at each sample [m], shape ``(n, corners, 3)``; or, if its
            hull is known, what gives those of some samples.
        other: The same of the other one.
        known: A distance [m] known from elsewhere.
        hulls: Corners of each polygon's convex hull at each sample, if they are known: the
            others cast no shadow of their own.

    Returns:
        None if no pair is nearer than what is known. Pairs that differ by less than the
        tolerance ``nearer`` are alike: the one that is looked at first is named.
    """
    # How far apart their shadows are bounds the distance from below: on a few fixed lines
    # first, and where that doesn't tell, across every edge.
    outer = (_some(one, slice(None)), _some(other, slice(None))) if hulls is None else hulls
    apart = _level_and_upright(*outer)
    sample = int(np.argmin(apart))
    if apart[sample] >= known - TOLERANCES.nearer:
        return None
    first = np.array([sample])
    least = float(polygon_distance(_some(one, first), _some(other, first))[0])
    some = np.flatnonzero(apart < min(least, known) - TOLERANCES.nearer)
    apart = _apart(outer[0][some], outer[1][some])
    order = np.argsort(apart)
    for start in range(0, len(some), _TOGETHER):
        some_more = order[start : start + _TOGETHER]
        if apart[some_more[0]] >= min(least, known) - TOLERANCES.nearer:
            break
        part = some[some_more]
        found = polygon_distance(_some(one, part), _some(other, part))
        if found.min() < least:
            least, sample = float(found.min()), int(part[np.argmin(found)])
    return (least, sample) if least < known else None


def _some(polygon: Moving, samples: Samples) -> np.ndarray:
    return polygon[samples] if isinstance(polygon, np.ndarray) else polygon(samples)


def _level_and_upright(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """How far apart shadows are at most on a few level lines and the vertical, ``(n,)``."""
    # Coordinates first, then corners: a third of the time.
    here, there = (
        np.ascontiguousarray(np.moveaxis(part, 0, -1)).transpose(1, 0, 2) for part in (one, other)
    )
    apart = np.full(len(one), -np.inf)
    for x, y, z in _LINES.tolist():
        mine, its = (x * c[0] + y * c[1] if not z else c[2] for c in (here, there))
        np.maximum(apart, its.min(axis=0) - mine.max(axis=0), out=apart)
        np.maximum(apart, mine.min(axis=0) - its.max(axis=0), out=apart)
    return apart


def _apart(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """How far apart the shadows are at most, on the vertical and across any edge, ``(n,)``.

    No more than the distance; soles side by side are just as far apart.
    """
    edges = [np.roll(part, -1, axis=1)[..., :2] - part[..., :2] for part in (one, other)]
    level = np.concatenate(edges, axis=1)[..., ::-1] * (1.0, -1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        level = np.nan_to_num(level / np.linalg.norm(level, axis=2)[..., None])
    upright = np.zeros((len(one), level.shape[1] + 1, 3))
    upright[:, :-1, :2], upright[:, -1, 2] = level, 1.0
    return _gaps(*(part @ np.swapaxes(upright, 1, 2) for part in (one, other)))


def _gaps(here: np.ndarray, there: np.ndarray) -> np.ndarray:
    """The largest gap between shadows ``(n, corners, lines)`` of two polygons, ``(n,)``."""
    gaps = np.maximum(there.min(1) - here.max(1), here.min(1) - there.max(1))
    return np.asarray(gaps.max(axis=1))


def _segment_distance(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Least distance of any edge of one to any edge of the other, shape ``(n,)``."""
    p, d = one[:, :, None], (np.roll(one, -1, axis=1) - one)[:, :, None]
    q, e = other[:, None], (np.roll(other, -1, axis=1) - other)[:, None]
    r = p - q
    dd, ee, de = (d * d).sum(-1), (e * e).sum(-1), (d * e).sum(-1)
    dr, er = (d * r).sum(-1), (e * r).sum(-1)
    across = dd * ee - de**2
    with np.errstate(divide="ignore", invalid="ignore"):
        # Parallel edges: any point of the first will do, the second's is found for it.
        s = np.where(across > TOLERANCES.parallel * dd * ee, (de * er - dr * ee) / across, 0.0)
    s = np.clip(s, 0.0, 1.0)
    t = np.clip((de * s + er) / ee, 0.0, 1.0)
    s = np.clip((de * t - dr) / dd, 0.0, 1.0)
    gap = r + d * s[..., None] - e * t[..., None]
    return np.asarray(np.sqrt((gap**2).sum(-1)).min(axis=(1, 2)))


def _corners_to_area(points: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Least distance of corners to another area, where its edges don't decide, ``(n,)``.

    Zero if an edge between two of the corners passes through the area, infinite if no
    corner lies above or below it.
    """
    edge = area[:, 1] - area[:, 0]
    # The normal of a polygon that may have notches is the sum over its corners.
    normal = np.cross(area, np.roll(area, -1, axis=1)).sum(axis=1)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    across = edge / np.linalg.norm(edge, axis=1)[:, None]
    axes = np.stack([across, np.cross(normal, across)], axis=1)
    from_here = points - area[:, :1]
    height = np.einsum("npi,ni->np", from_here, normal)
    flat = np.einsum("npi,nji->npj", from_here, axes)
    outline = np.einsum("npi,nji->npj", area - area[:, :1], axes)
    above = np.where(_inside(flat, outline), np.abs(height), np.inf).min(axis=1)
    following, next_flat = np.roll(height, -1, axis=1), np.roll(flat, -1, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(height != following, height / (height - following), 0.0)
    passes = flat + share[..., None] * (next_flat - flat)
    pierced = (height * following < 0) & _inside(passes, outline)
    return np.where(pierced.any(axis=1), 0.0, above)


def _inside(points: np.ndarray, outline: np.ndarray) -> np.ndarray:
    """Whether points ``(n, p, 2)`` lie in polygons ``(n, corners, 2)``: ``(n, p)``."""
    x, y = points[:, :, None, 0], points[:, :, None, 1]
    (x_0, y_0), (x_1, y_1) = (
        np.moveaxis(corners[:, None], -1, 0) for corners in (outline, np.roll(outline, -1, axis=1))
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = ((y_0 > y) != (y_1 > y)) & (x < x_0 + (y - y_0) * (x_1 - x_0) / (y_1 - y_0))
    return np.asarray(crossing.sum(axis=2) % 2 == 1)
