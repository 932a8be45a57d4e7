"""The command ``pollard-pin``. Each verb imports what it needs when it runs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from thesis_pin import __version__
from thesis_pin.command_line import (
    OK,
    Parser,
    count,
    number,
    print_table,
    print_text,
    run,
    write_file,
    write_folder,
)

if TYPE_CHECKING:
    from pollard_pin.geometry import Branch
    from pollard_pin.path import Path


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return run(parser(), arguments)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    top = Parser(
        prog="pollard-pin",
        description="Pollard, a three-chain parallel spray robot: torque reports, kinematics, "
        "workspace, URDF.",
        epilog="Example: pollard-pin trajectory --out report",
    )
    top.add_argument("--version", action="version", version=f"pollard-pin {__version__}")
    verbs = top.add_subparsers(title="verbs", required=True, metavar="VERB")
    _add_trajectory(verbs)
    _add_ik(verbs)
    _add_fk(verbs)
    _add_workspace(verbs)
    _add_info(verbs)
    _add_urdf(verbs)
    _add_check(verbs)
    return top


def _add_robot(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--specification",
        metavar="FILE",
        help="TOML of another three-chain robot (default: the thesis's)",
    )
    verb.add_argument(
        "--inertia",
        choices=("physical", "printed"),
        default="physical",
        help="reading of the printed inertias (default: physical)",
    )


def _add_branch(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--branch",
        metavar="SIGNS",
        help="seven signs e0 f0 w e1 f1 e2 f2, written --branch=-++-+++ (the default)",
    )


def _add_trajectory(verbs: Any) -> None:
    verb = verbs.add_parser(
        "trajectory",
        help="what the motors, joints and ball joints have to do on a path",
        description="Torques, power, work, loop reactions and singularity margins on a path.",
        epilog="Example: pollard-pin trajectory --path spray.csv --out report",
    )
    _add_robot(verb)
    _add_branch(verb)
    verb.add_argument(
        "--path", metavar="FILE", help=".csv or .toml path (default: the curve of appendix B)"
    )
    verb.add_argument(
        "--duration",
        type=number("--duration", positive=True),
        metavar="SECONDS",
        help="duration of appendix B's curve (default: the specification's)",
    )
    verb.add_argument(
        "--timing",
        choices=("constant-rate", "rest-to-rest"),
        help="timing of appendix B's curve (default: the specification's)",
    )
    verb.add_argument(
        "--placement",
        nargs=3,
        type=number("--placement"),
        metavar=("X", "Y", "Z"),
        help="what is added to appendix B's curve [m] (default: the specification's)",
    )
    verb.add_argument(
        "--actuators",
        choices=("six", "three"),
        default="six",
        help="six motors, or the thesis's three with what they can't carry (default: six)",
    )
    verb.add_argument(
        "--samples", type=count("--samples", 2), default=2001, help="samples (default: 2001)"
    )
    verb.add_argument("--out", metavar="DIR", help="write report.json, samples.csv and figures")
    verb.add_argument("--json", metavar="FILE|-", help="write the report as JSON")
    verb.set_defaults(run=_trajectory)


def _add_ik(verbs: Any) -> None:
    verb = verbs.add_parser(
        "ik",
        help="joint angles for a pose of the tool, every useful branch",
        description="The twelve joint angles that bring the spray tip to a pose.",
        epilog="Example: pollard-pin ik 0.45 0 0.05 0 10 0",
    )
    _add_robot(verb)
    _add_branch(verb)
    verb.add_argument(
        "pose",
        nargs=6,
        type=number("the pose"),
        metavar="VALUE",
        help="x y z of the spray tip [m], then ψ θ φ of the tool [°]",
    )
    verb.add_argument(
        "--allow-singular",
        action="store_true",
        help="answer at singular poses too, with angles that are free set to zero",
    )
    verb.add_argument("--json", metavar="FILE|-", help="write the solutions as JSON")
    verb.set_defaults(run=_ik)


def _add_fk(verbs: Any) -> None:
    verb = verbs.add_parser(
        "fk",
        help="every assembly mode of six motor angles",
        description="Poses of the spray tip for angles of the six motors, every assembly mode.",
        epilog="Example: pollard-pin fk -35 -40 40 0 20 0",
    )
    _add_robot(verb)
    verb.add_argument(
        "motors",
        nargs=6,
        type=number("a motor angle"),
        metavar="ANGLE",
        help="θ21 θ211 θ212 θ1615 θ1716 θ1817 [°]",
    )
    verb.add_argument("--json", metavar="FILE|-", help="write the modes as JSON")
    verb.set_defaults(run=_fk)


def _add_workspace(verbs: Any) -> None:
    verb = verbs.add_parser(
        "workspace",
        help="reach and conditioning over a slice or a volume",
        description="Reach, condition number and sign of the actuation over a grid.",
        epilog="Example: pollard-pin workspace --x 0.1 0.8 --y 0 --z -0.5 0.5 --out slice",
    )
    _add_robot(verb)
    _add_branch(verb)
    for axis, default in (("x", [0.1, 0.8]), ("y", [0.0]), ("z", [-0.5, 0.5])):
        verb.add_argument(
            f"--{axis}",
            nargs="+",
            type=number(f"--{axis}"),
            default=default,
            metavar="METRES",
            help=f"one value, or from and to (default: {' '.join(map(str, default))})",
        )
    verb.add_argument(
        "--orientation",
        nargs=3,
        type=number("--orientation"),
        default=(0.0, 0.0, 0.0),
        metavar=("PSI", "THETA", "PHI"),
        help="ψ, θ, φ of the tool [°] (default: 0 0 0)",
    )
    verb.add_argument(
        "--points", type=count("--points", 2), default=101, help="points an axis (default: 101)"
    )
    verb.add_argument("--jobs", type=count("--jobs", 1), default=2, help="threads (default: 2)")
    verb.add_argument("--out", metavar="DIR", help="write workspace.csv, .json and figures")
    verb.add_argument("--json", metavar="FILE|-", help="write the reachable positions as JSON")
    verb.set_defaults(run=_workspace)


def _add_info(verbs: Any) -> None:
    verb = verbs.add_parser(
        "info",
        help="what a specification describes",
        description="Joints, bodies, degrees of freedom and assumptions of a robot.",
        epilog="Example: pollard-pin info --inertia printed",
    )
    _add_robot(verb)
    verb.add_argument("--json", metavar="FILE|-", help="write it as JSON")
    verb.set_defaults(run=_info)


def _add_urdf(verbs: Any) -> None:
    verb = verbs.add_parser(
        "urdf",
        help="URDF, closure file and MJCF of a specification",
        description="The cut-open URDF, its closure file and the MJCF of the closed robot.",
        epilog="Example: pollard-pin urdf --out model",
    )
    _add_robot(verb)
    verb.add_argument("--out", metavar="DIR", help="write all files (default: print the URDF)")
    verb.set_defaults(run=_urdf)


def _add_check(verbs: Any) -> None:
    verb = verbs.add_parser(
        "check",
        help="is any robot's URDF and closure file sound?",
        description="Check a URDF and the closure file beside it: names, tree, loops, motors, "
        "degrees of freedom. Any looped robot, not only this one.",
        epilog="Example: pollard-pin check five_bar.urdf five_bar.yaml",
    )
    verb.add_argument("urdf", help="URDF of the cut-open tree")
    verb.add_argument("closures", help="YAML with closed_loop, type and name_mot")
    verb.add_argument("--json", metavar="FILE|-", help="write the findings as JSON")
    verb.set_defaults(run=_check)


def _branch(arguments: argparse.Namespace) -> Branch:
    from pollard_pin.geometry import DEFAULT_BRANCH, Branch

    return Branch.parse(arguments.branch) if arguments.branch else DEFAULT_BRANCH


def _path(arguments: argparse.Namespace, specification: Any) -> Path:
    from pollard_pin.path import appendix_b, load_path
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


def _trajectory(arguments: argparse.Namespace) -> int:
    from pollard_pin.model import load
    from pollard_pin.report import trajectory_report

    robot = load(arguments.specification, inertia=arguments.inertia)
    report = trajectory_report(
        robot,
        _path(arguments, robot.specification),
        samples=arguments.samples,
        branch=_branch(arguments),
        actuators=arguments.actuators,
    )
    content = b""
    if arguments.json or arguments.out:
        from thesis_pin.report import json_bytes

        content = json_bytes(report.document())
    if arguments.out:
        from pollard_pin.plots import report_files
        from thesis_pin.report import csv_bytes

        files = {"report.json": content, "samples.csv": csv_bytes(report.columns())}
        write_folder(arguments.out, files | report_files(report))
    if arguments.json:
        write_file(arguments.json, content)
    if arguments.json != "-":
        from pollard_pin.tables import print_report

        print_report(report)
    return OK


def _ik(arguments: argparse.Namespace) -> int:
    import numpy as np

    from pollard_pin.geometry import USEFUL_BRANCHES
    from pollard_pin.model import load
    from pollard_pin.tables import ik_document, print_solutions

    robot = load(arguments.specification, inertia=arguments.inertia)
    pose = np.array(arguments.pose)
    pose[3:] = np.radians(pose[3:])
    branches = (_branch(arguments),) if arguments.branch else USEFUL_BRANCHES
    solutions = robot.inverse_kinematics(pose, branches)
    solutions.require_one(allow_singular=arguments.allow_singular)
    if arguments.json:
        from thesis_pin.report import json_bytes

        write_file(arguments.json, json_bytes(ik_document(solutions)))
    if arguments.json != "-":
        print_solutions(solutions)
    return OK


def _fk(arguments: argparse.Namespace) -> int:
    import numpy as np

    from pollard_pin.model import load
    from pollard_pin.tables import fk_document, print_modes

    robot = load(arguments.specification, inertia=arguments.inertia)
    modes = robot.forward_kinematics(np.radians(arguments.motors))
    modes.require()
    if arguments.json:
        from thesis_pin.report import json_bytes

        write_file(arguments.json, json_bytes(fk_document(robot, modes)))
    if arguments.json != "-":
        print_modes(robot, modes)
    return OK


def _workspace(arguments: argparse.Namespace) -> int:
    import numpy as np

    from pollard_pin.model import load
    from pollard_pin.workspace import workspace
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
    with _Bar() as bar:
        space = workspace(
            robot,
            **axes,
            orientation=np.radians(arguments.orientation),
            branch=_branch(arguments),
            jobs=arguments.jobs,
            progress=bar,
        )
    from thesis_pin.report import csv_bytes, json_bytes

    content = json_bytes(space.document()) if arguments.json or arguments.out else b""
    if arguments.out:
        from pollard_pin.plots import workspace_files

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


class _Bar:
    """A progress bar on standard error, silent when that isn't a terminal."""

    def __enter__(self) -> _Bar:
        from rich.console import Console
        from rich.progress import Progress

        console = Console(stderr=True)
        self._bar = Progress(console=console, transient=True, disable=not console.is_terminal)
        self._task = self._bar.add_task("positions", total=None)
        self._bar.start()
        return self

    def __call__(self, done: int, total: int) -> None:
        self._bar.update(self._task, completed=done, total=total)

    def __exit__(self, *_: object) -> None:
        self._bar.stop()


def _info(arguments: argparse.Namespace) -> int:
    from pollard_pin.info import document, print_info
    from pollard_pin.model import load

    robot = load(arguments.specification, inertia=arguments.inertia)
    if arguments.json:
        from thesis_pin.report import json_bytes

        write_file(arguments.json, json_bytes(document(robot)))
    if arguments.json != "-":
        print_info(robot)
    return OK


def _urdf(arguments: argparse.Namespace) -> int:
    from pollard_pin.specification import Specification
    from pollard_pin.urdf import files, urdf
    from thesis_pin.loading import check_urdf

    specification = Specification.read(arguments.specification)
    text = urdf(specification, arguments.inertia)
    check_urdf(text, where=specification.name)
    if arguments.out:
        contents = {name: text.encode() for name, text in files(specification).items()}
        write_folder(arguments.out, contents)
        print(f"wrote {', '.join(contents)} to {arguments.out}", file=sys.stderr)
    else:
        write_file("-", text.encode())
    return OK


def _check(arguments: argparse.Namespace) -> int:
    from pollard_pin.tables import check_document, print_check
    from thesis_pin.closures import load

    document = check_document(load(arguments.urdf, arguments.closures))
    if arguments.json:
        from thesis_pin.report import json_bytes

        write_file(arguments.json, json_bytes(document))
    if arguments.json != "-":
        print_check(document)
    return OK
