"""Zero-moment point, and how far inside the support polygon a point lies.

Source: Scout thesis, section 6.2, equation (6.1).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.contacts.cones import corners
from thesis_pin.errors import BadInput, NoSupportForce
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import real

GRAVITY = 9.81
"""Pinocchio's default, [m/s²]."""


def zero_moment_point(
    mass: float,
    com: np.ndarray,
    momentum_rate: np.ndarray,
    ground_height: float = 0.0,
) -> np.ndarray:
    """Zero-moment point on a horizontal floor.

    Args:
        mass: Total mass [kg].
        com: Centre of mass in the world frame [m], shape ``(..., 3)``.
        momentum_rate: Time derivative of linear then angular momentum about
            the world origin [N], [N·m], shape ``(..., 6)``.
        ground_height: Height of the floor [m].

    Returns:
        Point on the floor [m], shape ``(..., 2)``.

    Raises:
        NoSupportForce: The vertical force is not positive, so no ZMP exists.

    Source: Scout thesis, section 6.2, equation (6.1).
    """
    mass = real("mass", mass, low=0.0, unit="kg")
    ground_height = real("ground_height", ground_height, unit="m")
    com = finite_array("com", com, 3)
    rate = finite_array("momentum_rate", momentum_rate, 6)
    weight = mass * GRAVITY
    normal = weight + rate[..., 2]
    if (normal <= 0).any():
        k = int(np.argmax(np.atleast_1d(normal <= 0)))
        raise NoSupportForce(
            f"the floor would have to pull with {-float(np.atleast_1d(normal)[k]):.3g} N",
            where=f"sample {k}",
            remedy="The motion falls faster than gravity: slow it down (a larger time unit)",
        )
    x = (weight * com[..., 0] + ground_height * rate[..., 0] - rate[..., 4]) / normal
    y = (weight * com[..., 1] + ground_height * rate[..., 1] + rate[..., 3]) / normal
    return np.stack([x, y], axis=-1)


def signed_margin(polygon: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Distance of points from a convex polygon's border [m], negative outside.

    Args:
        polygon: Corners, counter-clockwise [m], shape ``(h, 2)``.
        points: Shape ``(n, 2)``.
    """
    import shapely

    border = shapely.LinearRing(polygon)
    place = shapely.points(points)
    distance = shapely.distance(border, place)
    return np.where(shapely.contains(shapely.Polygon(polygon), place), distance, -distance)


def support_polygon(*soles: ArrayLike) -> np.ndarray:
    """Convex hull of soles on the floor.

    Args:
        *soles: Corners of each sole in contact, world x and y [m], ``(n, 2)`` or ``(n, 3)``.

    Returns:
        Corners, counter-clockwise [m], shape ``(h, 2)``.

    Source: Scout thesis, section 6.2.
    """
    from scipy.spatial import ConvexHull

    if not soles:
        raise BadInput("there is no sole", allowed="the corners of at least one")
    points = np.concatenate([corners("sole", sole)[:, :2] for sole in soles])
    return points[ConvexHull(points).vertices]
