"""The biped moved by sliders: its servos and its torso, knees and soles said as they move."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scout_pin.kinematics.branches import knee, taken_branches
from scout_pin.model import Scout
from scout_pin.report.drawn.neutral import standing
from scout_pin.report.drawn.view import robot_colours
from scout_pin.specification import JOINT_NAMES, SIDES
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.live.joints import JointRig
from thesis_pin.pages.live.layers import layers
from thesis_pin.pages.live.page import LivePage
from thesis_pin.pages.scene import Group
from thesis_pin.report.curves import ORANGE, SKY
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Readouts = tuple[tuple[str, str], ...]

_TORSO = {
    "root_joint x": "torso x, to the right",
    "root_joint y": "torso y, ahead",
    "root_joint z": "torso z, up",
    "root_joint roll": "torso about the world's x",
    "root_joint pitch": "torso, then about y",
    "root_joint yaw": "torso, then about z",
}


def slider_page(robot: Scout, command: str = "scout-pin view --sliders") -> LivePage:
    """A biped with a slider for each servo and six for its torso, at first in its neutral pose.

    Args:
        robot: The biped, on a free flyer.
        command: What shows the page with sliders that move, for pages whose don't.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    q = standing(robot)
    drawn = layers(
        robot,
        q,
        bodies=robot_colours(robot, np.tile(q, (2, 1))),
        groups=(
            Group("robot", "robot", ((SKY, "left leg"), (ORANGE, "right leg"))),
            Group("soles", "soles"),
        ),
    )
    rig = JointRig(
        robot,
        q,
        drawn.size,
        readouts=lambda q: readouts(robot, q),
        labels=_TORSO,
        headings={name: name.split("_")[0] + " leg" for name in JOINT_NAMES},
        root="torso",
    )
    title = f"{robot.specification.name.capitalize()}, moved by sliders"
    return LivePage(rig, drawn, title, command, forward=(0.0, 1.0))


def readouts(robot: Scout, q: Array) -> Readouts:
    """Which way the knees bend, where the soles are, which servos are at a limit.

    Args:
        robot: The biped.
        q: Its configuration on a free flyer, shape ``(19,)``.
    """
    angles = q[7:]
    found: list[tuple[str, str]] = []
    for number, side in enumerate(SIDES):
        theta, leg = angles[6 * number : 6 * number + 6], robot.legs[side]
        bent = abs(float(np.sin(theta[3] + leg.beta[3])))
        way = "straight"
        if bent > TOLERANCES.near_singular:
            way = knee(leg, int(taken_branches(leg, theta[None])[0]))
        found.append((f"{side} knee", way))
        sole = robot.leg_forward_kinematics(side, theta)
        x, y, z = (1e3 * sole[:3, 3]).tolist()
        found.append((f"{side} sole in the torso", f"{x:.1f}, {y:.1f}, {z:.1f} mm"))
    beyond = np.maximum(robot.lower - angles, angles - robot.upper) >= -TOLERANCES.joint_limit
    names = [name for name, one in zip(JOINT_NAMES, beyond, strict=True) if one]
    found.append(("servos at a limit", ", ".join(names) or "none"))
    return tuple(found)
