"""Feet on the floor: corners of soles, and the polygons that standing soles span."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from thesis_pin.contacts.stability import signed_margin, support_polygon


def sole_corners(outline: np.ndarray, placement: np.ndarray) -> np.ndarray:
    """Corners of a sole in the world [m].

    Args:
        outline: Corners in the sole's frame [m], shape ``(corners, 2)``.
        placement: Sole in the world, shape ``(..., 4, 4)``.

    Returns:
        Shape ``(..., corners, 3)``.
    """
    turned = np.einsum("...ij,kj->...ki", placement[..., :3, :2], outline)
    return np.asarray(turned + placement[..., None, :3, 3])


def support_polygons(
    support: np.ndarray, placements: Sequence[np.ndarray], outlines: Sequence[np.ndarray]
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Support polygons of a motion, each with the samples it holds for.

    Feet in support don't move, so a polygon is made once for each stance.

    Args:
        support: Feet in support, at least one a sample, booleans ``(n, feet)``.
        placements: Each sole in the world, shape ``(n, 4, 4)``.
        outlines: Corners of each sole in its frame [m], shape ``(corners, 2)``.

    Returns:
        Samples ``(m,)`` and corners, counter-clockwise [m], ``(h, 2)``, of each stance.
    """
    keys = np.zeros((len(support), len(placements), 7))
    for k, place in enumerate(placements):
        rows = place[:, [0, 0, 1, 1, 0, 1], [0, 1, 0, 1, 3, 3]]
        keys[:, k, 0] = support[:, k]
        keys[:, k, 1:] = np.where(support[:, k, None], rows, 0.0)
    flat = keys.reshape(len(support), -1).round(9)
    _, first, inverse = np.unique(flat, axis=0, return_index=True, return_inverse=True)
    result = []
    for number, sample in enumerate(first):
        standing = np.flatnonzero(support[sample])
        soles = [sole_corners(outlines[int(k)], placements[int(k)][sample]) for k in standing]
        result.append((np.flatnonzero(inverse.ravel() == number), support_polygon(*soles)))
    return result


def support_margins(
    polygons: Sequence[tuple[np.ndarray, np.ndarray]], points: np.ndarray
) -> np.ndarray:
    """Signed margins [m] of points ``(n, 2)`` to the polygon of each sample, shape ``(n,)``."""
    margins = np.empty(len(points))
    for samples, polygon in polygons:
        margins[samples] = signed_margin(polygon, points[samples])
    return margins
