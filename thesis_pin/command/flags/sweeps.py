"""Options of ``sweep``: what varies, who judges it, what is wanted of the designs."""

from __future__ import annotations

from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_count
from thesis_pin.command.flags.options import add_json
from thesis_pin.command.registry import Words


def add_designs(words: Words) -> None:
    """What varies, and how designs are made of it."""
    words.add_argument(
        "--vary",
        action="append",
        metavar="KEY=VALUES",
        help="let a key vary: legs.*.x_3=0.06:0.09:10 (from, to, how many), "
        "servos.*.stall_torque=0.3,0.5,0.8, torso.mass=80%%:120%%:5 (of what it is), "
        "KEY=@FILE (one value a line); again for another one",
    )
    words.add_argument(
        "--designs",
        metavar="FILE",
        help="a table of designs: a column a key, a row a design; with --vary each of its designs "
        "with each of those",
    )
    words.add_argument(
        "--pair",
        action="store_true",
        help="first values of all --vary together, then second ones, …, instead of every "
        "combination",
    )
    draw = "draw N designs, one in each N-th part of every range (a Latin hypercube)"
    add_count(words, "--draw", draw, least=1)
    words.add_argument("--random", action="store_true", help="draw them anywhere instead")
    seed = "of the draws; the same seed draws the same robots"
    add_count(words, "--seed", seed, least=0, default=0)
    words.add_argument(
        "--keys",
        metavar="PATTERN",
        help="list keys that can vary, with what they are, and end; '*' lists all",
    )


def add_wishes(words: Words) -> None:
    """What is wanted of the designs."""
    words.add_argument(
        "--measure",
        action="append",
        metavar="NAME",
        help="work out a column that takes longer too; those of --pareto and --wish are anyway",
    )
    words.add_argument(
        "--pareto",
        metavar="COLUMNS",
        help="two or three columns to hold designs against each other by, as peak_torque,mass or "
        "min:KEY,max:COLUMN",
    )
    words.add_argument(
        "--wish",
        metavar="TERMS",
        help="what the chosen design should be like, in the columns' units: servo_use<0.9,mass=1.2",
    )


def add_running(words: Words) -> None:
    """Who does the work, and where the results go."""
    jobs = "threads or processes that share the work (default: one a processor)"
    add_count(words, "--jobs", jobs, least=1, most=4096)
    words.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="a Dask scheduler whose workers share it instead, as tcp://127.0.0.1:8786",
    )
    words.add_argument("--resume", action="store_true", help="go on with what stands in --out")
    words.add_argument(
        "--dry-run", action="store_true", help="say which designs there are and how long it takes"
    )
    words.add_argument(
        "--out",
        metavar="DIR",
        help="write every row as it is done (Parquet), then designs.csv, report.json, a Pareto "
        "picture and the best design as best.toml",
    )
    add_figures(words)
    add_json(words, "the answer with every row")
    words.add_argument("--html", metavar="FILE|-", help="write the answer as a page to mail")
    words.add_argument(
        "--strict",
        action="store_true",
        help="exit with 1 if no design keeps every limit, or the wish is missed",
    )
