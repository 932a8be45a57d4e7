"""The stage of a scene in meshcat: where its camera stands, its floor, a quiet background."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from meshcat import Visualizer
from meshcat.geometry import LineSegments
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from thesis_pin.pages.meshcat.lines import grid
from thesis_pin.pages.scene import Bars, Item, Polygon, Shape

Array = NDArray[np.float64]

BACKGROUND = [0.957, 0.965, 0.973]
SMALLEST = 0.05
"""Size [m] that the smallest scene is taken to have."""

_VIEW, _CELLS = 40.0, 40


def box_of(items: Iterable[Item]) -> Array:
    """Least and largest corner of where things are, shape ``(2, 3)``; arrows are left out."""
    corners = [corner for item in items for corner in _corners(item)]
    found = np.concatenate(corners) if corners else np.zeros((1, 3))
    return np.array([found.min(axis=0), found.max(axis=0)])


def _corners(item: Item) -> Iterator[Array]:
    """Points that an item never leaves the box about, each ``(k, 3)``."""
    if isinstance(item, Shape):
        where = np.asarray(item.placement, dtype=float)
        where = where[np.isfinite(where).all(axis=1) & where[:, 3:].any(axis=1)]
        if len(where):
            turns = Rotation.from_quat(where[:, 3:]).as_matrix()
            turned = np.einsum("nij,kj->nki", turns, item.corners())
            yield (where[:, None, :3] + turned).reshape(-1, 3)
        return
    if isinstance(item, Bars) and len(item.ends):
        yield np.asarray(item.ends, dtype=float).reshape(-1, 3)
    if isinstance(item, Polygon):
        yield from (np.asarray(outline, dtype=float) for outline in item.outlines)
    for name, values in item.arrays().items():
        if name in ("placement", "position", "origin", "points"):
            points = np.asarray(values, dtype=float)[:, :3]
            points = points[np.isfinite(points).all(axis=1)]
            if len(points):
                yield np.array([points.min(axis=0), points.max(axis=0)])


def size_of_box(box: Array) -> float:
    """Its diagonal [m], or :data:`SMALLEST`."""
    return max(float(np.linalg.norm(box[1] - box[0])), SMALLEST)


def dress(
    drawn: Visualizer,
    box: Array,
    forward: tuple[float, float] = (1.0, 0.0),
    camera: ArrayLike | None = None,
) -> None:
    """A quiet stage, and a camera that looks at the scene: on a server of our own.

    Args:
        drawn: The server's visualizer.
        box: Corners of what is to be seen, shape ``(2, 3)``.
        forward: The way ahead on the floor.
        camera: Camera and the point it looks at, shape ``(2, 3)``; None stands to the right of
            the box, ahead of it and above.
    """
    for name in ("top_color", "bottom_color"):
        drawn["/Background"].set_property(name, BACKGROUND)
    # Drawn in software, meshcat's background takes a third of every frame: our page has the colour.
    for name in ("/Background", "/Grid", "/Axes"):
        drawn[name].set_property("visible", False)
    middle, size = box.mean(axis=0), size_of_box(box)
    if camera is not None:
        eye, middle = np.asarray(camera, dtype=float)
    else:
        x, y = forward
        way = np.array([y + 1.1 * x, -x + 1.1 * y, 0.55])
        eye = middle + 1.65 * size * way / np.linalg.norm(way)
    seen = drawn["/Cameras/default/rotated/<object>"]
    for name, value in (("fov", _VIEW), ("near", size / 500), ("far", 200 * size)):
        seen.set_property(name, value)
    seen.set_property("position", [float(eye[0]), float(eye[2]), float(-eye[1])])
    seen.set_property("target", middle.tolist())


def floor_grid(height: float, box: Array) -> LineSegments:
    """Lines on a floor about a box.

    Args:
        height: Of the floor [m].
        box: Corners of what stands on it, shape ``(2, 3)``.
    """
    wide = 3 * size_of_box(box)
    power = 10.0 ** np.floor(np.log10(wide / _CELLS))
    spacing = next(n * power for n in (1, 2, 5, 10) if wide / (n * power) <= _CELLS)
    return grid(wide, spacing, box.mean(axis=0)[:2], height)
