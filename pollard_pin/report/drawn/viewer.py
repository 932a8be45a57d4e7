"""The robot in meshcat, configuration by configuration, with its loops and its margins."""

from __future__ import annotations

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.report.drawn.view import MARGIN_COLOURS, colour_of_part
from pollard_pin.report.judged.limits import distance_class
from pollard_pin.urdf import TOOL_FRAME
from thesis_pin.errors import ThesisPinError
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.drawing import closure_items, frame_placements
from thesis_pin.pages.meshcat.robot import RobotViewer, closed
from thesis_pin.pages.scene import GREY, Ball, Item

CLOSED = 1e-4
"""Opening of a loop [m] below which the margins of the closed pose beside it are shown."""


def viewer(robot: Pollard, url: str | None = None) -> RobotViewer:
    """The robot in meshcat, ready for ``display(q)``; its loops are closed at first.

    Beside its bodies: a ball where a loop is closed, two and a bar where it is open, and the
    spray tip, coloured by its distance from singularities; grey while a loop is open.

    Args:
        robot: The robot.
        url: Address of a running server, as ``tcp://127.0.0.1:6000``; None starts our own.

    Raises:
        BadInput: No server answers there.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    return RobotViewer(
        robot,
        lambda q: overlays(robot, q),
        url,
        q=closed(robot),
        colour=lambda name: (colour_of_part(name), 1.0),
    )


def overlays(robot: Pollard, q: np.ndarray) -> list[Item]:
    """Ball joints and the spray tip at configurations ``(n, 12)``."""
    zones = np.array([zone(robot, one) for one in q])
    tip = frame_placements(robot.model, TOOL_FRAME, q)[:, :3]
    pairs = [loop.frames for loop in robot.loops]
    return [
        *closure_items(robot.model, pairs, q, "loops", 0.011),
        Ball("tip", "tip", tip, 8e-3, (*MARGIN_COLOURS, GREY), zones),
    ]


def zone(robot: Pollard, q: np.ndarray) -> int:
    """0 nearly singular, 1 near a singularity, 2 far from them, 3 while a loop is open.

    Args:
        robot: The robot.
        q: A configuration, shape ``(12,)``.
    """
    if np.linalg.norm(robot.posture(q).opening, axis=-1).max() > CLOSED:
        return 3
    margin = robot.inverse_kinematics(robot.pose(q), robot.branch_of(q)).margin
    try:
        condition = robot.actuation(q).condition
    except ThesisPinError:  # no rates, so no condition: at a singularity
        return 0
    return int(distance_class(np.atleast_1d(margin), np.atleast_1d(condition))[0])
