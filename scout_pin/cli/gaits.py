"""Options of ``scout-pin`` that say which gait, and which pose of a foot."""

from __future__ import annotations

from functools import partial

from thesis_pin.command.flags import options
from thesis_pin.command.flags.numbers import add_count, add_number
from thesis_pin.command.registry import Words

add_branch = partial(
    options.add_branch,
    signs="the way the knees bend, forward or backward, or three signs S_E S_2 S_K, written "
    "--branch=+-+; for both legs, or for left and right, --branch=+++,-+-",
)


def which_gait(words: Words) -> None:
    """Which gait, how its nodes and samples are read, and how often it is walked."""
    add_branch(words, default="the gait's, the specification's, else nearest to neutral")
    words.add_argument(
        "--gait",
        metavar="NAME|FILE",
        help="thesis, thesis-program, a .toml gait or a .csv of samples (default: thesis)",
    )
    words.add_argument(
        "--interpolation",
        choices=("linear", "quadratic", "cubic", "free", "quintic"),
        help="method for the gait's nodes, instead of the gait's own",
    )
    options.add_smooth(words)
    unit = "seconds in the gait's unit of t (default: the gait's own)"
    add_number(words, "--time-unit", "SECONDS", unit, positive=True)
    words.add_argument(
        "--cycle",
        action="store_true",
        help="the gait's end is its start, a step further (as cycle = true in its file)",
    )
    often = "walk the gait N times, each time a step further and with as many samples"
    add_count(words, "--repeat", often, least=1, default=1)


def which_pose(words: Words) -> None:
    """Which foot, and where it is."""
    add_branch(words, default="all")
    words.add_argument("side", choices=("left", "right"))
    add_number(
        words,
        "--position",
        ("X", "Y", "Z"),
        "origin of the sole in the torso frame [m]",
        required=True,
    )
    add_number(
        words,
        "--rotation",
        ("PITCH", "ROLL", "YAW"),
        "Rx(pitch) Ry(roll) Rz(yaw) [°]",
        default=(0.0, 0.0, 0.0),
    )
