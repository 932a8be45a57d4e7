"""Flags of ``size``: lists, and motors of any size where there is none."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_number
from thesis_pin.command.flags.options import LISTS, add_json
from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import MOST

RATED = 0.5
"""As :data:`thesis_pin.sizing.actuator.RATED`, which help needn't import."""
KIND = ("per", "bound", "no-load-speed", "power", "armature", "rating")
"""Flags that say what motors are like where there is no list."""
FREE = ("within", "curve", "law")
"""Flags of motions whose time is left free."""


def add_lists(words: Words) -> None:
    """Lists of servos, or none."""
    text = f"{LISTS} (default: motors of any size)"
    words.add_argument("servos", nargs="*", metavar="LIST", help=text)


def add_kind(words: Words, *, per: Sequence[str], bounds: str | None) -> None:
    """What motors are like where there is no list.

    Args:
        words: Where to add it.
        per: Which may be alike, the usual first.
        bounds: Which of ``line`` and ``box`` is usual; None where torque and speed always share.
    """
    means = {
        "robot": "all alike",
        "group": "those of a group (a kind of joint, base or wrist)",
        "joint": "each its own",
    }
    words.add_argument(
        "--per",
        choices=sorted(per),
        help="without a list: which motors are alike: "
        + ", ".join(f"{one}: {means[one]}" for one in sorted(per))
        + f" (default: {per[0]})",
    )
    if bounds is not None:
        words.add_argument(
            "--bound",
            choices=("line", "box"),
            help="without a list: |τ|/stall + |ω|/no-load ≤ 1, or torque and speed each for itself "
            f"(default: {bounds})",
        )
    speed = "without a list: no-load or greatest speed (default: the robot's own)"
    add_number(words, "--no-load-speed", "rad/s", speed, positive=True)
    power = "without a list: greatest power, instead of a speed: gears of any ratio"
    add_number(words, "--power", "W", power, positive=True)
    rotor = (
        "without a list: inertia of a rotor as its joint feels it, for a motor of 1 N·m, and with "
        "which power of the torque it grows (default: the robot's own, 0)"
    )
    words.add_argument("--armature", type=_rotor, metavar="kg·m²[,POWER]", help=rotor, default=None)
    rating = f"without a list: of the stall torque, borne for long (default: {RATED:g})"
    add_number(words, "--rating", "SHARE", rating, within=(1e-3, 1.0))


def add_free(words: Words) -> None:
    """Flags of motions whose time may be left free."""
    words.add_argument(
        "--law",
        choices=("given", "free", "both"),
        help="keep the time that the motion has, or leave it free (default: given with a list, "
        "both without)",
    )
    within = "time that the motion may take where it is free (default: see --law)"
    add_number(words, "--within", "SECONDS", within, positive=True)
    words.add_argument(
        "--curve", action="store_true", help="work out how short it may be with which motor"
    )
    add_figures(words)


def add_output(words: Words) -> None:
    """Where answers go."""
    voltage = "take those of the list for this voltage (default: all)"
    add_number(words, "--voltage", "V", voltage, positive=True)
    factor = "least safety factor against the torque-speed line"
    add_number(words, "--factor", "FACTOR", factor, positive=True, default=1.0)
    words.add_argument("--out", metavar="DIR", help="write report.json, sizes.csv, figures")
    add_json(words, "the answer")
    words.add_argument(
        "--strict",
        action="store_true",
        help="exit with 1 if some joint has no servo that carries it for long",
    )


def _rotor(text: str) -> tuple[float, float]:
    """An argparse type: N² J of a motor of 1 N·m, and how it grows."""
    parts = text.split(",")
    try:
        values = [float(part) for part in parts]
    except ValueError:
        values = []
    if not 1 <= len(values) <= 2 or not all(0.0 <= one <= MOST for one in values):
        raise argparse.ArgumentTypeError(
            f"--armature is {text[:80]!r}; allowed: kg·m² or kg·m²,POWER, neither below zero"
        )
    return values[0], (*values, 0.0)[1]


def refuse_with_list(arguments: argparse.Namespace, flags: Sequence[str], why: str) -> None:
    """Refuse flags that mean nothing where a list is given, or where none is.

    Raises:
        BadInput: One is given.
    """
    for flag in flags:
        value = getattr(arguments, flag.replace("-", "_"), None)
        if value is not None and value is not False:
            raise BadInput(f"--{flag} means nothing {why}", remedy="Leave one of them out")
