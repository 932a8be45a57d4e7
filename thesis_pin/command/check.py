"""The verb ``thesis-pin check``: is the description of a robot with closed loops sound?"""

from __future__ import annotations

import argparse

from thesis_pin.command.any_robot import loaded
from thesis_pin.command.running import ExitCode
from thesis_pin.command.text import say
from thesis_pin.command.verbs import Answer, give
from thesis_pin.files import write_folder
from thesis_pin.loops.soundness import Soundness, check
from thesis_pin.model.pair import pair
from thesis_pin.report.tables import Part, Table


def run(arguments: argparse.Namespace) -> ExitCode:
    """Say whether a description is sound, where it closes, and what holds it."""

    def answer() -> Answer:
        robot = loaded(arguments)
        found = check(robot, pose=arguments.pose, precision=arguments.precision)
        if arguments.out:
            files = {name: text.encode() for name, text in pair(robot.description).items()}
            write_folder(arguments.out, files)
            say(f"wrote {', '.join(files)} to {arguments.out}")
        yes = found.sound and (found.held or not arguments.strict)
        return Answer(found.document, lambda: _tell(found), yes=yes)

    return give(arguments, answer, "checking")


def _tell(found: Soundness) -> list[Part]:
    robot = found.robot
    rows = [
        (loop.name, loop.kind, *loop.frames, f"{gap.distance:.1e}", f"{gap.angle:.1e}")
        for loop, gap in zip(robot.loops, found.assembly.gaps, strict=False)
    ]
    columns = ("loop", "type", "frame", "frame", "gap m", "gap rad")
    return [
        *([Table("", columns, rows)] if rows else []),
        f"{robot.model.name}: {robot.model.njoints - 1} joints, "
        f"{len(robot.actuators)} motors ({', '.join(robot.actuators)}).",
        *found.sentences(),
        *(f"Warning: {one}" for one in found.warnings),
        *(f"Not used: {one}" for one in robot.description.passed_over),
    ]
