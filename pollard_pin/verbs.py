"""What each verb of ``pollard-pin`` does. Each imports what it needs when it runs."""

from __future__ import annotations

import argparse
from importlib import import_module
from typing import TYPE_CHECKING, Any

from thesis_pin.command import verbs
from thesis_pin.command.output import print_table, print_text
from thesis_pin.command.parser import LIMIT_VIOLATED, OK, run_view
from thesis_pin.command.progress import LONG, Bar
from thesis_pin.command.verbs import show, write_report
from thesis_pin.files import write_file, write_folder

if TYPE_CHECKING:
    from pollard_pin.kinematics.geometry import Branch
    from pollard_pin.motion.path import ToolPath


def _branch(arguments: argparse.Namespace) -> Branch:
    from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch

    return DEFAULT_BRANCH if arguments.branch is None else Branch.parse(arguments.branch)


def _path(arguments: argparse.Namespace, specification: Any) -> ToolPath:
    from pollard_pin.motion.curves import appendix_b
    from pollard_pin.motion.files import load_path
    from thesis_pin.errors import BadInput

    if arguments.path is None:
        return appendix_b(
            specification,
            placement=arguments.placement,
            duration=arguments.duration,
            timing=arguments.timing,
        )
    for flag in ("duration", "timing", "placement"):
        if getattr(arguments, flag) is not None:
            raise BadInput(
                f"--{flag} belongs to appendix B's curve and --path gives another",
                remedy="Write it into the path's file",
            )
    return load_path(arguments.path)


def trajectory(arguments: argparse.Namespace) -> int:
    """Work out a path and write or print its report."""
    from pollard_pin.model import load
    from pollard_pin.report.document import trajectory_report

    robot = load(arguments.specification, inertia=arguments.inertia)
    path, branch = _path(arguments, robot.specification), _branch(arguments)
    with Bar("working out the path", wanted=arguments.samples >= LONG) as bar:
        report = trajectory_report(
            robot,
            path,
            samples=arguments.samples,
            branch=branch,
            motors=arguments.actuators,
            progress=bar,
        )
    if write_report(
        arguments,
        report,
        figures=lambda: import_module("pollard_pin.report.figures").figures(report),
        page=lambda: import_module("pollard_pin.report.page").trajectory_page(report),
    ):
        from pollard_pin.report.tables import print_report

        print_report(report)
    return OK if report.motor_use.within or not arguments.strict else LIMIT_VIOLATED


def view(arguments: argparse.Namespace) -> int:
    """Show a path in the browser, or write it as a page."""
    from pollard_pin.model import load
    from pollard_pin.report.document import trajectory_report
    from pollard_pin.report.view import path_scene
    from thesis_pin.pages.scene import frames

    robot = load(arguments.specification, inertia=arguments.inertia)
    path = _path(arguments, robot.specification)
    report = trajectory_report(
        robot,
        path,
        samples=frames(path.duration),
        branch=_branch(arguments),
        motors=arguments.actuators,
    )
    run_view(path_scene(report), arguments)
    return OK


def ik(arguments: argparse.Namespace) -> int:
    """Print or write the branches of one tool pose."""
    import numpy as np

    from pollard_pin.kinematics.geometry import USEFUL_BRANCHES
    from pollard_pin.model import load
    from pollard_pin.report.tables import ik_document, print_solutions

    robot = load(arguments.specification, inertia=arguments.inertia)
    pose = np.array(arguments.pose)
    pose[3:] = np.radians(pose[3:])
    labels = USEFUL_BRANCHES if arguments.branch is None else (_branch(arguments),)
    solutions = robot.inverse_kinematics(pose, labels)
    solutions.require_one(allow_singular=arguments.allow_singular)
    return show(
        arguments, lambda: ik_document(robot, solutions), lambda: print_solutions(solutions)
    )


def fk(arguments: argparse.Namespace) -> int:
    """Print or write the assembly modes of six motor angles."""
    import numpy as np

    from pollard_pin.model import load
    from pollard_pin.report.tables import fk_document, print_modes

    robot = load(arguments.specification, inertia=arguments.inertia)
    modes = robot.forward_kinematics(np.radians(arguments.motors))
    modes.require()
    return show(arguments, lambda: fk_document(robot, modes), lambda: print_modes(robot, modes))


def workspace(arguments: argparse.Namespace) -> int:
    """Map reach and conditioning over a slice or a volume."""
    import numpy as np

    from pollard_pin.model import load
    from pollard_pin.study.workspace import evaluate_workspace
    from thesis_pin.errors import BadInput

    axes: dict[str, Any] = {}
    for name in "xyz":
        ends = getattr(arguments, name)
        if len(ends) > 2 or (len(ends) == 2 and not ends[0] < ends[1]):
            raise BadInput(
                f"--{name} is {' '.join(f'{end:g}' for end in ends)}",
                allowed="one value, or from and to in ascending order",
            )
        axes[name] = np.linspace(ends[0], ends[-1], arguments.points if len(ends) == 2 else 1)
    robot = load(arguments.specification, inertia=arguments.inertia)
    with Bar("mapping the workspace") as bar:
        space = evaluate_workspace(
            robot,
            **axes,
            orientation=np.radians(arguments.orientation),
            branch=_branch(arguments),
            jobs=arguments.jobs,
            progress=bar,
        )
    from thesis_pin.report.writers import csv_bytes, json_bytes

    content = json_bytes(space.document()) if arguments.json or arguments.out else b""
    if arguments.out:
        from pollard_pin.study.figures import workspace_files

        files = {"workspace.csv": csv_bytes(space.columns()), "workspace.json": content}
        write_folder(arguments.out, files | workspace_files(space))
    if arguments.json:
        write_file(arguments.json, content)
    if arguments.json != "-":
        rows = [
            (name.replace("_", " "), "–" if value is None else f"{value:.6g}")
            for name, value in space.summary().items()
        ]
        print_table(("workspace", ""), rows)
        print_text(
            "Where the determinant changes sign the motors lose the tool; a path must stay on "
            "one side."
        )
    return OK


def info(arguments: argparse.Namespace) -> int:
    """Say what a specification describes."""
    from pollard_pin.model import load
    from pollard_pin.report.info import document, print_info

    robot = load(arguments.specification, inertia=arguments.inertia)
    return show(arguments, lambda: document(robot), lambda: print_info(robot))


def urdf(arguments: argparse.Namespace) -> int:
    """Print the URDF, or write every generated file."""
    from pollard_pin import urdf as generator
    from pollard_pin.specification import Specification

    specification = Specification.read(arguments.specification)
    text = generator.urdf(specification, arguments.inertia)
    return verbs.urdf(arguments, specification.name, text, lambda: generator.files(specification))


def check(arguments: argparse.Namespace) -> int:
    """Say whether a URDF and its closure file are sound."""
    from pollard_pin.report.tables import check_document, print_check
    from thesis_pin.loops.closures import load

    document = check_document(load(arguments.urdf, arguments.closures))
    return show(arguments, lambda: document, lambda: print_check(document))


def audit(arguments: argparse.Namespace) -> int:
    """A verdict on each printed equation of the thesis."""
    from pollard_pin.thesis.audit import THESIS
    from thesis_pin.command.audit import run_verb

    return run_verb(arguments, THESIS)
