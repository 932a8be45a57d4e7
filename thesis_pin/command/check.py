"""The verb ``thesis-pin check``: is the description of a robot with closed loops sound?"""

from __future__ import annotations

import argparse

from thesis_pin.command.output import print_table, print_text
from thesis_pin.command.running import ExitCode
from thesis_pin.command.verbs import Answer, give
from thesis_pin.loops.loading import load
from thesis_pin.loops.soundness import Soundness, check


def run(arguments: argparse.Namespace) -> ExitCode:
    """Say whether a URDF and its closure file are sound."""

    def answer() -> Answer:
        found = check(load(arguments.urdf, arguments.closures))
        return Answer(found.document, lambda: _tell(found), yes=found.sound)

    return give(arguments, answer, "checking")


def _tell(found: Soundness) -> None:
    robot = found.robot
    rows = [(loop.name, loop.kind, *loop.frames) for loop in robot.loops]
    if rows:
        print_table(("loop", "type", "frame", "frame"), rows)
    print_text(
        f"{robot.model.name}: {robot.model.njoints - 1} joints, "
        f"{len(robot.actuators)} motors ({', '.join(robot.actuators)}).",
        *found.sentences(),
    )
