"""The biped in meshcat, configuration by configuration, with what its balance depends on."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from scout_pin.model import Scout
from scout_pin.report.drawn.view import BLACK, SEEN_THROUGH, colour_of_body, is_sole
from scout_pin.specification import SIDES
from thesis_pin.contacts.stability import support_polygon
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.meshcat.robot import RobotViewer
from thesis_pin.pages.scene import Arrow, Ball, Item, Polygon
from thesis_pin.report.curves import BLUE
from thesis_pin.tolerances import TOLERANCES


def viewer(robot: Scout, url: str | None = None) -> RobotViewer:
    """A biped in meshcat, ready for ``display(q)``; it stands in its neutral pose at first.

    Beside its bodies: the centre of mass, its projection on the floor z = 0, and the support
    polygon of the soles that lie on it.

    Args:
        robot: The biped.
        url: Address of a running server, as ``tcp://127.0.0.1:6000``; None starts our own.

    Raises:
        BadInput: No server answers there.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    feet = robot.neutral_feet()
    torso = np.eye(4)
    torso[2, 3] = -min(float(robot.sole_vertices(side, feet[side])[:, 2].min()) for side in SIDES)
    size = max(float(torso[2, 3]), 1e-3)
    q = robot.configuration(torso, np.zeros(12))
    return RobotViewer(
        robot,
        lambda q: overlays(robot, q, size),
        url,
        q=q,
        floor=0.0,
        forward=(0.0, 1.0),
        colour=lambda name: (colour_of_body(name), SEEN_THROUGH if is_sole(name) else 1.0),
    )


def overlays(robot: Scout, q: np.ndarray, size: float) -> list[Item]:
    """Centre of mass, its projection and the support polygon at configurations.

    Args:
        robot: The biped.
        q: For this robot's root, shape ``(n, nq)``.
        size: How high the robot is [m].
    """
    data, model = robot.model.createData(), robot.model
    com, outlines = np.empty((len(q), 3)), []
    for k, configuration in enumerate(q):
        com[k] = pin.centerOfMass(model, data, configuration)
        soles = []
        for side in SIDES:
            place = pin.updateFramePlacement(model, data, robot.sole_frames[side])
            corners = robot.sole_vertices(side, place.homogeneous)
            if np.abs(corners[:, 2]).max() <= TOLERANCES.stance_drift:
                soles.append(corners)
        flat = support_polygon(*soles) if soles else np.zeros((0, 2))
        outlines.append(np.column_stack([flat, np.zeros(len(flat))]))
    which = np.array([k if len(outline) else -1.0 for k, outline in enumerate(outlines)])
    floor = com * (1.0, 1.0, 0.0)
    return [
        Ball("com", "com", com, 0.02 * size, (BLACK,)),
        Arrow("com_drop", "com", com, floor - com, 1.0, 2e-3 * size, BLACK, head=False),
        Ball("com_floor", "com", floor, 0.0125 * size, (BLACK,)),
        Polygon("polygon", "polygon", tuple(outlines), which, BLUE, 6e-3 * size),
    ]
