"""Options that several verbs share: the same words for the same flag in all commands."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import MOST, shown


def number(
    name: str, *, positive: bool = False, within: tuple[float, float] | None = None, unit: str = ""
) -> Callable[[str], float]:
    """An argparse type: a finite number, optionally positive, or between two bounds.

    Args:
        name: The flag.
        positive: Whether it is above zero.
        within: Least and greatest value.
        unit: What it counts, for messages.
    """
    low, high = within or (-math.inf, math.inf)
    allowed = "a positive number" if positive else "a finite number"
    if within is not None:
        allowed = f"{low:g} to {high:g} {unit}".rstrip()

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and low <= value <= high) or (positive and value <= 0):
            raise argparse.ArgumentTypeError(f"{name} is {shown(text)}; allowed: {allowed}")
        return value

    return read


def count(name: str, least: int, most: int = MOST) -> Callable[[str], int]:
    """An argparse type: a whole number from ``least`` to ``most``."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = least - 1
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(
                f"{name} is {shown(text)}; allowed: a whole number of at least {least}"
                + (f", at most {most}" if value > most else "")
            )
        return value

    return read


def quantity(flag: str, text: str) -> float:
    """A number among the words of a flag.

    Raises:
        BadInput: It is none, or not finite.
    """
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise BadInput(f"{flag} has {shown(text)}", allowed="a finite number")
    return value


def wrench(text: str) -> tuple[str, tuple[float, ...]]:
    """An argparse type: ``FRAME=fx,fy,fz``, three more numbers for a moment."""
    frame, _, values = text.rpartition("=")
    numbers = []
    for value in values.split(","):
        try:
            numbers.append(float(value))
        except ValueError:
            numbers.append(math.nan)
    if not frame or len(numbers) not in (3, 6) or not all(map(math.isfinite, numbers)):
        raise argparse.ArgumentTypeError(
            f"--external is {shown(text)}; allowed: FRAME=fx,fy,fz or FRAME=fx,fy,fz,mx,my,mz [N], "
            "[N·m]"
        )
    return frame, (*numbers, 0.0, 0.0, 0.0)[:6]


def slope(text: str) -> tuple[float, float]:
    """An argparse type: a floor's slope, and the heading in which it rises [°]."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = [math.nan]
    if len(numbers) > 2 or not all(map(math.isfinite, numbers)) or not 0 <= numbers[0] < 89:
        raise argparse.ArgumentTypeError(
            f"--slope is {shown(text)}; allowed: DEG or DEG,HEADING, DEG from 0 to below 89 [°]"
        )
    return numbers[0], (*numbers, 0.0)[1]


def add_robot(words: Words, another: str) -> None:
    """Which robot: ``another`` says what a specification may describe."""
    words.add_argument(
        "--specification", metavar="FILE", help=f"TOML of {another} (default: the thesis's)"
    )
    words.add_argument(
        "--inertia",
        choices=("physical", "printed"),
        default="physical",
        help="reading of the printed inertias (default: physical)",
    )


def add_branch(words: Words, signs: str, default: str) -> None:
    """Which solution of inverse kinematics; ``signs`` says what its signs mean."""
    words.add_argument("--branch", metavar="SIGNS", help=f"{signs} (default: {default})")


def add_smooth(words: Words) -> None:
    """How finely samples are to be read."""
    words.add_argument(
        "--smooth",
        metavar="auto|none|LENGTH",
        default="auto",
        help="samples are as fine as they show (auto) or exact (none), or no finer than a "
        "length such as 0.1mm, an angle such as 0.05deg, or 0.1mm,0.05deg (default: auto)",
    )


def add_euler(words: Words) -> None:
    """In which order angles turn."""
    words.add_argument(
        "--euler",
        metavar="ORDER",
        help="order of the angles in columns a, b, c (or about rx, ry, rz): ZYX turns about z, "
        "then the turned y, then the turned x; zyx about the fixed axes. Columns psi, theta, phi "
        "are Rx(θ) Ry(ψ) Rz(φ)",
    )


def add_frame(words: Words) -> None:
    """Which frame leads the robot."""
    words.add_argument(
        "--frame",
        metavar="NAME",
        help="a frame of the robot: its x, y, z, roll, pitch, yaw, or as many of them as the robot "
        "has freedoms, lead the robot (default: joints do)",
    )


def add_samples(words: Words, default: int) -> None:
    """At how many samples a motion is worked out."""
    words.add_argument(
        "--samples",
        type=count("--samples", 2),
        default=default,
        metavar="N",
        help=f"evenly spaced samples; more stand beside abrupt changes (default: {default})",
    )


def add_points(words: Words, default: int) -> None:
    """How finely a grid is divided."""
    words.add_argument(
        "--points",
        type=count("--points", 2),
        default=default,
        metavar="N",
        help=f"points an axis (default: {default})",
    )


def add_friction(words: Words) -> None:
    """How rough the floor is."""
    words.add_argument(
        "--friction",
        type=number("--friction", positive=True),
        default=0.6,
        metavar="NUMBER",
        help="coefficient between sole and floor, at least 1e-6 (default: 0.6)",
    )


LISTS = "lists of servos: CSV, TOML, or parameter files of Rhoban's bam (.json)"
"""What a list of servos may be, for help."""


def add_sizing(words: Words) -> None:
    """How lists of servos are held against a motion."""
    words.add_argument(
        "--voltage",
        type=number("--voltage", positive=True),
        metavar="V",
        help="take those for this voltage (default: all)",
    )
    words.add_argument(
        "--factor",
        type=number("--factor", positive=True),
        default=1.0,
        help="least safety factor against the torque-speed line (default: 1)",
    )
    words.add_argument("--out", metavar="DIR", help="write report.json and sizes.csv")
    add_json(words, "the answer")
    words.add_argument(
        "--strict",
        action="store_true",
        help="exit with 1 if some joint has no servo that carries it for long",
    )


def add_json(words: Words, what: str) -> None:
    """Write ``what`` as JSON."""
    words.add_argument("--json", metavar="FILE|-", help=f"write {what} as JSON")


def add_report(words: Words, breaks: str) -> None:
    """Where a report goes; ``breaks`` says when ``--strict`` exits with 1."""
    words.add_argument("--out", metavar="DIR", help="write report.json, samples.csv and figures")
    add_json(words, "the report")
    words.add_argument(
        "--html", metavar="FILE|-", help="write the report as a page to mail: animation and plots"
    )
    words.add_argument("--strict", action="store_true", help=f"exit with 1 if {breaks}")


def add_info(words: Words) -> None:
    """The options of the verb ``info`` besides the robot's."""
    words.add_argument("--html", metavar="FILE|-", help="write it as a page to mail")
    words.add_argument(
        "--strict", action="store_true", help="refuse sizes that nobody builds (exit code 2)"
    )


def add_view(words: Words) -> None:
    """The options every ``view`` verb has besides its motion's."""
    words.add_argument(
        "--speed",
        type=number("--speed", positive=True),
        default=1.0,
        help="playing speed; 1 is real time (default: 1)",
    )
    words.add_argument(
        "--port",
        type=count("--port", 0, 65535),
        help="port on 127.0.0.1; 0 is any (default: the first free one from 7000)",
    )
    words.add_argument("--no-browser", action="store_true", help="only print the address")
    words.add_argument(
        "--hold",
        type=number("--hold", positive=True),
        metavar="SECONDS",
        help="end by itself (default: on Ctrl-C)",
    )
    words.add_argument(
        "--html", metavar="FILE|-", help="write one self-contained page instead of serving it"
    )
    add_json(words, "what is shown, and where")


def add_convert(words: Words) -> None:
    """The options of the verb ``convert``, besides its motion's."""
    words.add_argument(
        "--to",
        metavar="FILE|-",
        default="-",
        help=".csv: a table, .toml: our own format, .yaml: ROS's JointTrajectory "
        "(default: standard output)",
    )
    words.add_argument(
        "--as",
        dest="form",
        choices=("poses", "joints", "toml", "joint-trajectory", "ticks"),
        help="what is written (default: what FILE's ending says; of tables, poses)",
    )
    words.add_argument(
        "--units",
        metavar="UNITS",
        help="of tables, as mm,deg,ms (default: SI; of m mm cm, rad deg, s ms us)",
    )
    words.add_argument(
        "--samples",
        type=count("--samples", 2),
        metavar="N",
        help="evenly spaced samples; more stand beside abrupt changes (default: the motion's own, "
        "or 401)",
    )
    words.add_argument(
        "--servos",
        metavar="FILE",
        help="TOML of how servos count, for ticks (default: 500 to 2500 µs for ±90°)",
    )
    add_json(words, "what was written")


def add_jobs(words: Words) -> None:
    """How many threads or processes share the work."""
    words.add_argument(
        "--jobs",
        type=count("--jobs", 1),
        default=2,
        metavar="N",
        help="threads or processes that share the work (default: 2)",
    )


def add_audit(words: Words) -> None:
    """The options of the verb ``audit``."""
    words.add_argument(
        "--equation", metavar="ID", help="explain one equation; also by its number or symbol"
    )
    words.add_argument("--every", action="store_true", help="list every failing line")
    add_json(words, "all rows")
    words.add_argument("--html", metavar="FILE|-", help="write a page with rendered formulas")
    words.add_argument("--markdown", metavar="FILE|-", help="write the audit as a document")
    add_jobs(words)


def refuse_beside(arguments: argparse.Namespace, flag: str, others: tuple[str, ...]) -> None:
    """Refuse flags that mean nothing beside another.

    Args:
        arguments: The parsed arguments; flags that weren't given are None or False.
        flag: The flag that rules the others out, without dashes.
        others: These.

    Raises:
        BadInput: ``flag`` and one of the others are given.
    """

    def given(name: str) -> bool:
        value = getattr(arguments, name.replace("-", "_"))
        return value is not None and value is not False  # port 0 is one

    for other in others:
        if given(flag) and given(other):
            raise BadInput(
                f"--{other} means nothing beside --{flag}", remedy="Leave one of them out"
            )
