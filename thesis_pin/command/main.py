"""The command ``thesis-pin``: what works for any robot."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from thesis_pin.command.any_robot import which_motion, which_pose, which_robot
from thesis_pin.command.options import add_json, add_report
from thesis_pin.command.registry import Command, Parser, Verb, Words


def _strictly(words: Words) -> None:
    words.add_argument(
        "--strict", action="store_true", help="exit with 1 if the motors don't hold the robot"
    )


def _written(words: Words) -> None:
    words.add_argument(
        "--write",
        dest="out",
        metavar="DIR",
        help="write the robot there as a URDF and a closure file, whatever it was read from",
    )


COMMAND = Command(
    "thesis-pin",
    "Any robot, with closed loops or without: is its description sound, what do its motors need?",
    (
        Verb(
            "check",
            "is a robot's description sound?",
            "Check a robot's description: names, tree, loops, motors, degrees of freedom, and "
            "where it closes.",
            "check urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml",
            "thesis_pin.loops.soundness:check",
            "thesis_pin.command.check:run",
            (which_robot, which_pose, _strictly, _written, partial(add_json, what="the findings")),
        ),
        Verb(
            "torque",
            "what do the motors need for a motion?",
            "Torques, loop forces, power and work of any robot whose joints move as a file says.",
            "torque urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml "
            "examples/pollard_motors.csv",
            "thesis_pin.report.torque.document:torque_report",
            "thesis_pin.command.torque:run",
            (
                which_robot,
                which_motion,
                which_pose,
                partial(add_report, breaks="a motor or joint leaves its limits"),
            ),
        ),
        Verb(
            "formats",
            "what of a robot's file is read?",
            "Formats of robots: what of each is used, and what is passed over and named.",
            "formats",
            "thesis_pin.report.formats:formats",
            "thesis_pin.command.formats:run",
            (partial(add_json, what="the formats"),),
        ),
    ),
)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    return COMMAND.parser()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return COMMAND.main(arguments)
