"""Zero-moment point, support polygon and how far inside it the point lies.

Source: Scout thesis, section 6.2, equation (6.1).
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from thesis_pin.contacts.stability import signed_margin, support_polygon
from thesis_pin.contacts.stability import zero_moment_point as zero_moment_point
from thesis_pin.errors import NoSupportForce, WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance


def pressure_point(motion: GaitMotion, wrench: np.ndarray) -> np.ndarray:
    """Centre of pressure of all floor wrenches together: the ZMP by another route.

    Args:
        motion: The sampled gait.
        wrench: Floor's wrench on each foot, world axes, about p_i, shape ``(n, 2, 6)``.

    Returns:
        Point on the floor [m], shape ``(n, 2)``.

    Raises:
        NoSupportForce: The floor doesn't push at some sample.
    """
    wrench = finite_array("wrench", wrench, None, 2, 6)
    instance("motion", motion, GaitMotion, "Gait.sample()")
    feet = np.stack([motion.left_foot.position, motion.right_foot.position], axis=1)
    force = wrench[..., :3].sum(axis=1)
    moment = (wrench[..., 3:] + np.cross(feet, wrench[..., :3])).sum(axis=1)
    if (force[:, 2] <= 0).any():
        k = int(np.argmax(force[:, 2] <= 0))
        raise NoSupportForce("the floor doesn't push", where=f"sample {k}")
    return np.stack([-moment[:, 1], moment[:, 0]], axis=1) / force[:, 2:]


def momentum(
    robot: Scout, q: np.ndarray, v: np.ndarray, a: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Centre of mass and momentum rate about the world origin, by Pinocchio.

    Args:
        robot: The biped.
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


def support_margin(robot: Scout, motion: GaitMotion, points: np.ndarray) -> np.ndarray:
    """Signed margin of points to the support polygon of each sample.

    Args:
        robot: The biped.
        motion: The sampled gait; its feet in support carry the polygon.
        points: Zero-moment points [m], shape ``(n, 2)``.

    Returns:
        Margins [m], positive inside, shape ``(n,)``.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    instance("motion", motion, GaitMotion, "Gait.sample()")
    points = finite_array("points", points, None, 2)
    if points.shape != (len(motion.time), 2):
        raise WrongShape("points", points.shape, f"({len(motion.time)}, 2), as motion")
    margins = np.empty(len(points))
    feet = {"left": motion.left_foot.placement, "right": motion.right_foot.placement}
    for samples, polygon in polygons(robot, motion, feet):
        margins[samples] = signed_margin(polygon, points[samples])
    return margins


def polygons(
    robot: Scout, motion: GaitMotion, feet: dict[str, np.ndarray]
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Support polygons of a motion, each with the samples it holds for.

    Feet in support don't move, so a polygon is made once for each stance.
    """
    keys = np.zeros((len(motion.t), 14))
    for k, side in enumerate(("left", "right")):
        place = feet[side][:, [0, 0, 1, 1, 0, 1], [0, 1, 0, 1, 3, 3]]
        keys[:, 7 * k] = motion.support[:, k]
        keys[:, 7 * k + 1 : 7 * k + 7] = np.where(motion.support[:, k, None], place, 0.0)
    _, first, inverse = np.unique(keys.round(9), axis=0, return_index=True, return_inverse=True)
    result = []
    for number, sample in enumerate(first):
        soles = [
            robot.sole_vertices(side, feet[side][sample])
            for k, side in enumerate(("left", "right"))
            if motion.support[sample, k]
        ]
        result.append((np.flatnonzero(inverse.ravel() == number), support_polygon(*soles)))
    return result
