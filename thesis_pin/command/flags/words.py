"""The words of ``thesis-pin``: which robot, motion, pose and grid its verbs are about."""

from __future__ import annotations

import argparse
from pathlib import Path

from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_number, slope, wrench
from thesis_pin.command.flags.options import (
    LISTS,
    add_euler,
    add_frame,
    add_friction,
    add_points,
    add_smooth,
)
from thesis_pin.command.registry import Words


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


def which_derivation(words: Words) -> None:
    """The file of a derivation, and the robot it is about."""
    words.add_argument(
        "file", metavar="FILE", help="TOML of the equations, see docs/your_derivation.md"
    )
    words.add_argument(
        "--model",
        required=True,
        metavar="FILE",
        help="the robot's description: see thesis-pin formats",
    )


def which_motion(words: Words) -> None:
    """The file of the joints' motion."""
    words.add_argument(
        "motion",
        metavar="MOTION",
        help="CSV with t [s] and a column per motor or joint: NAME, NAME_rate, "
        "NAME_acceleration (SI, or NAME_deg and the like), of a free root base_x to base_yaw; "
        "with --frame of x, y, z and the like",
    )
    add_smooth(words)
    add_frame(words)
    add_euler(words)


def perhaps_motion(words: Words) -> None:
    """The same, where a robot may stand still."""
    words.add_argument(
        "motion",
        nargs="?",
        metavar="MOTION",
        help="CSV as for torque (default: sliders move the robot, its loops stay closed)",
    )
    add_smooth(words)
    add_frame(words)
    add_euler(words)


def closures_and_motion(arguments: argparse.Namespace) -> tuple[str | None, str | None]:
    """The two files that may stand behind the robot's: one alone is told by its ending."""
    closures, motion = arguments.closures, arguments.motion
    if motion is None and closures is not None and Path(closures).suffix.lower() in _TABLES:
        return None, closures
    return closures, motion


_TABLES = (".csv", ".tsv", ".txt", ".dat")


def which_list(words: Words) -> None:
    """Which servos."""
    text = f"{LISTS} (default: motors of any size)"
    words.add_argument("--list", dest="servos", nargs="+", metavar="LIST", help=text)


def which_grid(words: Words) -> None:
    """Over what a workspace is mapped."""
    add_frame(words)
    words.add_argument(
        "--along",
        action="append",
        nargs=3,
        default=[],
        metavar=("NAME", "FROM", "TO"),
        help="an axis of the grid, one to three: x, y, z [m], roll, pitch, yaw [rad] of the frame, "
        "a motor or a joint; also x_mm, NAME_deg and the like (default: the ranges of up to three "
        "motors)",
    )
    words.add_argument(
        "--at",
        action="append",
        nargs=2,
        default=[],
        metavar=("NAME", "VALUE"),
        help="what else leads and stands still; motors that nothing leads stay at the pose",
    )
    add_points(words, 41)
    length = "of shifts, that counts as a radian in condition numbers (default: 0.1)"
    add_number(words, "--length", "METRES", length, positive=True)


def where_to(words: Words) -> None:
    """Where a workspace is written."""
    words.add_argument("--out", metavar="DIR", help="write workspace.json, .csv and figures")
    add_figures(words)
    words.add_argument(
        "--html", metavar="FILE|-", help="write it as a page to mail: picture, numbers, animation"
    )


def which_wrenches(words: Words) -> None:
    """What acts from outside."""
    words.add_argument(
        "--external",
        action="append",
        default=[],
        type=wrench,
        metavar="FRAME=FX,FY,FZ[,MX,MY,MZ]",
        help="a constant force on the robot at a frame's origin, and a moment about it, in the "
        "world's axes [N], [N·m]; may be given for several frames",
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
    _add_precision(words)


def which_stance(words: Words) -> None:
    """A pose or a motion on feet: which feet, which floor, who carries what."""
    words.add_argument(
        "motion",
        nargs="?",
        metavar="MOTION",
        help="CSV as for torque, with base_x … of the root and contact_NAME (0 or 1) of each foot "
        "(default: a pose is held)",
    )
    add_smooth(words)
    words.add_argument(
        "--pose",
        metavar="NAME|FILE",
        help="a pose of the description or of an SRDF beside it, or a .toml file: what is held, or "
        "where loops are closed from (default: half_sitting or standing of the SRDF, or neutral)",
    )
    _add_precision(words)
    words.add_argument(
        "--feet",
        metavar="NAME,NAME",
        help="frames or links, each with its sole from the robot's shapes; or NAME=point, "
        "NAME=0.03 (a ball, in metres), NAME=0.2x0.1 (a sole) (default: a guess, which is said)",
    )
    add_friction(words)
    height = "height of the floor at the world's origin [m] (default: below the feet)"
    add_number(words, "--floor-height", "M", height)
    words.add_argument(
        "--slope",
        type=slope,
        default=(0.0, 0.0),
        metavar="DEG[,HEADING]",
        help="how much the floor rises, and in which heading from the world's x axis [°] "
        "(default: level)",
    )
    words.add_argument(
        "--sharing",
        choices=("torque", "force", "equal"),
        default="torque",
        help="what shares load that the feet leave open: least squared torques, least squared "
        "contact forces, equal normal forces (default: torque)",
    )


def strictly(words: Words) -> None:
    """Whether motors that don't hold the robot make the exit code 1."""
    words.add_argument(
        "--strict", action="store_true", help="exit with 1 if the motors don't hold the robot"
    )


def written(words: Words) -> None:
    """Where the robot is written as a URDF and a closure file."""
    words.add_argument(
        "--write",
        dest="out",
        metavar="DIR",
        help="write the robot there as a URDF and a closure file, whatever it was read from",
    )


def _add_precision(words: Words) -> None:
    add_number(
        words,
        "--precision",
        "RAD",
        "loop equations that differ by less count as one; 0 takes every one as real "
        "(default: told from the file's own noise)",
    )
