"""The verb ``thesis-pin torque``: what does a motion take of any robot's motors?"""

from __future__ import annotations

import argparse

from thesis_pin.command.any_robot import loaded
from thesis_pin.command.exits import ExitCode
from thesis_pin.command.output import print_table, print_text
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
        table="thesis_pin.command.torque:print_report",
    )


def print_report(report: TorqueReport) -> None:
    """Print the summary of a torque report."""
    a, time = report.actuators, report.joints.time
    print_table(
        ("motor", "peak", "of limit", "speed", "power", "net work"),
        [
            (
                name,
                f"{a.peak_torque[k]:.4g} {report.units[k]}",
                f"{report.effort_use[k]:.0%}" if report.effort_use[k] else "–",
                f"{a.peak_speed[k]:.4g}",
                f"{a.peak_power[k]:.4g}",
                f"{a.net_work[k]:.4g}",
            )
            for k, name in enumerate(report.names)
        ],
        title=f"{report.robot.model.name}, {report.motion.name}, {time[-1] - time[0]:g} s "
        "(rad/s or m/s, W, J)",
    )
    if report.robot.loops:
        peaks = report.loop_force_size.max(axis=0)
        print_table(
            ("loop", "type", "peak force N"),
            [
                (loop.name, loop.kind, f"{peak:.4g}")
                for loop, peak in zip(report.robot.loops, peaks, strict=True)
            ],
        )
    print_text(
        f"Unexplained load: {report.unexplained.max():.1e} of the largest.",
        *report.verdict(),
        *(f"Warning: {one}" for one in report.warnings()),
    )
