"""Options of ``scout-pin new`` and ``from-urdf``: what is made, and of what."""

from __future__ import annotations

from thesis_pin.command.flags import options
from thesis_pin.command.flags.numbers import add_number
from thesis_pin.command.registry import Words


def which_new(words: Words) -> None:
    """What is written, and for which robot."""
    words.add_argument("target", metavar="FILE|-", help="what to write; - is standard output")
    words.add_argument(
        "--motion",
        choices=("squat", "sway"),
        help="write a first gait for the robot of --specification, made from its neutral soles",
    )
    words.add_argument(
        "--specification", metavar="FILE", help="the robot of --motion (default: the thesis's)"
    )
    words.add_argument(
        "--example", metavar="NAME", help="write a shipped example, as walk.toml; any lists them"
    )
    _force(words)


def which_urdf(words: Words) -> None:
    """Which description, where it goes, and what it leaves open."""
    words.add_argument(
        "file", metavar="FILE", help="a URDF, MJCF or SDF, or example:NAME of example-robot-data"
    )
    words.add_argument(
        "--to",
        metavar="FILE|-",
        default="-",
        help="where the specification goes (default: standard output)",
    )
    words.add_argument(
        "--left", metavar="JOINT", help="a joint of the left leg (default: found by its name)"
    )
    add_number(
        words,
        "--sole",
        ("LEFT", "RIGHT", "HEEL", "TOES", "HEIGHT"),
        "edges of both soles from the point below the ankle, and the ankle's height above "
        "them [m] (default: the lowest face of each foot's shapes)",
        positive=True,
    )
    servo = "stall torque [N·m] and no-load speed [rad/s] of joints whose limits say none"
    add_number(words, "--servo", ("TORQUE", "SPEED"), servo, positive=True)
    options.add_friction(words)
    _force(words)


def _force(words: Words) -> None:
    words.add_argument("--force", action="store_true", help="replace a file that is there")
