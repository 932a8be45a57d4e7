"""The neutral pose as a scene: the robot at rest, every servo in its middle."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from scout_pin.model import Scout
from scout_pin.report.drawn.view import BLACK, robot_colours
from scout_pin.specification import SIDES
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.scene import Arrow, Ball, Group, Scene
from thesis_pin.report.curves import ORANGE, SKY


def neutral_scene(robot: Scout) -> Scene:
    """A biped in its neutral pose, its lowest sole on the floor.

    Args:
        robot: The biped.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    rest = standing(robot)
    q = np.tile(rest, (2, 1))
    com = np.tile(_centre(robot) + rest[:3], (2, 1))
    size = max(float(com[0, 2]), 1e-3) / 0.11
    floor = com * (1.0, 1.0, 0.0)
    name = robot.specification.name
    return Scene(
        title=f"{name.capitalize()}, neutral pose",
        description=f"The biped {name} in its neutral pose, every servo in its middle.",
        time=np.array([0.0, 1.0]),
        groups=(
            Group("robot", "robot", ((SKY, "left leg"), (ORANGE, "right leg"))),
            Group("soles", "soles"),
            Group("com", "centre of mass and its floor projection", ((BLACK, ""),)),
        ),
        items=(
            *robot_colours(robot, q),
            Ball("com", "com", com, 4e-3 * size, (BLACK,)),
            Arrow("com_drop", "com", com, floor - com, 1.0, 4e-4 * size, BLACK, head=False),
            Ball("com_floor", "com", floor, 2.5e-3 * size, (BLACK,)),
        ),
        readouts=(),
    )


def standing(robot: Scout) -> np.ndarray:
    """The neutral configuration on a free flyer, the lowest sole on the floor, shape ``(19,)``."""
    feet = robot.neutral_feet()
    lowest = min(float(robot.sole_vertices(side, feet[side])[:, 2].min()) for side in SIDES)
    return np.concatenate([[0.0, 0.0, -lowest, 0.0, 0.0, 0.0, 1.0], np.zeros(12)])


def _centre(robot: Scout) -> np.ndarray:
    """Centre of mass in the torso's frame in the neutral pose [m], shape ``(3,)``."""
    q = robot.configuration(np.eye(4), np.zeros(12))
    return np.array(pin.centerOfMass(robot.model, robot.model.createData(), q))
