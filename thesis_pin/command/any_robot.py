"""Words that the verbs of ``thesis-pin`` share: which robot, and in which pose."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from thesis_pin.command.options import number
from thesis_pin.command.registry import Words

if TYPE_CHECKING:  # help has to be quick
    from thesis_pin.loops.closures import ClosedRobot


def which_robot(words: Words) -> None:
    """The description's files and what they leave open."""
    words.add_argument(
        "file", metavar="FILE", help="the robot's description: see thesis-pin formats"
    )
    words.add_argument(
        "closures",
        nargs="?",
        metavar="CLOSURES",
        help="YAML with closed_loop, type and name_mot, for what the description can't say",
    )


def which_motion(words: Words) -> None:
    """The file of the joints' motion."""
    words.add_argument(
        "motion",
        metavar="MOTION",
        help="CSV with t [s] and a column per motor or joint: NAME, NAME_rate, "
        "NAME_acceleration (SI, or NAME_deg and the like)",
    )


def which_pose(words: Words) -> None:
    """From where the loops are closed, and what the root does."""
    words.add_argument(
        "--pose",
        metavar="NAME|FILE",
        help="a pose of the description, or a .toml file: where the loops are closed from "
        "(default: the neutral one)",
    )
    words.add_argument(
        "--free-flyer", action="store_true", help="let the root fly freely (default: as described)"
    )
    words.add_argument(
        "--precision",
        type=number("--precision"),
        metavar="RAD",
        help="loop equations that differ by less count as one; 0 takes every one as real "
        "(default: told from the file's own noise)",
    )


def loaded(arguments: argparse.Namespace) -> ClosedRobot:
    """The robot that the arguments name."""
    import pinocchio as pin

    from thesis_pin.loops.loading import load

    root = pin.JointModelFreeFlyer() if arguments.free_flyer else None
    return load(arguments.file, arguments.closures, root_joint=root)
