"""The verb ``thesis-pin torque``: what does a motion take of any robot's motors?"""

from __future__ import annotations

import argparse

from thesis_pin.command.any_robot import loaded
from thesis_pin.command.running import ExitCode
from thesis_pin.command.verbs import deliver
from thesis_pin.loops.assembly import assembly
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.report.torque.document import TorqueReport, torque_report


def run(arguments: argparse.Namespace) -> ExitCode:
    """Report on a motion of any robot."""

    def make(_: object) -> TorqueReport:
        robot = loaded(arguments)
        motion = read_motion(robot, arguments.motion)
        x = arguments.precision
        pose = assembly(robot, arguments.pose, precision=x).q
        return torque_report(robot, motion, pose=pose, precision=x)

    return deliver(
        arguments,
        "working out the torques",
        make,
        figures="thesis_pin.report.torque.figures:figures",
        page="thesis_pin.pages.torque:torque_page",
        table="thesis_pin.report.torque.tables:summary",
    )
