"""Where results go: files, standard output, the exit code; the same for all verbs."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from thesis_pin.command.flags.drawn_as import figure_style
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.registry import found
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.text import say
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput
from thesis_pin.files import Claim, is_standard_output, write_file, write_folder
from thesis_pin.report.tables import Part

if TYPE_CHECKING:  # help has to be quick
    import numpy as np
    from numpy.typing import NDArray

MOST_NAMED = 6
"""Files of a folder that are named when it is written."""


class Report(Protocol):
    """A report that can be written as JSON and as a table of samples."""

    @property
    def within_limits(self) -> bool | None:
        """Whether the robot can do it; None if the data don't carry a verdict."""

    def doubts(self) -> list[str]:
        """What is to be asked before its numbers are believed; said on standard error too."""

    def document(self) -> Mapping[str, object]:
        """The whole report, JSON-ready."""

    def columns(self) -> Mapping[str, NDArray[np.float64] | Sequence[str]]:
        """Its samples: column name → values."""


@dataclass(frozen=True)
class Answer:
    """What a verb found out.

    Attributes:
        document: Makes it JSON-ready.
        tell: Puts it for people.
        yes: Whether what was asked for is possible.
    """

    document: Callable[[], Mapping[str, object]]
    tell: Callable[[], Iterable[Part]]
    yes: bool = True


def give(
    arguments: argparse.Namespace, make: Callable[[], Answer], what: str = "working it out"
) -> ExitCode:
    """Write an answer where ``--json`` says; print it unless that is standard output.

    Args:
        arguments: With ``json``.
        make: Finds the answer.
        what: What is going on meanwhile, for a progress bar.
    """
    with Bar(what):
        from thesis_pin.report.writers import json_bytes

        answer = make()
        content = json_bytes(answer.document()) if arguments.json else b""
    if arguments.json:
        put(arguments.json, content)
    if free(arguments):
        print_parts(answer.tell())
    return ExitCode.DONE if answer.yes else ExitCode.NO


def deliver(
    arguments: argparse.Namespace,
    what: str,
    make: Callable[[Bar], Report],
    *,
    figures: str,
    page: str,
    table: str,
    strict: bool = False,
    keep: Callable[[dict[str, bytes]], dict[str, bytes]] = dict,
) -> ExitCode:
    """Put a report where ``--out``, ``--json`` and ``--html`` say, or on the terminal.

    Every content exists before the first file is written; but if a figure or the
    page fails, the data are written all the same.

    Args:
        arguments: With ``out``, ``json`` and ``html``, and ``strict`` unless that is always so.
        what: What is going on meanwhile, for a progress bar.
        make: Works the report out.
        figures: ``module:function`` of the report's files, by name.
        page: The same of its page.
        table: The same of its tables and paragraphs.
        strict: Whether the exit code is always that of the answer.
        keep: Chooses among the files of ``figures``.
    """
    from thesis_pin.report.plotting.wanted import written_as
    from thesis_pin.report.writers import csv_bytes, json_bytes

    style = figure_style(arguments)
    files: dict[str, bytes] = {}
    content = written = b""
    with Bar(what) as bar:
        answer = make(bar)
        if arguments.json or arguments.out:
            content = json_bytes(answer.document())
        if arguments.out:
            files = {"report.json": content, "samples.csv": csv_bytes(answer.columns())}
        try:
            drawn = {}
            if arguments.out:
                with written_as(style):
                    drawn = keep(_called(figures)(answer))
            if arguments.html:
                with warned():
                    written = _called(page)(answer)
        except Exception:  # the data took the time, and can be drawn anew
            write_results(arguments, files, content)
            raise
    write_results(arguments, files | drawn, content)
    if arguments.html:
        put(arguments.html, written)
    for doubt in answer.doubts():
        say(f"warning: {doubt}")
    if free(arguments):
        print_parts(_called(table)(answer))
    if answer.within_limits is None:
        say(str(getattr(answer, "reason", "The data don't carry a verdict.")))
        return ExitCode.BAD_INPUT
    refused = (strict or arguments.strict) and not answer.within_limits
    return ExitCode.NO if refused else ExitCode.DONE


def write_results(
    arguments: argparse.Namespace, files: Mapping[str, bytes], content: bytes
) -> None:
    """Write a folder of results where ``--out`` says, and its document where ``--json`` does."""
    if arguments.out:
        put_folder(arguments.out, files)
    if arguments.json:
        put(arguments.json, content)


def put(target: str, content: bytes) -> None:
    """Write a file, or standard output for ``-``, and say so."""
    write_file(target, content)
    said(target)


def check_new(target: str, *, replace: bool) -> None:
    """Refuse a file that is there already; before the work for it is done.

    Raises:
        BadInput: It is there, and ``replace`` is false.
    """
    if os.path.lexists(target) and os.path.isfile(target) and not replace:
        raise BadInput(
            "there is such a file already", where=target, remedy="Name another, or say --force"
        )


def put_new(target: str, content: bytes, *, replace: bool) -> None:
    """Write a file that isn't there yet, or standard output for ``-``, and say so.

    Raises:
        BadInput: See :func:`check_new`.
    """
    check_new(target, replace=replace)  # again: it may have come meanwhile
    put(target, content)


def put_folder(target: str | Claim, files: Mapping[str, bytes]) -> None:
    """Write a folder, and say what is in it."""
    write_folder(target, files)
    names = list(files)
    more = [f"and {len(names) - MOST_NAMED} more"] if len(names) > MOST_NAMED else []
    say(f"wrote {target}: {', '.join([*names[:MOST_NAMED], *more])}")


def said(target: str) -> None:
    """Say that a file was written; of standard output there is nothing to say."""
    if not is_standard_output(target):
        say(f"wrote {target}")


def _called(name: str) -> Any:
    return found(name)
