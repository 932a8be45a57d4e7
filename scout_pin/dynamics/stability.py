"""Zero-moment point, support polygon and how far inside it the point lies.

Source: Scout thesis, section 6.2, equation (6.1).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.contacts import stability as contacts
from thesis_pin.contacts.feet import support_margins, support_polygons
from thesis_pin.contacts.stability import momentum as momentum
from thesis_pin.contacts.stability import zero_moment_point as zero_moment_point
from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance


def pressure_point(motion: GaitMotion, wrench: ArrayLike) -> np.ndarray:
    """Centre of pressure of all floor wrenches together: the ZMP by another route.

    Args:
        motion: The sampled gait.
        wrench: Floor's wrench on each foot, world axes, about p_i, shape ``(n, 2, 6)``.

    Returns:
        Point on the floor [m], shape ``(n, 2)``.

    Raises:
        NoSupportForce: The floor doesn't push at some sample.
    """
    instance("motion", motion, GaitMotion, "Gait.sample()")
    feet = np.stack([motion.left_foot.position, motion.right_foot.position], axis=1)
    return contacts.pressure_point(feet, wrench)


def support_margin(robot: Scout, motion: GaitMotion, points: ArrayLike) -> np.ndarray:
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
    found = finite_array("points", points, None, 2)
    if found.shape != (len(motion.time), 2):
        raise WrongShape("points", found.shape, f"({len(motion.time)}, 2), as motion")
    return support_margins(polygons(robot, motion), found)


def polygons(robot: Scout, motion: GaitMotion) -> list[tuple[np.ndarray, np.ndarray]]:
    """Support polygons of a motion, each with the samples it holds for.

    See :func:`thesis_pin.contacts.feet.support_polygons`.
    """
    outlines = [np.array(robot.specification.leg(side).sole) for side in SIDES]
    return support_polygons(motion.support, (motion.left_foot, motion.right_foot), outlines)
