"""The words of the verb ``time``: which geometry, which law, which limits, where answers go."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from thesis_pin.command.flags.numbers import add_number, number
from thesis_pin.command.flags.options import add_euler, add_report, add_samples, add_smooth


def which_geometry(words: argparse.ArgumentParser) -> None:
    """A path whose timing counts for nothing."""
    words.add_argument(
        "--path",
        metavar="FILE",
        help=".csv or .toml path (default: the curve of appendix B)",
    )
    add_smooth(words)
    add_euler(words)
    words.set_defaults(duration=None, timing=None, feed=None, untimed=True)


def which_law(words: argparse.ArgumentParser) -> None:
    """The law and the limits it keeps."""
    words.add_argument(
        "--law",
        choices=("fastest", "constant-speed", "window", "least-load"),
        default="fastest",
        help="from rest to rest; at the largest constant tool speed, from beginning to end; at the "
        "largest tool speed that is kept within a window; or in a --duration with the least share "
        "of the motors' torque limits (default: fastest)",
    )
    words.add_argument(
        "--duration",
        dest="seconds",
        metavar="SECONDS",
        type=number("--duration", positive=True),
        help="of the law of least load",
    )
    words.add_argument(
        "--speed-window",
        metavar="PERCENT",
        type=_percent("--speed-window", 0.1, 90.0),
        help="how much slower than its speed the tool may be inside the window (default: 5)",
    )
    words.add_argument(
        "--share",
        metavar="PERCENT",
        type=_percent("--share", 1.0, 99.9),
        help="of the way on which the window is kept (default: 90)",
    )
    torque = "limits of the motors' torque: one number, or six (default: the specification's)"
    add_number(words, "--torque", "N·m", torque, positive=True, nargs="+")
    speed = "the same of their speed"
    add_number(words, "--speed", "rad/s", speed, positive=True, nargs="+")
    words.add_argument(
        "--line",
        action="store_true",
        help="torque and speed share: |τ|/stall + |ω|/no-load ≤ 1 (default: each for itself; with "
        "--motors they share)",
    )
    words.add_argument(
        "--motors",
        metavar="LIST",
        help="take torques, speeds and rotors from a list of servos, as size reads it",
    )
    words.add_argument(
        "--motor",
        metavar="NAME",
        nargs="+",
        help="which of the list: one name, or six in the motors' order (default: its only one)",
    )
    force = "largest force in each ball joint"
    add_number(words, "--loop-force", "N", force, positive=True)
    add_number(words, "--tool-speed", "m/s", "largest speed of the spray tip", positive=True)
    push = "largest acceleration of the spray tip"
    add_number(words, "--tool-acceleration", "m/s²", push, positive=True)
    add_samples(words, 2001)
    words.add_argument(
        "--to",
        metavar="FILE|-",
        help="write the path with its law: .toml, which trajectory, view and simulate read; .csv, "
        "a table of poses; .yaml, ROS's JointTrajectory",
    )
    add_report(words, "the law doesn't keep its limits between the places of its grid")


def _percent(flag: str, low: float, high: float) -> Callable[[str], float]:
    """An argparse type: a percentage as a share, with or without its sign."""
    read = number(flag, within=(low, high), unit="%")

    def share(text: str) -> float:
        return read(text.strip().removesuffix("%")) / 100.0

    return share
