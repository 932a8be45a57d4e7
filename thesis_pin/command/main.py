"""The command ``thesis-pin``: what works for any robot."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial

from thesis_pin.command.options import add_json
from thesis_pin.command.registry import Command, Parser, Verb


def _which_files(words: argparse.ArgumentParser) -> None:
    words.add_argument("urdf", metavar="URDF", help="URDF of the cut-open tree")
    words.add_argument(
        "closures", metavar="CLOSURES", help="YAML with closed_loop, type and name_mot"
    )


COMMAND = Command(
    "thesis-pin",
    "Any robot with closed loops, from its URDF and the closure file beside it.",
    (
        Verb(
            "check",
            "is a robot's URDF and closure file sound?",
            "Check a URDF and the closure file beside it: names, tree, loops, motors, degrees of "
            "freedom.",
            "check urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml",
            "thesis_pin.loops.soundness:check",
            "thesis_pin.command.check:run",
            (_which_files, partial(add_json, what="the findings")),
        ),
    ),
)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    return COMMAND.parser()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return COMMAND.main(arguments)
