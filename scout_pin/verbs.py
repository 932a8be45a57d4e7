"""What the verbs of ``scout-pin`` do that only Scout does; imported when a verb runs."""

from __future__ import annotations

import argparse
from collections.abc import Callable

import numpy as np

from scout_pin.model import Scout
from thesis_pin.command.results import Answer


def report(
    arguments: argparse.Namespace,
    robot: Scout,
    samples: Callable[[float], int],
    progress: Callable[[int, int], None],
) -> object:
    """The report on the gait that the arguments ask for."""
    from scout_pin.motion.files import load_gait
    from scout_pin.report.document import gait_report

    gait = load_gait(
        arguments.gait,
        arguments.interpolation,
        robot=robot,
        smooth=arguments.smooth,
        time_unit=arguments.time_unit,
    )
    unit = arguments.time_unit or gait.time_unit
    return gait_report(
        robot,
        gait,
        samples=samples((gait.end - gait.start) * unit),
        time_unit=unit,
        branch=arguments.branch,
        progress=progress,
    )


def ik(arguments: argparse.Namespace, robot: Scout) -> Answer:
    """The branches of the foot pose that the arguments ask for."""
    from scout_pin.kinematics.solutions import branch_numbers
    from scout_pin.report.tables import ik_document, solutions_table
    from thesis_pin.numeric.rotations import euler_placement, transform

    pose, zero = np.concatenate([arguments.position, np.radians(arguments.rotation)]), np.zeros(3)
    rotation = euler_placement("xyz", pose[3:], zero, zero)[0]
    solutions = robot.leg_inverse_kinematics(arguments.side, transform(rotation, pose[:3]))
    numbers = branch_numbers(arguments.branch)
    only = numbers[0 if arguments.side == "left" else 1]
    reached = solutions.reachable if only is None else solutions.reachable[only]
    return Answer(
        lambda: ik_document(robot, solutions, pose, only),
        lambda: solutions_table(solutions, only),
        yes=bool(reached.any()),
    )
