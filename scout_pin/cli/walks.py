"""Options of ``scout-pin plan``: every field of a request, in the units people think in."""

from __future__ import annotations

from collections.abc import Callable

from thesis_pin.command import options
from thesis_pin.command.options import add_json, count, number
from thesis_pin.command.registry import Words

_STEPS = (
    ("--step-length", "MM", True, "from one footfall to the next (default: 30; none if aside)"),
    ("--side", "MM", False, "way aside of two steps, to the right; negative: to the left"),
    ("--turn", "DEG", False, "turn of two steps, to the left; negative: to the right"),
    ("--step-time", "SECONDS", True, "time from one footfall to the next (default: 0.8)"),
    ("--walking-speed", "MM/S", True, "speed of the walk, instead of --step-time"),
    ("--foot-spacing", "MM", True, "from sole to sole across (default: 12 mm between them)"),
    ("--lift", "MM", True, "how high the swinging foot goes (default: 15)"),
    ("--margin", "MM", False, "least distance of the ZMP inside the support (default: 10)"),
    ("--torque-reserve", "%", False, "of the stall torque that isn't used (default: 10)"),
    ("--speed-reserve", "%", False, "of the no-load speed that isn't used (default: 10)"),
    ("--line-reserve", "%", False, "of the torque-speed line (default: 10; of the fastest: 5)"),
    ("--pitch", "DEG", True, "how far the torso may pitch either way (default: 15)"),
    ("--roll", "DEG", True, "how far it may roll (default: 15)"),
    ("--yaw", "DEG", True, "how far it may yaw (default: 12)"),
    ("--knee", "DEG", True, "least angle of a knee from straight (default: 10)"),
)
"""Numbers that say which walk is planned: flag, unit, whether above zero, help."""

_SERVOS = (
    ("--servo-rate", "HZ", True, "how often servos are told where to go (default: 50)"),
    ("--servo-stiffness", "N·m/rad", True, "how a position servo gives way (default: 20)"),
    ("--servo-damping", "N·m·s/rad", False, "how it is damped (default: 0.05)"),
)


def which_walk(words: Words, branch: Callable[..., None]) -> None:
    """Which walk is planned, and what is written of it.

    Args:
        words: Where to add the options.
        branch: Adds the one that says how the legs stand.
    """
    for flag, unit, positive, text in _STEPS:
        # argparse formats help: a lone per cent sign is its own.
        unit = unit.replace("%", "PERCENT")
        words.add_argument(flag, type=number(flag, positive=positive), metavar=unit, help=text)
    words.add_argument(
        "--height",
        nargs=2,
        type=number("--height", positive=True),
        metavar=("LEAST", "MOST"),
        help="of the torso's origin [mm] (default: 80 to 100 %% of the neutral pose's)",
    )
    words.add_argument(
        "--friction",
        type=number("--friction", positive=True),
        metavar="NUMBER",
        help="coefficient between sole and floor, at least 1e-6 (default: the specification's)",
    )
    words.add_argument(
        "--no-servo-line",
        action="store_true",
        help="keep torque and speed below their limits, but not their torque-speed line",
    )
    words.add_argument(
        "--objective",
        choices=("limits", "least-torque", "fastest", "largest-margin"),
        help="what is best of all that keep the limits (default: limits, which is any)",
    )
    words.add_argument("--fastest", action="store_true", help="the same as --objective fastest")
    words.add_argument(
        "--steps",
        type=count("--steps", 1, 100),
        default=10,
        metavar="N",
        help="steps of the walk from rest to rest, the foot behind drawn up last (default: 10)",
    )
    branch(words, default="the specification's, else nearest to neutral")
    for flag, unit, positive, text in _SERVOS:
        words.add_argument(flag, type=number(flag, positive=positive), metavar=unit, help=text)
    options.add_samples(words, 801)
    words.add_argument(
        "--out", metavar="DIR", help="write gaits, joint tables, report.json, samples.csv, figures"
    )
    add_json(words, "the plan")
    words.add_argument("--html", metavar="FILE|-", help="write the walk's report as a page to mail")
