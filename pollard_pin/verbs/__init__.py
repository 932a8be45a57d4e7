"""What the verbs of ``pollard-pin`` do that only Pollard does; imported when a verb runs."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, USEFUL_BRANCHES, Branch
from pollard_pin.model import Pollard, load
from pollard_pin.motion.path import ToolPath
from pollard_pin.specification import Specification
from thesis_pin.command.flags.drawn_as import figure_style
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import Answer, give, write_results
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.showing.words import refuse_set, shown_by
from thesis_pin.command.verbs.simulate import tried
from thesis_pin.errors import BadInput, Unreachable
from thesis_pin.report.tables import Table

if TYPE_CHECKING:  # reports need none of it
    from pollard_pin.report.document import TrajectoryReport
    from pollard_pin.study.simulate.conditions import Conditions
    from thesis_pin.pages.live.page import LivePage
    from thesis_pin.report.exchange.movement import Movement


def _branch(arguments: argparse.Namespace) -> Branch:
    return DEFAULT_BRANCH if arguments.branch is None else Branch.parse(arguments.branch)


def _path(arguments: argparse.Namespace, specification: Specification) -> ToolPath:
    """The path that the arguments name, where they put it."""
    path, position = _curve(arguments, specification, arguments.placement)
    if position is None and arguments.turn is None and not arguments.mirror:
        return path
    from pollard_pin.motion.placing import Placement, place_path

    turn = math.radians(arguments.turn or 0.0)
    return place_path(path, Placement.of(position or (0.0, 0.0, 0.0), turn, arguments.mirror))


def _curve(
    arguments: argparse.Namespace, specification: Specification, place: Sequence[float] | None
) -> tuple[ToolPath, Sequence[float] | None]:
    """A path, and where it is still to be put: appendix B's curve is put there already."""
    if arguments.path is None:
        from pollard_pin.motion.curves import appendix_b

        for flag, value in (("euler", arguments.euler), ("feed", arguments.feed)):
            if value is not None:
                raise BadInput(
                    f"--{flag} belongs to a path from a table",
                    remedy="Name the table with --path",
                )
        path = appendix_b(
            specification, placement=place, duration=arguments.duration, timing=arguments.timing
        )
        return path, None
    if arguments.duration is not None:
        raise BadInput(
            "--duration belongs to appendix B's curve and --path gives another",
            remedy="Write it into the path's file",
        )
    from pollard_pin.motion.files import load_path

    path = load_path(
        arguments.path,
        euler=arguments.euler,
        feed=arguments.feed,
        timing=arguments.timing,
        smooth=arguments.smooth,
        untimed=getattr(arguments, "untimed", False),
    )
    return path, place


def report(
    arguments: argparse.Namespace,
    robot: Pollard,
    samples: Callable[[float], int],
    progress: Callable[[int, int], None],
) -> TrajectoryReport:
    """The report on the path that the arguments ask for."""
    from pollard_pin.report.document import trajectory_report

    path = _path(arguments, robot.specification)
    return trajectory_report(
        robot,
        path,
        samples=samples(path.duration),
        branch=_branch(arguments),
        motors=arguments.actuators,
        progress=progress,
    )


def motion(arguments: argparse.Namespace, robot: Pollard) -> Movement:
    """The path that the arguments ask for, to be written down."""
    from pollard_pin.report.movement import path_movement

    if arguments.actuators != "six":
        raise BadInput("a motion is written for six motors", remedy="Leave --actuators out")
    path = _path(arguments, robot.specification)
    return path_movement(robot, path, samples=arguments.samples, branch=_branch(arguments))


def sliders(arguments: argparse.Namespace, robot: Pollard) -> LivePage:
    """The robot whose tool is moved by sliders, at first on the branch that the arguments say.

    Raises:
        BadInput: Something is asked of a path.
    """
    from pollard_pin.report.drawn.sliders import slider_page

    motion = ("path", "duration", "timing", "euler", "feed", "placement", "turn", "mirror")
    refuse_beside(arguments, "sliders", motion)
    refuse_set(arguments, "sliders", smooth="auto", actuators="six")
    return slider_page(robot, _branch(arguments), shown_by(arguments, "pollard-pin"))


def ik(arguments: argparse.Namespace, robot: Pollard) -> Answer:
    """The branches of the tool pose that the arguments ask for."""
    from pollard_pin.report.tables import ik_document, solutions_table

    pose = np.array(arguments.pose)
    pose[3:] = np.radians(pose[3:])
    labels = USEFUL_BRANCHES if arguments.branch is None else (_branch(arguments),)
    solutions = robot.inverse_kinematics(pose, labels)
    try:
        solutions.require_one(allow_singular=arguments.allow_singular)
    except Unreachable as error:
        no = str(error)
        return Answer(
            lambda: ik_document(robot, solutions) | {"explanation": no},
            lambda: [no],
            yes=False,
        )
    return Answer(lambda: ik_document(robot, solutions), lambda: solutions_table(solutions))


def fk(arguments: argparse.Namespace) -> ExitCode:
    """Print or write the assembly modes of six motor angles."""
    from pollard_pin.report.tables import fk_document, modes_table

    def answer() -> Answer:
        robot = load(arguments.specification, inertia=arguments.inertia)
        modes = robot.forward_kinematics(np.radians(arguments.motors))
        try:
            modes.require()
        except Unreachable as error:
            no = str(error)
            document = fk_document(robot, modes) | {"explanation": no}
            return Answer(lambda: document, lambda: [no], yes=False)
        return Answer(lambda: fk_document(robot, modes), lambda: modes_table(robot, modes))

    return give(arguments, answer)


def conditions(arguments: argparse.Namespace) -> Conditions:
    """What the arguments have a path's torques replayed with."""
    from pollard_pin.study.simulate.conditions import Conditions

    refuse_beside(arguments, "open-loop", ("stiffness", "damping"))
    return Conditions(
        engine=arguments.engine,
        stiffness=None if arguments.stiffness is None else tuple(arguments.stiffness),
        damping=None if arguments.damping is None else tuple(arguments.damping),
        **tried(arguments),
    )


def workspace(arguments: argparse.Namespace) -> ExitCode:
    """Map reach and conditioning over a slice or a volume."""
    from pollard_pin.study.workspace import evaluate_workspace
    from thesis_pin.report.writers import csv_bytes, json_bytes

    style = figure_style(arguments)
    axes = {name: _axis(name, getattr(arguments, name), arguments.points) for name in "xyz"}
    robot = load(arguments.specification, inertia=arguments.inertia)
    files: dict[str, bytes] = {}
    with Bar("mapping the workspace") as bar:
        space = evaluate_workspace(
            robot,
            **axes,
            orientation=np.radians(arguments.orientation),
            branch=_branch(arguments),
            jobs=arguments.jobs,
            progress=bar,
        )
        content = json_bytes(space.document()) if arguments.json or arguments.out else b""
        if arguments.out:
            from pollard_pin.study.figures import workspace_files
            from thesis_pin.report.plotting.wanted import written_as

            files = {"workspace.csv": csv_bytes(space.columns()), "workspace.json": content}
            with written_as(style):
                files |= workspace_files(space)
    write_results(arguments, files, content)
    if free(arguments):
        rows = [
            (name.replace("_", " "), "–" if value is None else f"{value:.6g}")
            for name, value in space.summary().items()
        ]
        note = "Where the determinant changes sign the motors lose the tool; a path must stay on "
        print_parts([Table("", ("workspace", ""), rows), f"{note}one side."])
    return ExitCode.DONE


def place(arguments: argparse.Namespace) -> ExitCode:
    """Judge placements of a path, and report on the best."""
    from pollard_pin.verbs.placed import place as placed

    return placed(arguments, _branch(arguments), partial(_curve, arguments))


def accuracy(arguments: argparse.Namespace) -> ExitCode:
    """How errors of the robot's numbers reach the spray tip, on a path or over a grid."""
    from pollard_pin.verbs.studied import accuracy as studied

    def axes(usual: dict[str, list[float]], points: int) -> dict[str, np.ndarray]:
        return {
            name: _axis(name, getattr(arguments, name) or ends, points)
            for name, ends in usual.items()
        }

    return studied(arguments, _branch(arguments), partial(_path, arguments), axes)


def _axis(name: str, ends: list[float], points: int) -> np.ndarray:
    """Grid values of one axis: one, or from and to."""
    if len(ends) > 2 or (len(ends) == 2 and not ends[0] < ends[1]):
        raise BadInput(
            f"--{name} is {' '.join(f'{end:g}' for end in ends)}",
            allowed="one value, or from and to in ascending order",
        )
    return np.linspace(ends[0], ends[-1], points if len(ends) == 2 else 1)


def time(arguments: argparse.Namespace) -> ExitCode:
    """Find a law of motion along a path."""
    from pollard_pin.verbs import timed

    return timed.time(arguments, _branch(arguments), partial(_path, arguments))
