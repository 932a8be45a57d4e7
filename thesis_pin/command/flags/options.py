"""Options that several verbs share: the same words for the same flag in all commands."""

from __future__ import annotations

import argparse

from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_count, add_number
from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput


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
    text = "evenly spaced samples; more stand beside abrupt changes"
    add_count(words, "--samples", text, least=2, default=default)


def add_points(words: Words, default: int) -> None:
    """How finely a grid is divided."""
    add_count(words, "--points", "points an axis", least=2, default=default)


def add_friction(words: Words, default: float | None = 0.6) -> None:
    """How rough the floor is; None takes what the specification says."""
    text = "coefficient between sole and floor, at least 1e-6"
    text += " (default: the specification's)" if default is None else ""
    add_number(words, "--friction", "NUMBER", text, positive=True, default=default)


LISTS = "lists of servos: CSV, TOML, or parameter files of Rhoban's bam (.json)"
"""What a list of servos may be, for help."""


def add_json(words: Words, what: str) -> None:
    """Write ``what`` as JSON."""
    words.add_argument("--json", metavar="FILE|-", help=f"write {what} as JSON")


def add_report(words: Words, breaks: str) -> None:
    """Where a report goes; ``breaks`` says when ``--strict`` exits with 1."""
    words.add_argument("--out", metavar="DIR", help="write report.json, samples.csv and figures")
    add_figures(words)
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
    speed = "playing speed; 1 is real time"
    add_number(words, "--speed", "SPEED", speed, positive=True, default=1.0)
    port = "port on 127.0.0.1; 0 is any (default: the first free one from 7000)"
    add_count(words, "--port", port, least=0, most=65535, metavar="PORT")
    words.add_argument("--no-browser", action="store_true", help="only print the address")
    hold = "end by itself (default: on Ctrl-C)"
    add_number(words, "--hold", "SECONDS", hold, positive=True)
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
    samples = "evenly spaced samples; more stand beside abrupt changes (default: the motion's own, "
    own = "or 401; in our own format a gait's own curves)"
    add_count(words, "--samples", f"{samples}{own}", least=2)
    words.add_argument(
        "--servos",
        metavar="FILE",
        help="TOML of how servos count, for ticks (default: 500 to 2500 µs for ±90°)",
    )
    add_json(words, "what was written")


def add_jobs(words: Words) -> None:
    """How many threads or processes share the work."""
    text = "threads or processes that share the work"
    add_count(words, "--jobs", text, least=1, default=2)


def add_audit(words: Words) -> None:
    """The options of the verb ``audit``."""
    words.add_argument(
        "--equation", metavar="ID", help="explain one equation; also by its number or symbol"
    )
    words.add_argument("--every", action="store_true", help="list every failing line")
    add_json(words, "all rows")
    words.add_argument("--html", metavar="FILE|-", help="write a page with rendered formulas")
    words.add_argument("--markdown", metavar="FILE|-", help="write the audit as a document")
    words.add_argument("--errata", metavar="FILE|-", help="write errata to send to the author")
    words.add_argument("--language", choices=("en", "es"), help="of the errata (default: en)")
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
