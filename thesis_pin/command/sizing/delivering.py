"""What ``size`` writes and prints where no list is held against a motion as it is timed."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Protocol

from thesis_pin.command.flags.drawn_as import figure_style
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import write_results
from thesis_pin.command.running import ExitCode, free
from thesis_pin.report.tables import Part

if TYPE_CHECKING:  # help has to be quick
    import numpy as np


class Found(Protocol):
    """An answer of ``size``."""

    @property
    def yes(self) -> bool:
        """Whether there are motors that do it."""

    def document(self, command: str) -> dict[str, object]:
        """JSON-ready."""

    def columns(self) -> Mapping[str, np.ndarray | list[str]]:
        """A table: column name → values."""

    def tables(self) -> Iterable[Part]:
        """Tables and paragraphs for people."""


def deliver(arguments: argparse.Namespace, command: str, make: Callable[[Bar], Found]) -> ExitCode:
    """Write and print which motors do a motion.

    Args:
        arguments: With ``out``, ``json`` and ``strict``.
        command: Which command asks, for the schema's name.
        make: Finds them.
    """
    from thesis_pin.report.plotting.wanted import written_as
    from thesis_pin.report.writers import csv_bytes, json_bytes
    from thesis_pin.sizing.smallest.answer import Answer
    from thesis_pin.sizing.smallest.figures import curve_files

    style = figure_style(arguments)
    files: dict[str, bytes] = {}
    with Bar("looking for the smallest motors") as bar:
        found = make(bar)
        wanted = arguments.json or arguments.out
        content = json_bytes(found.document(command)) if wanted else b""
        if arguments.out:
            files = {"report.json": content, "sizes.csv": csv_bytes(found.columns())}
            if isinstance(found, Answer):
                files |= found.files()
                if found.curve is not None:
                    files |= {"curve.csv": csv_bytes(found.curve.columns())}
                    with written_as(style):
                        files |= curve_files(found)
    write_results(arguments, files, content)
    if free(arguments):
        print_parts(found.tables())
    return ExitCode.NO if arguments.strict and not found.yes else ExitCode.DONE
