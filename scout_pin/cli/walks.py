"""Options of ``scout-pin plan``: every field of a request, in the units people think in."""

from __future__ import annotations

from scout_pin.cli.gaits import add_branch
from scout_pin.cli.servos import add_gains
from thesis_pin.command.flags import options
from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_count, add_number
from thesis_pin.command.flags.options import add_json
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


def which_walk(words: Words) -> None:
    """Which walk is planned, and what is written of it."""
    for flag, unit, positive, text in _STEPS:
        # argparse formats help: a lone per cent sign is its own.
        add_number(words, flag, unit.replace("%", "PERCENT"), text, positive=positive)
    height = "of the torso's origin [mm] (default: 80 to 100 %% of the neutral pose's)"
    add_number(words, "--height", ("LEAST", "MOST"), height, positive=True)
    options.add_friction(words, default=None)
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
    steps = "steps of the walk from rest to rest, the foot behind drawn up last"
    add_count(words, "--steps", steps, least=1, most=100, default=10)
    add_branch(words, default="the specification's, else nearest to neutral")
    rate = "how often servos are told where to go (default: 50)"
    add_number(words, "--servo-rate", "HZ", rate, positive=True)
    add_gains(words)
    options.add_samples(words, 801)
    words.add_argument(
        "--out", metavar="DIR", help="write gaits, joint tables, report.json, samples.csv, figures"
    )
    add_figures(words)
    add_json(words, "the plan")
    words.add_argument("--html", metavar="FILE|-", help="write the walk's report as a page to mail")
