"""Zero-moment point, and how far inside the support polygon a point lies.

Source: Scout thesis, section 6.2, equation (6.1).
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from thesis_pin.contacts.cones import corners
from thesis_pin.errors import BadInput, NoSupportForce
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import real
from thesis_pin.numeric.planar import convex_hull, depth
from thesis_pin.tolerances import GRAVITY


def zero_moment_point(
    mass: float,
    com: np.ndarray,
    momentum_rate: np.ndarray,
    ground_height: float = 0.0,
    *,
    first: int = 0,
) -> np.ndarray:
    """Zero-moment point on a horizontal floor.

    Args:
        mass: Total mass [kg].
        com: Centre of mass in the world frame [m], shape ``(..., 3)``.
        momentum_rate: Time derivative of linear then angular momentum about
            the world origin [N], [N·m], shape ``(..., 6)``.
        ground_height: Height of the floor [m].
        first: Number of the first sample, for messages.

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
            where=f"sample {first + k}",
            remedy="The motion falls faster than gravity: slow it down (a larger time unit)",
        )
    x = (weight * com[..., 0] + ground_height * rate[..., 0] - rate[..., 4]) / normal
    y = (weight * com[..., 1] + ground_height * rate[..., 1] + rate[..., 3]) / normal
    return np.stack([x, y], axis=-1)


def pressure_point(feet: ArrayLike, wrench: ArrayLike) -> np.ndarray:
    """Centre of pressure of all floor wrenches together: the ZMP by another route.

    Args:
        feet: Origins of the soles in the world [m], shape ``(n, feet, 3)``.
        wrench: Floor's wrench on each foot, world axes, about its origin, ``(n, feet, 6)``.

    Returns:
        Point on the floor [m], shape ``(n, 2)``.

    Raises:
        NoSupportForce: The floor doesn't push at some sample.
    """
    load = finite_array("wrench", wrench, None, None, 6)
    places = finite_array("feet", feet, *load.shape[:2], 3)
    force = load[..., :3].sum(axis=1)
    moment = (load[..., 3:] + np.cross(places, load[..., :3])).sum(axis=1)
    if (force[:, 2] <= 0).any():
        k = int(np.argmax(force[:, 2] <= 0))
        raise NoSupportForce("the floor doesn't push", where=f"sample {k}")
    return np.asarray(np.stack([-moment[:, 1], moment[:, 0]], axis=1) / force[:, 2:])


def momentum(
    robot: LoadedRobot, q: np.ndarray, v: np.ndarray, a: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Centre of mass and momentum rate about the world origin, by Pinocchio.

    Args:
        robot: Any robot, its base included.
        q: Configurations, shape ``(n, nq)``.
        v: Velocities, shape ``(n, nv)``.
        a: Accelerations, shape ``(n, nv)``.

    Returns:
        Centre of mass [m] ``(n, 3)`` and rate of linear, then angular momentum
        about the world origin ``(n, 6)``.
    """
    model, data = robot.model, robot.model.createData()
    com, rate = np.empty((len(q), 3)), np.empty((len(q), 6))
    for k in range(len(q)):
        pin.computeCentroidalMomentumTimeVariation(model, data, q[k], v[k], a[k])
        com[k] = data.com[0]
        rate[k] = data.dhg.vector
    rate[:, 3:] += np.cross(com, rate[:, :3])
    return com, rate


def signed_margin(polygon: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Distance of points from a convex polygon's border [m], negative outside.

    Args:
        polygon: Corners, counter-clockwise [m], shape ``(h, 2)``.
        points: Shape ``(n, 2)``.
    """
    return depth(polygon, points)


def support_polygon(*soles: ArrayLike) -> np.ndarray:
    """Convex hull of soles on the floor.

    Args:
        *soles: Corners of each sole in contact, world x and y [m], ``(n, 2)`` or ``(n, 3)``.

    Returns:
        Corners, counter-clockwise [m], shape ``(h, 2)``.

    Source: Scout thesis, section 6.2.
    """
    if not soles:
        raise BadInput("there is no sole", allowed="the corners of at least one")
    points = np.concatenate([corners("sole", sole)[:, :2] for sole in soles])
    return np.asarray(points[convex_hull(points)])
