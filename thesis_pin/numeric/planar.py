"""Convex polygons in the plane: few points, for which SciPy's Qhull and GEOS cost their import."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from thesis_pin.tolerances import TOLERANCES

_FEW = 200
"""Corners whose edges are all held against each other."""


def convex_hull(points: np.ndarray) -> np.ndarray:
    """Which points are corners of the convex hull, counter-clockwise.

    Points on an edge between two corners, to rounding, are none.

    Args:
        points: Shape ``(n, 2)``; they span an area.

    Returns:
        Their numbers, shape ``(h,)``; the lowest of the leftmost points first.

    Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions",
    Information Processing Letters 9 (1979).
    """
    x, y = points.T.tolist()
    order = sorted(range(len(points)), key=lambda k: (x[k], y[k]))
    size = float(np.ptp(points, axis=0).max())
    flat = TOLERANCES.parallel * size

    def chain(numbers: list[int]) -> list[int]:
        kept: list[int] = []
        for k in numbers:
            while len(kept) > 1:
                (i, j) = kept[-2:]
                along = (x[k] - x[i], y[k] - y[i])
                turn = (x[j] - x[i]) * along[1] - (y[j] - y[i]) * along[0]
                if turn > flat * max(abs(along[0]), abs(along[1])):
                    break
                kept.pop()
            kept.append(k)
        return kept[:-1]

    return np.array(chain(order) + chain(order[::-1]), dtype=np.intp)


def depth(polygon: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Distance of points from a convex polygon's border, negative outside.

    Args:
        polygon: Corners, counter-clockwise, shape ``(h, 2)``.
        points: Shape ``(n, 2)``.

    Returns:
        Shape ``(n,)``.
    """
    squared = np.full(len(points), np.inf)
    inside = np.ones(len(points), dtype=bool)
    for corner, after in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        edge, from_corner = after - corner, points - corner
        share = np.clip(from_corner @ edge / (edge @ edge), 0.0, 1.0)
        off_x = from_corner[:, 0] - share * edge[0]
        off_y = from_corner[:, 1] - share * edge[1]
        np.minimum(squared, off_x**2 + off_y**2, out=squared)
        inside &= edge[0] * from_corner[:, 1] - edge[1] * from_corner[:, 0] > 0
    distance = np.sqrt(squared)
    return np.asarray(np.where(inside, distance, -distance))


def clearly_simple(polygon: Sequence[tuple[float, float]]) -> bool:
    """Whether a polygon's border clearly neither crosses nor touches itself.

    Args:
        polygon: Corners in order.

    Returns:
        False also where only exact arithmetic could tell, and for very many corners.
    """
    count = len(polygon)
    if not 3 <= count <= _FEW:
        return False
    points = np.array(polygon)
    after = np.roll(points, -1, axis=0)
    start, along, size = points, after - points, float(np.ptp(points, axis=0).max())
    tiny = TOLERANCES.parallel * size**2
    low, high = np.minimum(start, after), np.maximum(start, after)
    boxes = (low[:, None] > high[None] + TOLERANCES.parallel * size).any(axis=2)
    # On which side of each edge's line every corner lies, as twice an area, (edges, corners).
    off = points[None] - start[:, None]
    side = along[:, None, 0] * off[..., 1] - along[:, None, 1] * off[..., 0]
    ahead = np.roll(side, -1, axis=1)
    same = ((side > tiny) & (ahead > tiny)) | ((side < -tiny) & (ahead < -tiny))
    turn = side[np.arange(count), (np.arange(count) + 2) % count]
    onwards = (along * np.roll(along, -1, axis=0)).sum(axis=1) > 0
    gap = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
    beside = (gap <= 1) | (gap == count - 1)
    area = float((points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]).sum())
    return bool(
        (boxes | boxes.T | same | same.T | beside).all()
        and ((np.abs(turn) > tiny) | onwards).all()
        and abs(area) > tiny
        and (np.abs(along).max(axis=1) > 0).all()
    )
