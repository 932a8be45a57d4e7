"""Zero-moment point, centre of pressure, support polygon and margins on any floor.

On a slope the zero-moment point is where the wrench's moment is along the floor's normal; on a
level floor that is the thesis's. Where feet stand at several heights the polygon is that of
their shadows on the floor, and tells less: the contacts' cones decide.

Source: Scout thesis, section 6.2, equation (6.1); Vukobratović, Borovac, "Zero-moment point:
thirty five years of its life", Int. J. Humanoid Robotics 1 (2004).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.outlines import hull
from thesis_pin.contacts.stability import signed_margin
from thesis_pin.numeric.alike import alike

Array = NDArray[np.float64]
Polygons = list[tuple[NDArray[np.intp], Array]]

_ALIKE = 9  # decimals [m] to which corners of one stance agree


def zero_moment_points(floor: Floor, wrench: Array) -> Array:
    """Points of the floor at which wrenches have no moment along it.

    Args:
        floor: The floor.
        wrench: Force and moment about the world's origin, world axes, shape ``(n, 6)``.

    Returns:
        Points in the world [m], shape ``(n, 3)``; NaN where the wrench doesn't press.
    """
    normal, force = floor.normal, wrench[:, :3]
    moment = wrench[:, 3:] - np.cross(floor.origin, force)
    press = force @ normal
    press = np.where(press > 0, press, np.nan)
    return np.asarray(floor.origin + np.cross(normal, moment) / press[:, None])


def centre_of_pressure(floor: Floor, origins: Array, wrench: Array) -> Array:
    """The same of contact wrenches about several points.

    Args:
        floor: The floor.
        origins: The points [m], shape ``(n, feet, 3)``.
        wrench: Force and moment about each, world axes, ``(n, feet, 6)``.
    """
    force = wrench[..., :3].sum(axis=1)
    moment = (wrench[..., 3:] + np.cross(origins, wrench[..., :3])).sum(axis=1)
    return zero_moment_points(floor, np.concatenate([force, moment], axis=1))


def flat_corners(floor: Floor, corners: Sequence[Array], support: NDArray[np.bool_]) -> Polygons:
    """Support polygons of a motion, each with the samples it holds for.

    Args:
        floor: The floor.
        corners: Of each foot [m], ``(n, k, 3)``.
        support: Which feet bear load, shape ``(n, feet)``.

    Returns:
        Samples ``(m,)`` and corners in the floor's axes [m], counter-clockwise, ``(h, 2)``; two
        where they lie in line, one, or none.
    """

    def keys(part: slice) -> Array:
        stands = support[part]
        flat = [floor.flat(points[part]).round(_ALIKE) + 0.0 for points in corners]
        each = [
            np.where(stands[:, k, None, None], points, 0.0).reshape(len(stands), -1)
            for k, points in enumerate(flat)
        ]
        return np.concatenate([*each, stands], axis=1)

    found = []
    for sample, rows in alike(len(support), keys):
        on = np.flatnonzero(support[sample]).tolist()
        points = [np.zeros((0, 2)), *(floor.flat(corners[k][sample]) for k in on)]
        found.append((rows, hull(np.concatenate(points))))
    return found


def margins(floor: Floor, points: Array, polygons: Polygons) -> Array:
    """How far points of the floor are inside support polygons [m], shape ``(n,)``.

    Args:
        floor: The floor.
        points: In the world [m], shape ``(n, 3)``.
        polygons: See :func:`flat_corners`.
    """
    found = np.full(len(points), -np.inf)
    for rows, polygon in polygons:
        rows = rows[np.isfinite(points[rows]).all(axis=1)]
        flat = floor.flat(points[rows])
        if len(polygon) > 2:
            found[rows] = signed_margin(polygon, flat)
        elif len(polygon):
            found[rows] = -_to_segment(polygon[0], polygon[-1], flat)
    return found


def _to_segment(start: Array, end: Array, points: Array) -> Array:
    """Distance of points ``(n, 2)`` from a stretch of a line [m]."""
    way = end - start
    size = float(way @ way)
    share = np.clip((points - start) @ way / size, 0.0, 1.0) if size > 0 else np.zeros(len(points))
    return np.asarray(np.linalg.norm(points - start - share[:, None] * way, axis=1))
