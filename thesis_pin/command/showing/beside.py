"""``--beside``: a second motion, or the same one on a second robot, beside the first."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypedDict

from thesis_pin.command.registry import Robot, Words, found
from thesis_pin.command.results import Report
from thesis_pin.errors import BadInput
from thesis_pin.report.tables import Part

if TYPE_CHECKING:  # help has to be quick
    import numpy as np
    from numpy.typing import NDArray

    from thesis_pin.pages.alignment import Alignment
    from thesis_pin.pages.scene import Scene


class Hooks(NamedTuple):
    """Where the parts of a report are, ``module:function`` each.

    Attributes:
        page: The report as a :class:`thesis_pin.pages.page.Page`.
        tiles: Its numbers at the top of that.
        poses: Its model, visual geometry, times and configurations.
        scene: The report as a scene.
        figures: Its files.
        table: Its tables and paragraphs.
        phases: What has its like in other motions, as
            :class:`thesis_pin.pages.alignment.Phase`; empty if nothing has.
    """

    page: str
    tiles: str
    poses: str
    scene: str
    figures: str
    table: str
    phases: str = ""


ANY = Hooks(
    "thesis_pin.pages.reports.torque:page_of",
    "thesis_pin.pages.reports.torque:tiles",
    "thesis_pin.pages.reports.torque_scene:poses",
    "thesis_pin.pages.reports.torque_scene:scene",
    "thesis_pin.report.torque.figures:figures",
    "thesis_pin.report.torque.tables:summary",
)
"""Of any robot's torque report."""


def hooks_of(robot: Robot) -> Hooks:
    """Of a robot's own report."""
    names = (
        "report.drawn.page:page_of",
        "report.drawn.page:tiles",
        "report.drawn.view:poses",
        robot.scene,
        robot.figures,
        robot.table,
        "report.drawn.phases:phases",
    )
    return Hooks(*(robot.name_of(name) for name in names))


def add_beside(words: Words) -> None:
    """The option that names a second motion."""
    words.add_argument(
        "--beside",
        metavar="FILE",
        help="a second motion, translucent and dashed beside the first, from the same start; "
        "--strict asks for the first",
    )


def add_beside_robot(words: Words) -> None:
    """The option that names a second robot."""
    words.add_argument(
        "--beside-robot",
        metavar="FILE",
        help="specification of the robot that moves beside the first, by --beside or as the first",
    )


def add_align(words: Words) -> None:
    """The option that says how two motions' times go together."""
    words.add_argument(
        "--align",
        choices=("time", "phase"),
        help="a motion beside: from the same start (time, the default), or in the same phase of "
        "steps or share of the path (phase)",
    )


def asked(arguments: argparse.Namespace) -> bool:
    """Whether something is to be shown beside the first motion.

    Raises:
        BadInput: Nothing is, and it is said how.
    """
    beside = any(getattr(arguments, name, None) is not None for name in ("beside", "beside_robot"))
    if getattr(arguments, "align", None) is not None and not beside:
        raise BadInput("--align belongs to --beside", remedy="Add --beside FILE, or leave it out")
    return beside


def second_of(arguments: argparse.Namespace, motion: str) -> argparse.Namespace:
    """What the second motion would have been asked for by.

    Args:
        arguments: The parsed arguments.
        motion: Name of the one that says which motion.
    """
    other = argparse.Namespace(**vars(arguments))
    if arguments.beside is not None:
        setattr(other, motion, arguments.beside)
        for own in ("duration", "placement"):  # of a curve without a file
            if hasattr(other, own):
                setattr(other, own, None)
    if getattr(arguments, "beside_robot", None) is not None:
        other.specification = arguments.beside_robot
    return other


class Outputs(TypedDict):
    """What writes and tells a report, ``module:function`` each."""

    figures: str
    page: str
    table: str


_HERE = "thesis_pin.command.showing.beside:"
TWO = Outputs(figures=f"{_HERE}figures", page=f"{_HERE}page", table=f"{_HERE}summary")
"""What writes and tells two reports."""


@dataclass(frozen=True)
class Beside:
    """Two reports, of which the first is the one that was asked for.

    Attributes:
        hooks: Where their parts are.
        first, second: The reports.
        names: What they are called.
        alignment: How their times go together.
    """

    hooks: Hooks
    first: Report
    second: Report
    names: tuple[str, str]
    alignment: Alignment

    @property
    def within_limits(self) -> bool | None:
        """Of the first."""
        return self.first.within_limits

    @property
    def reason(self) -> str | None:
        """Why the first one's data carry no verdict."""
        why: str | None = getattr(self.first, "reason", None)
        return why

    @property
    def durations(self) -> tuple[float, float]:
        """Of both [s]."""
        first, second = (_of(self.hooks.poses)(one)[2] for one in self._both)
        return float(first[-1] - first[0]), float(second[-1] - second[0])

    @property
    def _both(self) -> tuple[Report, Report]:
        return self.first, self.second

    def doubts(self) -> list[str]:
        """Of both, by name."""
        return [
            f"{name}: {doubt}"
            for name, one in zip(self.names, self._both, strict=True)
            for doubt in one.doubts()
        ]

    def document(self) -> Mapping[str, object]:
        """The first one's, with the second one's in it."""
        second = {"names": list(self.names), **self.alignment.document()}
        return {
            **self.first.document(),
            "beside": second | {"report": self.second.document()},
        }

    def columns(self) -> Mapping[str, NDArray[np.float64] | Sequence[str]]:
        """The first one's samples."""
        return self.first.columns()


def reports(
    hooks: Hooks,
    first: Report,
    second: Report,
    align: str | None = None,
    files: tuple[str | None, str | None] = (None, None),
) -> Beside:
    """Two reports side by side, called by their motions, else their robots, else their files.

    Args:
        hooks: Where their parts are.
        first: The first one.
        second: The second one.
        align: ``phase``, or from the same start.
        files: Of the motions, where they have any.

    Raises:
        BadInput: They have no phases in common.
    """
    from thesis_pin.pages.alignment import by_phase, by_time

    if align == "phase":
        alignment = by_phase(*(_of(hooks.phases)(one) for one in (first, second)))
    else:
        alignment = by_time(*(_of(hooks.poses)(one)[2] for one in (first, second)))
    told = [one.parameters for one in (first, second)]  # type: ignore[attr-defined]
    motions = [next(str(p[k]) for k in ("gait", "path", "motion") if k in p) for p in told]
    robots = [str(p["robot"]) for p in told]
    names = motions if motions[0] != motions[1] else robots
    if names[0] == names[1] and all(files):
        names = [Path(str(file)).name for file in files]
    if names[0] == names[1]:
        names = [names[0], f"{names[1]}, second"]
    return Beside(hooks, first, second, (names[0], names[1]), alignment)


def scene_of(both: Beside) -> Scene:
    """The first one's scene, the second one as its ghost."""
    from thesis_pin.pages.beside import with_second

    drawn = _of(both.hooks.scene)(both.first)
    model, geometry, time, q = _of(both.hooks.poses)(both.second)
    return with_second(drawn, model, geometry, time, q, both.names[1], both.alignment)


def page(both: Beside) -> bytes:
    """Both in one page."""
    from dataclasses import replace

    from thesis_pin.pages.beside import beside_page
    from thesis_pin.pages.page import html

    first, second = (_of(both.hooks.page)(one) for one in (both.first, both.second))
    first = replace(first, scene=scene_of(both))
    return html(beside_page(first, second, both.names, both.durations, both.alignment))


def figures(both: Beside) -> dict[str, bytes]:
    """Files of both; the second one's begin with ``beside_``."""
    from thesis_pin.report.writers import csv_bytes

    draw = _of(both.hooks.figures)
    files: dict[str, bytes] = dict(draw(both.first))
    second = {**draw(both.second), "samples.csv": csv_bytes(both.second.columns())}
    return files | {f"beside_{name}": content for name, content in second.items()}


def summary(both: Beside) -> list[Part]:
    """What is told of the first, then verdicts and worst numbers of both side by side."""
    from thesis_pin.pages.beside import side_by_side

    first, second = (_of(both.hooks.tiles)(one) for one in (both.first, both.second))
    good = (both.first.within_limits, both.second.within_limits)
    return [
        *_of(both.hooks.table)(both.first),
        side_by_side(good, (first, second), both.names, both.durations),
        both.alignment.said(both.names, both.durations),
    ]


def _of(name: str) -> Callable[..., Any]:
    function: Any = found(name)
    return function  # type: ignore[no-any-return]
