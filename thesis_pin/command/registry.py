"""Verbs, commands and robots' hooks as data: what parsers, help and tests are made from."""

from __future__ import annotations

import argparse
import re
import sys
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, NamedTuple, NoReturn

from thesis_pin.command.running import ExitCode, collect_seldom, run
from thesis_pin.command.text import clean, say
from thesis_pin.version import __version__

_PLAIN = r"(\d+\.?\d*|\.\d+)(e[-+]?\d+)?"
_NEGATIVE = re.compile(rf"-{_PLAIN}([:,][-+]?{_PLAIN})*|-inf(inity)?|-nan", re.IGNORECASE)
"""Words that begin with a minus and are values all the same, ranges too; ours to judge where not
finite."""


class Parser(argparse.ArgumentParser):
    """A parser whose help keeps its lines and whose words are never guessed at."""

    def __init__(
        self, *, prog: str | None = None, description: str = "", epilog: str = "", help: str = ""
    ) -> None:
        super().__init__(
            prog=prog,
            description="\n".join(textwrap.wrap(description, 79)),
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        self._mixed = False
        # argparse knows -1 and -0.5 but takes -1e-3 for a flag.
        self._negative_number_matcher = re.compile(f"(?:{_NEGATIVE.pattern})$", re.IGNORECASE)
        self.add_argument(
            "--debug",
            action="store_true",
            default=argparse.SUPPRESS,  # so that a verb's parser keeps what stood before it
            help="show the traceback of a mistake of ours",
        )

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> argparse.Namespace:
        """As argparse does, but refuse ``--flag=--``, of which argparse makes an empty list."""
        for word in sys.argv[1:] if args is None else args:
            if word.startswith("--") and word.endswith("=--"):
                self.error(f"argument {word[:-3]}: '--' is no value")
        return super().parse_args(args, namespace)

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """As argparse does; where words are left over, options may stand between the others.

        argparse gives an optional word nothing once an option follows the one before it.
        """
        found, left = super().parse_known_args(args, namespace)
        number = self._negative_number_matcher.match
        words = [word for word in left if word[:1] != "-" or number(word)]
        if not words or self._subparsers is not None or self._mixed:
            return found, left
        self._mixed = True
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self._mixed = False

    def error(self, message: str) -> NoReturn:
        """As argparse does, but without what a terminal would obey."""
        super().error(clean(message))


Arguments = argparse.Namespace
Words = argparse.ArgumentParser


@dataclass(frozen=True)
class Verb:
    """One verb of a command.

    Attributes:
        name: The word itself.
        help: One line for the command's help, without a full stop.
        description: What it does, a sentence.
        example: An invocation that works where the repository's ``examples`` and
            ``urdf`` are; the command's name is left out.
        python: The function that does the same, ``module:function``.
        run: Does it; ``module:function`` of the parsed arguments, imported when the
            verb runs so that help is quick, or a function that imports late itself.
        add: Add its options, from left to right.
    """

    name: str
    help: str
    description: str
    example: str
    python: str
    run: str | Callable[[Arguments], int]
    add: Sequence[Callable[[Words], None]]

    def __call__(self, arguments: Arguments) -> int:
        """Run it; returns the exit code."""
        call: Any = found(self.run) if isinstance(self.run, str) else self.run
        return int(call(arguments))


@dataclass(frozen=True)
class Command:
    """A command with its verbs.

    Attributes:
        name: What the user types.
        description: What it is for, a sentence.
        verbs: Its verbs in the order of its help.
        moved: Verbs that it had, and the command that has them now.
    """

    name: str
    description: str
    verbs: tuple[Verb, ...]
    moved: Mapping[str, str] = field(default_factory=dict)

    def parser(self, only: str | None = None) -> Parser:
        """The command's parser with all its verbs.

        Args:
            only: The one verb that is asked for, if that is known: it parses alike without the
                others, which take 2 ms.
        """
        top = Parser(
            prog=self.name,
            description=self.description,
            epilog=f"Example: {self.name} {self.verbs[0].example}",
        )
        top.add_argument("--version", action="version", version=f"{self.name} {__version__}")
        verbs = top.add_subparsers(title="verbs", required=True, metavar="VERB")
        for verb in self.verbs:
            if only not in (None, verb.name):
                continue
            words = verbs.add_parser(
                verb.name,
                help=verb.help,
                description=verb.description,
                epilog=f"Example: {self.name} {verb.example}\n"
                f"In Python: {verb.python.replace(':', '.')}",
            )
            for add in verb.add:
                add(words)
            words.set_defaults(run=verb)
        return top

    def main(self, arguments: Sequence[str] | None = None) -> int:
        """Run a command line; returns the exit code."""
        if arguments is None:  # the process ends with the command
            collect_seldom()
        words = sys.argv[1:] if arguments is None else list(arguments)
        if words and words[0] in self.moved:
            say(f"{self.name}: error: {words[0]} has moved; use: {self.moved[words[0]]}")
            return ExitCode.BAD_INPUT
        asked = next((word for word in words if word != "--debug"), None)
        known = any(verb.name == asked for verb in self.verbs)
        return run(self.parser(asked if known else None), words)


class Robot(NamedTuple):  # as a dataclass it takes 2 ms of every command's start
    """Where the common verbs find a robot's functions: ``module:function`` of its package.

    Attributes:
        package: Its package.
        another: What another specification may describe, for help.
        motion: Add the options that say which motion.
        motion_flag: The option of those that names a motion's file, without dashes.
        makes_report: Report on the motion that the arguments ask for; see
            :class:`thesis_pin.command.planning.MakeReport`.
        report: The public function behind it.
        moves: The motion that the arguments ask for, to be written down, a
            :class:`~thesis_pin.report.exchange.movement.Movement`.
        movement: The public function behind it.
        page: The report as a page.
        scene: The report as a scene.
        solves: Inverse kinematics that the arguments ask for, an
            :class:`~thesis_pin.command.results.Answer`.
        inverse_kinematics: The public method behind it.
        figures, table: The report as files, and in tables and paragraphs.
        figure_numbers: Names of its figures, each with its number in the thesis.
        load, specification: Read a specification, with its model and without.
        info: What it describes, see :mod:`thesis_pin.report.info`.
        info_page: The same as a page.
        still: What to show where no motion is asked for: a function of the arguments and the
            robot that returns a scene, or None to show the usual motion; empty for that.
        sliders: The robot with sliders, a function of the arguments and the robot that returns a
            :class:`thesis_pin.pages.live.page.LivePage`, and refuses what belongs to a motion.
        urdf, files: Its URDF in one reading, and everything generated from it.
        conditions: What a simulation is tried under, as the arguments say.
        simulation: A simulation of a report of the motion; the rest of its room,
            ``study.simulate``, has the same names in every robot's package.
        size: Servos or motors held against a report of the motion.
        smallest: The smallest of them of any size; in its module also ``time_with_motors``, how
            short the motion may be with those of a list, and ``motor_family``, the robot's own.
        walks: What ``size --walk`` does: a function of the arguments, the robot, a list or None
            and a progress; empty where there is no such flag.
        study: The study of designs that the arguments ask for, a function of them.
        sweep: The public function that makes one.
        thesis, audit: The thesis ready to be audited, and the function that does it.
    """

    package: str
    another: str
    motion: Callable[[Words], None]
    report: str
    page: str
    scene: str
    inverse_kinematics: str
    movement: str
    simulation: str
    motion_flag: str = ""
    makes_report: str = "verbs:report"
    moves: str = "verbs:motion"
    conditions: str = "verbs:conditions"
    solves: str = "verbs:ik"
    figures: str = "report.drawn.figures:figures"
    figure_numbers: str = "report.drawn.figures:NUMBERS"
    table: str = "report.tables:summary"
    load: str = "model:load"
    specification: str = "specification:Specification.read"
    info: str = "report.info:document"
    info_page: str = "report.info:page"
    still: str = ""
    sliders: str = "verbs:sliders"
    urdf: str = "urdf:urdf"
    files: str = "urdf:files"
    size: str = "study.size:size"
    smallest: str = "study.smallest.asking:smallest_motors"
    walks: str = ""
    study: str = "verbs.sweeping:study"
    sweep: str = ""
    audit: str = "thesis.audit:audit"
    thesis: str = "thesis.audit:THESIS"

    @property
    def command(self) -> str:
        """Name of its command."""
        return self.package.replace("_", "-")

    def name_of(self, hook: str) -> str:
        """A hook's full name, for :func:`found`."""
        return f"{self.package}.{hook}"


def found(name: str) -> object:
    """What ``module:name`` names; the name may have dots."""
    module, _, path = name.partition(":")
    thing: object = import_module(module)
    for part in path.split("."):
        thing = getattr(thing, part)
    return thing
