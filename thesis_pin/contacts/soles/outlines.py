"""Outlines of soles in their plane: hulls, areas, and fewer corners."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

MOST_CORNERS = 8
"""Of a sole: more make its wrench cone slow, and add no area worth it."""


def hull(points: Array) -> Array:
    """Convex hull of points ``(k, 2)``: counter-clockwise corners, the ends of a line, a point."""
    if not len(points):
        return points
    around = points - points.mean(axis=0)
    _, sizes, axes = np.linalg.svd(around, full_matrices=False)
    if sizes[0] == 0:
        return points[:1]
    if len(sizes) < 2 or sizes[1] <= TOLERANCES.rank * sizes[0]:
        along = around @ axes[0]
        return points[[int(along.argmin()), int(along.argmax())]]
    from scipy.spatial import ConvexHull

    return np.asarray(points[ConvexHull(points).vertices])


def simplified(outline: Array) -> tuple[Array, float]:
    """At most :data:`MOST_CORNERS` of a convex outline's corners, and the share of area lost."""
    whole = area(outline)
    while len(outline) > MOST_CORNERS:
        before, after = np.roll(outline, 1, axis=0), np.roll(outline, -1, axis=0)
        one, other = outline - before, after - outline
        cut = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
        outline = np.delete(outline, int(cut.argmin()), axis=0)
    return outline, 1.0 - area(outline) / whole


def area(outline: Array) -> float:
    """Area of a convex outline [m²]."""
    x, y = outline.T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)
