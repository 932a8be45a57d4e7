"""Zero-moment point, support polygon and how far inside it the point lies.

Source: Scout thesis, section 6.2, equation (6.1).
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from scout_pin.coordinates import free_flyer_state
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.contacts import stability as contacts
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.contacts.feet import support_margins, support_polygons
from thesis_pin.contacts.stability import momentum as momentum
from thesis_pin.contacts.stability import zero_moment_point as zero_moment_point
from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.numeric.vectors import cross, rows
from thesis_pin.tolerances import GRAVITY


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


def centre_of_mass(robot: Scout, motion: GaitMotion, joints: JointTrajectory) -> np.ndarray:
    """Centre of mass at each sample [m], shape ``(n, 3)``.

    Args:
        robot: The biped, with a free-flyer root.
        motion: The sampled gait.
        joints: Its joint trajectory.
    """
    model, data = robot.model, robot.model.createData()
    com = np.empty((len(motion.t), 3))
    for part in blocks(len(com)):
        q = free_flyer_state(motion.torso.part(part), joints.part(part))[0]
        for k, configuration in enumerate(q, part.start):
            com[k] = pin.centerOfMass(model, data, configuration)
    return com


def planned_zmp(robot: Scout, motion: GaitMotion, dynamics: ContactDynamics) -> np.ndarray:
    """Zero-moment point of a motion [m], shape ``(n, 2)``.

    (6.1) asks for the momentum's rate less gravity, which the floor supplies: its whole wrench
    about the world's origin says the same without another run through all bodies.

    Args:
        robot: The biped.
        motion: The sampled gait.
        dynamics: Its floor wrenches.

    Raises:
        NoSupportForce: The floor would have to pull.

    Source: Scout thesis, section 6.2, equation (6.1).
    """
    zmp = np.empty((len(motion.t), 2))
    weight = robot.mass * GRAVITY
    for part in blocks(len(zmp)):
        rate = np.zeros((6, part.stop - part.start))
        for k, foot in enumerate((motion.left_foot, motion.right_foot)):
            wrench = rows(dynamics.wrench[part, k])
            rate[:3] += wrench[:3]
            rate[3:] += wrench[3:] + cross(rows(foot.part(part).position), wrench[:3])
        rate[2] -= weight
        nothing = np.zeros((rate.shape[1], 3))
        zmp[part] = zero_moment_point(robot.mass, nothing, rate.T, first=part.start)
    return zmp


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
