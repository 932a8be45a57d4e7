"""The command ``thesis-pin``: what works for any robot."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from thesis_pin.command.any_robot import which_pose, which_robot
from thesis_pin.command.options import add_json
from thesis_pin.command.registry import Command, Parser, Verb, Words


def _strictly(words: Words) -> None:
    words.add_argument(
        "--strict", action="store_true", help="exit with 1 if the motors don't hold the robot"
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
            (which_robot, which_pose, _strictly, partial(add_json, what="the findings")),
        ),
    ),
)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    return COMMAND.parser()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return COMMAND.main(arguments)
