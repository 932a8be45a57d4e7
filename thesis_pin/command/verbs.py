"""What the verbs of several commands do alike: report, show, answer, print a URDF."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from thesis_pin.command.options import refuse_beside
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.registry import Robot, found
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.text import say
from thesis_pin.files import is_standard_output, write_file, write_folder
from thesis_pin.report.tables import Part

if TYPE_CHECKING:  # help has to be quick
    import numpy as np
    from numpy.typing import NDArray

    from thesis_pin.pages.scene import Scene


class Report(Protocol):
    """A report that can be written as JSON and as a table of samples."""

    @property
    def within_limits(self) -> bool:
        """Whether the robot can do it."""

    def document(self) -> Mapping[str, object]:
        """The whole report, JSON-ready."""

    def columns(self) -> Mapping[str, NDArray[np.float64] | Sequence[str]]:
        """Its samples: column name → values."""


class MakeReport(Protocol):
    """What a robot's hook ``makes_report`` is."""

    def __call__(
        self,
        arguments: argparse.Namespace,
        robot: object,
        samples: Callable[[float], int],
        progress: Callable[[int, int], None],
    ) -> Report:
        """The report on the motion that the arguments ask for.

        Args:
            arguments: The parsed arguments.
            robot: The robot they ask for.
            samples: The motion's duration [s] → number of samples.
            progress: Told the steps done and their total.
        """


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
        write_file(arguments.json, content)
    if free(arguments):
        print_parts(answer.tell())
    return ExitCode.DONE if answer.yes else ExitCode.NO


def report(robot: Robot, arguments: argparse.Namespace, what: str) -> ExitCode:
    """Report on a motion that the robot's own options ask for; see :func:`deliver`."""
    return deliver(
        arguments,
        what,
        lambda bar: _report(robot, arguments, lambda _: arguments.samples, bar),
        figures=robot.name_of(robot.figures),
        page=robot.name_of(robot.page),
        table=robot.name_of(robot.table),
    )


def deliver(
    arguments: argparse.Namespace,
    what: str,
    make: Callable[[Bar], Report],
    *,
    figures: str,
    page: str,
    table: str,
) -> ExitCode:
    """Put a report where ``--out``, ``--json`` and ``--html`` say, or on the terminal.

    Every content exists before the first file is written; but if a figure or the
    page fails, the data are written all the same.

    Args:
        arguments: With ``out``, ``json``, ``html`` and ``strict``.
        what: What is going on meanwhile, for a progress bar.
        make: Works the report out.
        figures: ``module:function`` of the report's files, by name.
        page: The same of its page.
        table: The same of its tables and paragraphs.
    """
    from thesis_pin.report.writers import csv_bytes, json_bytes

    files: dict[str, bytes] = {}
    content = written = b""
    with Bar(what) as bar:
        answer = make(bar)
        if arguments.json or arguments.out:
            content = json_bytes(answer.document())
        if arguments.out:
            files = {"report.json": content, "samples.csv": csv_bytes(answer.columns())}
        try:
            drawn = _called(figures)(answer) if arguments.out else {}
            written = _called(page)(answer) if arguments.html else b""
        except Exception:
            _deliver(arguments, files, content)
            raise
    _deliver(arguments, files | drawn, content)
    if arguments.html:
        write_file(arguments.html, written)
    if free(arguments):
        print_parts(_called(table)(answer))
    refused = arguments.strict and not answer.within_limits
    return ExitCode.NO if refused else ExitCode.DONE


def _deliver(arguments: argparse.Namespace, files: Mapping[str, bytes], content: bytes) -> None:
    """Write a report's folder and its document."""
    if arguments.out:
        write_folder(arguments.out, files)
        say(f"wrote {arguments.out}")
    if arguments.json:
        write_file(arguments.json, content)


def view(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Show a motion in the browser, or write it as a page."""
    refuse_beside(arguments, "html", ("port", "hold", "no-browser"))
    with Bar("working out the motion") as bar:
        from thesis_pin.pages.scene import frames
        from thesis_pin.report.writers import json_bytes

        scene: Scene = _hook(robot, robot.scene)(_report(robot, arguments, frames, bar))
    shown = {
        "schema": f"{robot.command}/view",
        "version": 1,
        "title": scene.title,
        "duration": float(scene.time[-1] - scene.time[0]),
        "samples": len(scene.time),
        "page": arguments.html,
    }
    from thesis_pin.pages import player, serving

    if arguments.html:
        player.write_html(scene, arguments.html, speed=arguments.speed)
        if not is_standard_output(arguments.html):
            say(f"wrote {arguments.html}")
        if arguments.json:
            write_file(arguments.json, json_bytes(shown | {"address": None}))
        return ExitCode.DONE

    def ready(address: str) -> None:
        if arguments.json:
            write_file(arguments.json, json_bytes(shown | {"address": address}))

    serving.show(
        scene,
        speed=arguments.speed,
        port=arguments.port,
        browser=not arguments.no_browser,
        hold=arguments.hold,
        say=say,
        ready=ready,
    )
    return ExitCode.DONE


def ik(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Inverse kinematics of one pose."""
    return give(arguments, lambda: _hook(robot, robot.solves)(arguments, _load(robot, arguments)))


def info(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Say what a specification describes."""
    from thesis_pin.report.info import told

    def answer() -> Answer:
        document = _hook(robot, robot.info)(_load(robot, arguments))
        return Answer(lambda: document, lambda: told(document))

    return give(arguments, answer)


def urdf(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Print a URDF, or write every generated file into ``--out``."""
    with Bar("generating the files"):
        from thesis_pin.model.loading import check_urdf
        from thesis_pin.report.writers import json_bytes

        specification = _hook(robot, robot.specification)(arguments.specification)
        text: str = _hook(robot, robot.urdf)(specification, arguments.inertia)
        check_urdf(text, where=specification.name)
        made = _hook(robot, robot.files)(specification)
        files = {name: content.encode() for name, content in made.items()}
    document = {
        "schema": f"{robot.command}/urdf",
        "version": 1,
        "robot": specification.name,
        "inertia": arguments.inertia,
        "folder": str(arguments.out) if arguments.out else None,
        "files": [{"name": name, "bytes": len(content)} for name, content in files.items()],
    }
    if arguments.out:
        write_folder(arguments.out, files)
        say(f"wrote {', '.join(files)} to {arguments.out}")
    if arguments.json:
        write_file(arguments.json, json_bytes(document))
    if not arguments.out and free(arguments):
        write_file("-", text.encode())
    return ExitCode.DONE


def audit(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """A verdict on each printed equation of the thesis."""
    from thesis_pin.command.audit import run_verb

    refuse_beside(arguments, "equation", ("every",))
    return run_verb(arguments, _hook(robot, robot.thesis))


def _hook(robot: Robot, name: str) -> Any:
    """One of the robot's functions, imported when it is needed."""
    return _called(robot.name_of(name))


def _called(name: str) -> Any:
    return found(name)


def _load(robot: Robot, arguments: argparse.Namespace) -> Any:
    return _hook(robot, robot.load)(arguments.specification, inertia=arguments.inertia)


def _report(
    robot: Robot,
    arguments: argparse.Namespace,
    samples: Callable[[float], int],
    progress: Callable[[int, int], None],
) -> Report:
    make: MakeReport = _hook(robot, robot.makes_report)
    return make(arguments, _load(robot, arguments), samples, progress)
