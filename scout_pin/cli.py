"""The command ``scout-pin``: its words. What they do is in :mod:`scout_pin.verbs`."""

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
        prog="scout-pin",
        description="Scout, an 18-DoF biped: torque reports, animations, inverse kinematics, URDF.",
        epilog="Example: scout-pin gait --out report",
    )
    top.add_argument("--version", action="version", version=f"scout-pin {__version__}")
    verbs = top.add_subparsers(title="verbs", required=True, metavar="VERB")
    _add_gait(verbs)
    _add_view(verbs)
    _add_ik(verbs)
    _add_info(verbs)
    _add_urdf(verbs)
    add_verb(verbs, "scout-pin audit --equation 4.3.3:dot_e_9i", _run("audit"))
    return top


def _add_robot(verb: argparse.ArgumentParser) -> None:
    add_robot(verb, "another biped")


def _run(name: str) -> Callable[[argparse.Namespace], int]:
    return later("scout_pin.verbs", name)


def _add_which_gait(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--gait",
        metavar="NAME|FILE",
        default="thesis",
        help="thesis, thesis-program, a .toml gait or a .csv of samples (default: thesis)",
    )
    verb.add_argument(
        "--interpolation",
        choices=("linear", "quadratic", "cubic", "free", "quintic"),
        help="method for the gait's nodes, instead of the gait's own",
    )
    verb.add_argument(
        "--time-unit",
        type=number("--time-unit", positive=True),
        metavar="SECONDS",
        help="seconds in the gait's unit of t (default: the gait's own)",
    )


def _add_gait(verbs: Any) -> None:
    verb = verbs.add_parser(
        "gait",
        help="can this gait walk, and can the servos carry it?",
        description="Torques, contact forces, stability and servo limits of a gait.",
        epilog="Example: scout-pin gait --gait walk.toml --time-unit 0.05 --out report",
    )
    _add_robot(verb)
    _add_which_gait(verb)
    verb.add_argument(
        "--samples",
        type=count("--samples", 2),
        default=401,
        help="evenly spaced samples; a few more stand beside each change (default: 401)",
    )
    add_report_options(verb, "the gait breaks a limit")
    verb.set_defaults(run=_run("gait"))


def _add_view(verbs: Any) -> None:
    verb = verbs.add_parser(
        "view",
        help="watch a gait in the browser",
        description="Show the robot along a gait with forces, ZMP and support, on 127.0.0.1.",
        epilog="Example: scout-pin view --gait walk.toml --html walk.html",
    )
    _add_robot(verb)
    _add_which_gait(verb)
    add_view_options(verb)
    verb.set_defaults(run=_run("view"))


def _add_ik(verbs: Any) -> None:
    verb = verbs.add_parser(
        "ik",
        help="joint angles of one leg for a foot pose, every branch",
        description="Every set of joint angles that brings a sole to a pose in the torso frame.",
        epilog="Example: scout-pin ik left --position -0.0445 -0.02 -0.22 --rotation 5 0 10",
    )
    _add_robot(verb)
    verb.add_argument("side", choices=("left", "right"))
    verb.add_argument(
        "--position",
        nargs=3,
        required=True,
        type=number("--position"),
        metavar=("X", "Y", "Z"),
        help="origin of the sole in the torso frame [m]",
    )
    verb.add_argument(
        "--rotation",
        nargs=3,
        default=(0.0, 0.0, 0.0),
        type=number("--rotation"),
        metavar=("PITCH", "ROLL", "YAW"),
        help="Rx(pitch) Ry(roll) Rz(yaw) [°] (default: 0 0 0)",
    )
    add_json(verb, "the branches")
    verb.set_defaults(run=_run("ik"))


def _add_info(verbs: Any) -> None:
    verb = verbs.add_parser(
        "info",
        help="what a specification describes",
        description="Joints, limits, masses, reach and assumptions of a biped.",
        epilog="Example: scout-pin info --specification examples/lopsided.toml",
    )
    _add_robot(verb)
    add_json(verb, "it")
    verb.set_defaults(run=_run("info"))


def _add_urdf(verbs: Any) -> None:
    verb = verbs.add_parser(
        "urdf",
        help="the URDF of a specification",
        description="Print the URDF, or write it with its meshes into a folder.",
        epilog="Example: scout-pin urdf --out my_robot",
    )
    _add_robot(verb)
    verb.add_argument("--out", metavar="DIR", help="write both readings and the sole meshes there")
    verb.set_defaults(run=_run("urdf"))
