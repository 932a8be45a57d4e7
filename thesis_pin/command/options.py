"""Words that both commands' verbs share; each robot's ``cli.py`` adds its own."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from importlib import import_module

from thesis_pin.command.parser import count, number


def later(module: str, name: str) -> Callable[[argparse.Namespace], int]:
    """A verb of a module that is imported when the verb runs, so that help is quick."""

    def call(arguments: argparse.Namespace) -> int:
        return int(getattr(import_module(module), name)(arguments))

    return call


def add_robot(verb: argparse.ArgumentParser, another: str) -> None:
    """Which robot: ``another`` says what a specification may describe."""
    verb.add_argument(
        "--specification", metavar="FILE", help=f"TOML of {another} (default: the thesis's)"
    )
    verb.add_argument(
        "--inertia",
        choices=("physical", "printed"),
        default="physical",
        help="reading of the printed inertias (default: physical)",
    )


def add_json(verb: argparse.ArgumentParser, what: str) -> None:
    """Write ``what`` as JSON."""
    verb.add_argument("--json", metavar="FILE|-", help=f"write {what} as JSON")


def add_report_options(verb: argparse.ArgumentParser, breaks: str) -> None:
    """Where a report goes; ``breaks`` says when ``--strict`` exits with 1."""
    verb.add_argument("--out", metavar="DIR", help="write report.json, samples.csv and figures")
    add_json(verb, "the report")
    verb.add_argument(
        "--html", metavar="FILE", help="write the report as a page to mail: animation and plots"
    )
    verb.add_argument("--strict", action="store_true", help=f"exit with 1 if {breaks}")


def add_view_options(verb: argparse.ArgumentParser) -> None:
    """The options every ``view`` verb has besides its motion's."""
    verb.add_argument(
        "--speed",
        type=number("--speed", positive=True),
        default=1.0,
        help="playing speed; 1 is real time (default: 1)",
    )
    verb.add_argument(
        "--port",
        type=count("--port", 0),
        help="port on 127.0.0.1; 0 is any (default: the first free one from 7000)",
    )
    verb.add_argument("--no-browser", action="store_true", help="only print the address")
    verb.add_argument(
        "--hold",
        type=number("--hold", positive=True),
        metavar="SECONDS",
        help="end by itself (default: on Ctrl-C)",
    )
    verb.add_argument(
        "--html", metavar="FILE", help="write one self-contained page instead of serving it"
    )
