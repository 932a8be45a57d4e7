"""Options of ``view`` for what it shows besides motions."""

from __future__ import annotations

import argparse

from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput


def add_sliders(words: Words) -> None:
    """Whether sliders move the robot."""
    words.add_argument(
        "--sliders",
        action="store_true",
        help="move the robot by sliders in the page instead of playing a motion",
    )


def refuse_set(arguments: argparse.Namespace, flag: str, **usual: object) -> None:
    """Refuse flags that mean nothing beside another and aren't what they are by default.

    Args:
        arguments: The parsed arguments.
        flag: The flag that rules the others out, without dashes.
        **usual: These, with their defaults.

    Raises:
        BadInput: One of them is something else.
    """
    for name, value in usual.items():
        if getattr(arguments, name) != value:
            other = name.replace("_", "-")
            raise BadInput(
                f"--{other} means nothing beside --{flag}", remedy="Leave one of them out"
            )


def shown_by(arguments: argparse.Namespace, command: str) -> str:
    """The command line that shows a robot's sliders, for pages whose sliders don't move."""
    import shlex

    own = arguments.specification
    words = [command, "view", "--sliders", *(["--specification", str(own)] if own else [])]
    return shlex.join(words)
