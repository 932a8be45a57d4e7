"""The words of ``place``: where a path is tried, and what is to be best."""

from __future__ import annotations

import argparse

from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_count, add_number
from thesis_pin.command.flags.ranges import add_range


def which_places(words: argparse.ArgumentParser) -> None:
    """Which placements are tried, what is to be best, and where the answer goes."""
    words.add_argument(
        "--for",
        dest="objective",
        choices=("torque", "conditioning", "time", "clearance"),
        default="torque",
        help="what is to be best: least peak torque (share of each motor's limit), least condition "
        "number, shortest time within the motors' limits, or most clearance from singularities "
        "(default: torque)",
    )
    for axis, default in (("x", "7 within ±0.15 m"), ("y", "5 within ±0.1 m"), ("z", "as of x")):
        text = (
            f"what is added to the path's {axis} [m]: one value, FROM:TO in --points, FROM:TO:STEP "
            f"or a list (default: {default}, about where it stands; nothing else where a range is "
            "given)"
        )
        add_range(words, f"--{axis}", "RANGE", text)
    turn = "turns about the vertical through the path's middle [°], likewise (default: none)"
    add_range(words, "--turn", "RANGE", turn)
    words.add_argument(
        "--mirror",
        nargs="?",
        const="yes",
        choices=("no", "yes", "both"),
        default="no",
        help="the path's mirror image: not, instead, or as well (default: no)",
    )
    add_count(words, "--points", "points an axis", least=2, default=7)
    words.add_argument(
        "--any-branch",
        action="store_true",
        help="try all 16 branches with f0 f1 f2 at +, but for those on which the arms cross",
    )
    torque = "limits of the motors' torque: one number, or six (default: the specification's)"
    add_number(words, "--torque", "N·m", torque, positive=True, nargs="+")
    speed = "the same of their speed"
    add_number(words, "--speed", "rad/s", speed, positive=True, nargs="+")
    condition = "largest condition number of the six motors that is allowed (default: any)"
    add_number(words, "--condition", "NUMBER", condition, within=(1.0, 1e6))
    samples = "evenly spaced samples; more stand beside abrupt changes"
    add_count(words, "--samples", samples, least=2, default=401)
    told = "placements that are told, judged at 2001 samples"
    add_count(words, "--best", told, least=1, most=1000, default=10)
    words.add_argument(
        "--grid-only", action="store_true", help="try nothing between the grid's values"
    )
    words.add_argument(
        "--out",
        metavar="DIR",
        help="write placements.csv, .json, figures and the best as path.toml",
    )
    add_figures(words)
    words.add_argument(
        "--html", metavar="FILE|-", help="write a page to mail: the robot at the best, map, table"
    )
