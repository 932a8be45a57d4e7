"""Verbs and commands as data: what their parsers, their help and the tests are made from."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

from thesis_pin.command.exits import ExitCode
from thesis_pin.command.messages import say
from thesis_pin.command.parser import Parser
from thesis_pin.command.running import run
from thesis_pin.version import __version__

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

    def parser(self) -> Parser:
        """The command's parser with all its verbs."""
        top = Parser(
            prog=self.name,
            description=self.description,
            epilog=f"Example: {self.name} {self.verbs[0].example}",
        )
        top.add_argument("--version", action="version", version=f"{self.name} {__version__}")
        verbs = top.add_subparsers(title="verbs", required=True, metavar="VERB")
        for verb in self.verbs:
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
        words = sys.argv[1:] if arguments is None else list(arguments)
        if words and words[0] in self.moved:
            say(f"{self.name}: error: {words[0]} has moved; use: {self.moved[words[0]]}")
            return ExitCode.BAD_INPUT
        return run(self.parser(), words)


def found(name: str) -> object:
    """What ``module:name`` names; the name may have dots."""
    module, _, path = name.partition(":")
    thing: object = import_module(module)
    for part in path.split("."):
        thing = getattr(thing, part)
    return thing
