"""Feet on the floor: corners of soles, and the polygons that standing soles span."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from thesis_pin.contacts.stability import signed_margin, support_polygon
from thesis_pin.numeric.alike import alike
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import BodyMotion


def sole_corners(outline: np.ndarray, placement: np.ndarray) -> np.ndarray:
    """Corners of a sole in the world [m].

    Args:
        outline: Corners in the sole's frame [m], shape ``(corners, 2)``.
        placement: Sole in the world, shape ``(..., 4, 4)``.

    Returns:
        Shape ``(..., corners, 3)``.
    """
    # Written out: einsum takes ten times as long.
    x, y = outline[:, 0, None], outline[:, 1, None]
    turned = placement[..., None, :3, 0] * x + placement[..., None, :3, 1] * y
    return np.asarray(turned + placement[..., None, :3, 3])


def support_polygons(
    support: np.ndarray, feet: Sequence[BodyMotion], outlines: Sequence[np.ndarray]
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Support polygons of a motion, each with the samples it holds for.

    Feet in support don't move, so a polygon is made once for each stance.

    Args:
        support: Feet in support, at least one a sample, booleans ``(n, feet)``.
        feet: Motion of each sole in the world.
        outlines: Corners of each sole in its frame [m], shape ``(corners, 2)``.

    Returns:
        Samples ``(m,)`` and corners, counter-clockwise [m], ``(h, 2)``, of each stance.
    """
    result = []
    for sample, rows in alike(
        len(support),
        lambda part: _stances(support[part], [foot.part(part).placement for foot in feet]),
    ):
        here = [foot.part(slice(sample, sample + 1)).placement[0] for foot in feet]
        standing = np.flatnonzero(support[sample])
        soles = [sole_corners(outlines[int(s)], here[int(s)]) for s in standing]
        result.append((rows, support_polygon(*soles)))
    return result


def _stances(support: np.ndarray, placements: Sequence[np.ndarray]) -> np.ndarray:
    """What tells stances apart, ``(n, 7 × feet)``: which feet stand, and where those do."""
    keys = np.zeros((len(support), len(placements), 7))
    for k, place in enumerate(placements):
        rows = place[:, [0, 0, 1, 1, 0, 1], [0, 1, 0, 1, 3, 3]]
        keys[:, k, 0] = support[:, k]
        keys[:, k, 1:] = np.where(support[:, k, None], rows, 0.0)
    return np.asarray(keys.reshape(len(support), -1).round(9))


def support_margins(
    polygons: Sequence[tuple[np.ndarray, np.ndarray]], points: np.ndarray
) -> np.ndarray:
    """Signed margins [m] of points ``(n, 2)`` to the polygon of each sample, shape ``(n,)``."""
    margins = np.empty(len(points))
    for samples, polygon in polygons:
        for part in blocks(len(samples)):
            margins[samples[part]] = signed_margin(polygon, points[samples[part]])
    return margins
