"""What the verbs of ``scout-pin`` do that only Scout does; imported when a verb runs."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from scout_pin.model import Scout
from scout_pin.specification import SIDES
from thesis_pin.command.results import Answer

if TYPE_CHECKING:  # inverse kinematics alone needs neither
    from scout_pin.motion.gait import Gait
    from thesis_pin.report.exchange.movement import Movement


def report(
    arguments: argparse.Namespace,
    robot: Scout,
    samples: Callable[[float], int],
    progress: Callable[[int, int], None],
) -> object:
    """The report on the gait that the arguments ask for."""
    from scout_pin.motion.cycles import repeat_gait
    from scout_pin.report.document import gait_report

    gait = _gait(arguments, robot)
    one = gait.end - gait.start
    if arguments.repeat > 1:
        gait = repeat_gait(gait, arguments.repeat)
    unit = arguments.time_unit or gait.time_unit
    return gait_report(
        robot,
        gait,
        # As many for each walk: peaks don't get lost where it is repeated.
        samples=1 + arguments.repeat * (samples(one * unit) - 1),
        time_unit=unit,
        branch=arguments.branch,
        progress=progress,
    )


def motion(arguments: argparse.Namespace, robot: Scout) -> Movement:
    """The gait that the arguments ask for, to be written down."""
    from scout_pin.report.movement import gait_movement

    return gait_movement(
        robot,
        _gait(arguments, robot),
        samples=arguments.samples,
        time_unit=arguments.time_unit,
        branch=arguments.branch,
    )


def _gait(arguments: argparse.Namespace, robot: Scout) -> Gait:
    """The gait that the arguments ask for, once."""
    from scout_pin.motion.files import load_gait

    gait = load_gait(
        arguments.gait,
        arguments.interpolation,
        robot=robot,
        smooth=arguments.smooth,
        time_unit=arguments.time_unit,
    )
    return replace(gait, cycle=True) if arguments.cycle else gait


def ik(arguments: argparse.Namespace, robot: Scout) -> Answer:
    """The branches of the foot pose that the arguments ask for."""
    from scout_pin.report.tables import ik_document, solutions_table
    from thesis_pin.numeric.rotations import euler_placement, transform

    pose, zero = np.concatenate([arguments.position, np.radians(arguments.rotation)]), np.zeros(3)
    rotation = euler_placement("xyz", pose[3:], zero, zero)[0]
    solutions = robot.leg_inverse_kinematics(arguments.side, transform(rotation, pose[:3]))
    only = None  # all, whatever the specification would choose
    if arguments.branch is not None:
        only = robot.allowed_branches(arguments.branch)[SIDES.index(arguments.side)]
    reached = solutions.reachable if only is None else solutions.reachable[list(only)]
    return Answer(
        lambda: ik_document(robot, solutions, pose, only),
        lambda: solutions_table(solutions, only),
        yes=bool(reached.any()),
    )
