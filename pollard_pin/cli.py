"""The command ``pollard-pin``: its words. What they do is in :mod:`pollard_pin.verbs`."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

from thesis_pin.command.audit import add_verb
from thesis_pin.command.options import (
    add_json,
    add_report_options,
    add_robot,
    add_view_options,
    later,
)
from thesis_pin.command.parser import Parser, count, number, run
from thesis_pin.version import __version__


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return run(parser(), arguments)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    top = Parser(
        prog="pollard-pin",
        description="Pollard, a three-chain parallel spray robot: torque reports, animations, "
        "kinematics, workspace, URDF.",
        epilog="Example: pollard-pin trajectory --out report",
    )
    top.add_argument("--version", action="version", version=f"pollard-pin {__version__}")
    verbs = top.add_subparsers(title="verbs", required=True, metavar="VERB")
    _add_trajectory(verbs)
    _add_view(verbs)
    _add_ik(verbs)
    _add_fk(verbs)
    _add_workspace(verbs)
    _add_info(verbs)
    _add_urdf(verbs)
    _add_check(verbs)
    add_verb(verbs, "pollard-pin audit --equation 2.4.1:A_10", _run("audit"))
    return top


def _add_robot(verb: argparse.ArgumentParser) -> None:
    add_robot(verb, "another three-chain robot")


def _run(name: str) -> Callable[[argparse.Namespace], int]:
    return later("pollard_pin.verbs", name)


def _add_branch(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--branch",
        metavar="SIGNS",
        help="seven signs e0 f0 w e1 f1 e2 f2, written --branch=-++-+++ (the default)",
    )


def _add_path(verb: argparse.ArgumentParser) -> None:
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


def _add_trajectory(verbs: Any) -> None:
    verb = verbs.add_parser(
        "trajectory",
        help="what the motors, joints and ball joints have to do on a path",
        description="Torques, power, work, loop reactions and singularity margins on a path.",
        epilog="Example: pollard-pin trajectory --path examples/spray_arch.toml --out report",
    )
    _add_robot(verb)
    _add_branch(verb)
    _add_path(verb)
    verb.add_argument(
        "--samples", type=count("--samples", 2), default=2001, help="samples (default: 2001)"
    )
    add_report_options(verb, "a motor exceeds its limits")
    verb.set_defaults(run=_run("trajectory"))


def _add_view(verbs: Any) -> None:
    verb = verbs.add_parser(
        "view",
        help="watch the robot on a path in the browser",
        description="Show the robot on a path with torques, ball-joint forces and margins, "
        "on 127.0.0.1.",
        epilog="Example: pollard-pin view --path examples/spray_arch.toml --html spray.html",
    )
    _add_robot(verb)
    _add_branch(verb)
    _add_path(verb)
    add_view_options(verb)
    verb.set_defaults(run=_run("view"))


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
    add_json(verb, "the solutions")
    verb.set_defaults(run=_run("ik"))


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
    add_json(verb, "the modes")
    verb.set_defaults(run=_run("fk"))


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
    add_json(verb, "the reachable positions")
    verb.set_defaults(run=_run("workspace"))


def _add_info(verbs: Any) -> None:
    verb = verbs.add_parser(
        "info",
        help="what a specification describes",
        description="Joints, bodies, degrees of freedom and assumptions of a robot.",
        epilog="Example: pollard-pin info --inertia printed",
    )
    _add_robot(verb)
    add_json(verb, "it")
    verb.set_defaults(run=_run("info"))


def _add_urdf(verbs: Any) -> None:
    verb = verbs.add_parser(
        "urdf",
        help="URDF, closure file and MJCF of a specification",
        description="The cut-open URDF, its closure file and the MJCF of the closed robot.",
        epilog="Example: pollard-pin urdf --out model",
    )
    _add_robot(verb)
    verb.add_argument("--out", metavar="DIR", help="write all files (default: print the URDF)")
    verb.set_defaults(run=_run("urdf"))


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
    add_json(verb, "the findings")
    verb.set_defaults(run=_run("check"))
