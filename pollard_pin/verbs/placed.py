"""What ``pollard-pin place`` does; imported when it runs."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence

import numpy as np

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.model import load
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.placing import Placement
from pollard_pin.report.document import TrajectoryReport, trajectory_report
from pollard_pin.specification import Specification
from pollard_pin.study.placement.limits import with_limits
from pollard_pin.study.placement.placements import Placements
from pollard_pin.study.placement.result import Found
from pollard_pin.study.placement.search import evaluate_placements
from pollard_pin.study.placement.told.document import columns, document
from pollard_pin.study.placement.told.words import told
from thesis_pin.command.flags.drawn_as import figure_style
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import put, write_results
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.text import say
from thesis_pin.command.warned import warned
from thesis_pin.model.made_for import MadeFor
from thesis_pin.report.plotting.wanted import Wanted, written_as
from thesis_pin.report.writers import csv_bytes, json_bytes

Place = Sequence[float] | None
Curve = Callable[[Specification, Place], tuple[ToolPath, Place]]
"""A specification, and where appendix B's curve is put → the path, and where it is still to go."""

_NOWHERE = (0.0, 0.0, 0.0)
_IMAGES: dict[str, tuple[bool, ...]] = {"no": (False,), "yes": (True,), "both": (False, True)}
_BOX = {"x": (0.15, 7), "y": (0.1, 5), "z": (0.15, 7)}
"""Half a box [m] and its values, about where a path stands."""

_DIGITS = 12  # of metres: 0.45 − 0.15 is 0.3


def place(arguments: argparse.Namespace, branch: Branch, curve: Curve) -> ExitCode:
    """Judge placements of a path, report on the best, and put it where the arguments say.

    Args:
        arguments: The parsed arguments.
        branch: Which solution.
        curve: Makes the path.
    """
    refuse_beside(arguments, "any-branch", ("branch",))
    style = figure_style(arguments)
    page, report = b"", None
    with Bar("judging placements") as bar, warned():
        space = _search(arguments, branch, curve, bar)
        if space.best:
            report = trajectory_report(space.robot, space.best_path, branch=space.best[0].branch)
        wanted = arguments.json or arguments.out
        content = json_bytes(document(space, report)) if wanted else b""
        files = {}
        if arguments.out:  # for the robot as it is, whichever limits were asked for
            own = MadeFor.of(Specification.read(arguments.specification))
            files = _files(space, report, content, style, own)
        if arguments.html:
            from pollard_pin.study.placement.told.page import placements_page

            page = placements_page(space, report)
    write_results(arguments, files, content)
    if arguments.html:
        put(arguments.html, page)
    for doubt in [] if report is None else report.doubts():
        say(f"warning: {doubt}")
    if free(arguments):
        print_parts(told(space, report))
    return ExitCode.DONE if space.best else ExitCode.NO


def _search(
    arguments: argparse.Namespace,
    branch: Branch,
    curve: Curve,
    progress: Callable[[int, int], None],
) -> Placements:
    robot = load(arguments.specification, inertia=arguments.inertia)
    path, _ = curve(robot.specification, _NOWHERE)
    path = path.followed_by(robot.specification)  # before limits make another robot of it
    robot = with_limits(robot, arguments.torque, arguments.speed)
    usual = robot.specification.assumptions.placement.position
    now = usual if arguments.path is None else _NOWHERE
    x, y, z = _ranges(arguments, now)
    turn = [0.0] if arguments.turn is None else arguments.turn.values(arguments.points)
    return evaluate_placements(
        robot,
        path,
        x=x,
        y=y,
        z=z,
        turn=np.radians(turn),
        mirrored=_IMAGES[arguments.mirror],
        branch="useful" if arguments.any_branch else branch,
        objective=arguments.objective,
        condition=arguments.condition,
        samples=arguments.samples,
        refine=not arguments.grid_only,
        best=arguments.best,
        start=Placement(now),
        start_branch=branch,
        progress=progress,
    )


def _ranges(arguments: argparse.Namespace, now: Sequence[float]) -> list[np.ndarray]:
    """Values of x, y, z [m]: what is asked for, or a box; beside what is asked for, one value."""
    given, asked = [getattr(arguments, name) for name in _BOX], arguments.turn is not None
    asked = asked or any(one is not None for one in given)
    found = []
    for one, here, (half, points) in zip(given, now, _BOX.values(), strict=True):
        if one is not None:
            found.append(one.values(arguments.points))
        elif asked:
            found.append(np.array([here]))
        else:
            found.append(np.round(np.linspace(here - half, here + half, points), _DIGITS))
    return found


def _files(
    space: Placements,
    report: TrajectoryReport | None,
    content: bytes,
    style: Wanted,
    own: MadeFor,
) -> dict[str, bytes]:
    from pollard_pin.study.placement.told.figures import placements_files

    files = {"placements.csv": csv_bytes(columns(space)), "placements.json": content}
    if report is not None:
        files["path.toml"] = _path_file(space.best[0], report, own).encode()
    with written_as(style):
        return files | placements_files(space)


def _path_file(best: Found, report: TrajectoryReport, own: MadeFor) -> str:
    """The path at the best placement: with the law that was found, or through its samples."""
    if best.law is None:
        from pollard_pin.motion.writing import path_toml

        return path_toml(report.path.name, report.motion, own)
    from pollard_pin.motion.law_file import law_toml

    return law_toml(report.path.name, best.law.course.track.chain, best.law.law, own)
