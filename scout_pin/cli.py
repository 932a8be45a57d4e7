"""The command ``scout-pin``. Each verb imports what it needs when it runs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from thesis_pin import __version__
from thesis_pin.audit_command import add_verb
from thesis_pin.command_line import (
    LIMIT_VIOLATED,
    OK,
    Parser,
    add_view_options,
    count,
    number,
    print_table,
    print_text,
    run,
    run_view,
    write_file,
    write_folder,
)

if TYPE_CHECKING:
    from scout_pin.kinematics import LegSolutions
    from scout_pin.report import GaitReport


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
    _add_audit(verbs)
    return top


def _add_robot(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--specification", metavar="FILE", help="TOML of another biped (default: the thesis's)"
    )
    verb.add_argument(
        "--inertia",
        choices=("physical", "printed"),
        default="physical",
        help="reading of the printed inertias (default: physical)",
    )


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
    verb.add_argument("--out", metavar="DIR", help="write report.json, samples.csv and figures")
    verb.add_argument("--json", metavar="FILE|-", help="write the report as JSON")
    verb.add_argument(
        "--html", metavar="FILE", help="write the report as a page to mail: animation and plots"
    )
    verb.add_argument(
        "--strict", action="store_true", help="exit with 1 if the gait breaks a limit"
    )
    verb.set_defaults(run=_gait)


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
    verb.set_defaults(run=_view)


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
    verb.add_argument("--json", metavar="FILE|-", help="write the branches as JSON")
    verb.set_defaults(run=_ik)


def _add_info(verbs: Any) -> None:
    verb = verbs.add_parser(
        "info",
        help="what a specification describes",
        description="Joints, limits, masses, reach and assumptions of a biped.",
        epilog="Example: scout-pin info --specification examples/lopsided.toml",
    )
    _add_robot(verb)
    verb.add_argument("--json", metavar="FILE|-", help="write it as JSON")
    verb.set_defaults(run=_info)


def _add_urdf(verbs: Any) -> None:
    verb = verbs.add_parser(
        "urdf",
        help="the URDF of a specification",
        description="Print the URDF, or write it with its meshes into a folder.",
        epilog="Example: scout-pin urdf --out my_robot",
    )
    _add_robot(verb)
    verb.add_argument("--out", metavar="DIR", help="write both readings and the sole meshes there")
    verb.set_defaults(run=_urdf)


def _add_audit(verbs: Any) -> None:
    add_verb(verbs, "scout-pin audit --equation 4.3.3:dot_e_9i", _audit)


def _audit(arguments: argparse.Namespace) -> int:
    from scout_pin.audit import run as run_audit

    return run_audit(arguments)


def _gait(arguments: argparse.Namespace) -> int:
    from scout_pin.gait_files import load_gait
    from scout_pin.model import load
    from scout_pin.report import gait_report

    robot = load(arguments.specification, inertia=arguments.inertia)
    gait = load_gait(arguments.gait, arguments.interpolation)
    report = gait_report(robot, gait, samples=arguments.samples, time_unit=arguments.time_unit)
    _write_report(report, arguments)
    if "-" not in (arguments.json, arguments.html):
        _print_report(report)
    return OK if report.within_limits or not arguments.strict else LIMIT_VIOLATED


def _view(arguments: argparse.Namespace) -> int:
    from scout_pin.gait_files import load_gait
    from scout_pin.model import load
    from scout_pin.report import gait_report
    from scout_pin.view import gait_scene
    from thesis_pin.scene import frames

    robot = load(arguments.specification, inertia=arguments.inertia)
    gait = load_gait(arguments.gait, arguments.interpolation)
    unit = arguments.time_unit or gait.time_unit
    samples = frames((gait.end - gait.start) * unit)
    report = gait_report(robot, gait, samples=samples, time_unit=unit)
    run_view(gait_scene(report), arguments)
    return OK


def _write_report(report: GaitReport, arguments: argparse.Namespace) -> None:
    from thesis_pin.report import csv_bytes, json_bytes

    if not (arguments.json or arguments.out or arguments.html):
        return
    document = json_bytes(report.document())
    page = b""
    if arguments.html:
        from scout_pin.page import gait_page

        page = gait_page(report)
    if arguments.out:
        from scout_pin.plots import figures

        files = {"report.json": document, "samples.csv": csv_bytes(report.columns())}
        write_folder(arguments.out, files | figures(report))
        print(f"wrote {arguments.out}", file=sys.stderr)
    if arguments.json:
        write_file(arguments.json, document)
    if arguments.html:
        write_file(arguments.html, page)


def _print_report(report: GaitReport) -> None:
    from scout_pin.specification import JOINT_SYMBOLS

    a, use = report.actuators, report.servo_use
    rows = [
        (
            name,
            JOINT_SYMBOLS[k],
            f"{a.peak_torque[k]:.3f}",
            f"{a.rms_torque[k]:.3f}",
            f"{a.peak_speed[k]:.2f}",
            f"{a.peak_power[k]:.3f}",
            f"{use[k]:.0%}",
        )
        for k, name in enumerate(a.names)
    ]
    duration = report.joints.time[-1] - report.joints.time[0]
    print_table(
        ("joint", "", "peak N·m", "RMS N·m", "peak rad/s", "peak W", "servo"),
        rows,
        title=f"{report.robot.specification.name}, gait {report.gait.name!r}: {duration:g} s, "
        f"time unit {report.time_unit:g} s, {len(report.joints.time)} samples",
    )
    s, f = report.robot, report.fastest
    torque, line = (f"{x:.4f} s" if x is not None else "none" for x in (f.torque, f.line))
    used = report.summary()["peak_friction_used"]
    print_text(
        f"Servo limits: {s.stall_torque.min():g} N·m, {s.no_load_speed.min():g} rad/s; "
        "'servo' is |τ|/stall + |ω|/no-load, at most 100%.",
        f"Fastest time unit by speed {f.speed:.4f} s, by torque {torque}, by both (line) {line}.",
        f"ZMP margin: worst {report.margin.min() * 1e3:.1f} mm; stable in "
        f"{report.stable_share:.1%} of the time.",
        f"Floor wrench: admissible in {report.dynamics.admissible.mean():.1%} of samples; "
        f"friction used up to {used:.0%}.",
        f"Lowest corner of a swinging sole: {report.clearance * 1e3:.1f} mm above the floor.",
    )
    for impact in report.impacts:
        normal = impact.impulse[0, 2]
        print_text(
            f"Touchdown of the {impact.side} foot at t = {impact.t:g}: "
            f"{-impact.foot_velocity[2] * 1e3:.0f} mm/s down, impulse {normal * 1e3:.1f} mN·s, "
            f"joints jump by {abs(impact.velocity_jump).max():.2f} rad/s, "
            f"{impact.energy_lost * 1e3:.2f} mJ lost"
            + ("." if impact.admissible else "; the foot slips, tips or spins in it.")
        )
    print_text("", *report.verdict())


def _ik(arguments: argparse.Namespace) -> int:
    import numpy as np

    from scout_pin.model import load
    from thesis_pin.errors import Unreachable
    from thesis_pin.rotations import euler_placement, transform

    robot = load(arguments.specification, inertia=arguments.inertia)
    angles = np.radians(np.array(arguments.rotation))
    zero = np.zeros(3)
    rotation = euler_placement("xyz", angles, zero, zero)[0]
    pose = transform(rotation, np.array(arguments.position))
    solutions = robot.leg_inverse_kinematics(arguments.side, pose)
    if not solutions.reachable.any():
        raise Unreachable(solutions.explain(), where=f"{arguments.side} foot")
    if arguments.json:
        from thesis_pin.report import json_bytes

        write_file(arguments.json, json_bytes(_ik_document(solutions)))
    if arguments.json != "-":
        _print_branches(solutions)
    return OK


def _ik_document(solutions: LegSolutions) -> dict[str, Any]:
    from scout_pin.kinematics import BRANCHES

    branches = [
        {
            "signs": list(BRANCHES[k]),
            "reachable": bool(solutions.reachable[k]),
            "valid": bool(solutions.valid[k]),
            "angles": solutions.angles[k] if solutions.reachable[k] else None,
            "reach_excess": float(solutions.excess[k]),
            "position_residual": float(solutions.position_residual[k])
            if solutions.reachable[k]
            else None,
        }
        for k in range(8)
    ]
    return {
        "schema": "scout-pin/leg-branches",
        "version": 1,
        "joints": list(solutions.geometry.names),
        "branches": branches,
        "explanation": solutions.explain(),
    }


def _print_branches(solutions: LegSolutions) -> None:
    import numpy as np

    from scout_pin.kinematics import BRANCHES

    rows = []
    for k, signs in enumerate(BRANCHES):
        label = "".join("+" if sign > 0 else "-" for sign in signs)
        if not solutions.reachable[k]:
            rows.append((label, *[""] * 6, f"{solutions.excess[k] * 1e3:.1f} mm off"))
            continue
        angles = [f"{value:.2f}" for value in np.degrees(solutions.angles[k])]
        rows.append((label, *angles, "valid" if solutions.valid[k] else "limits"))
    side = solutions.geometry.names[0].split("_")[0]
    columns = ("branch", "hip yaw", "roll", "pitch", "knee", "ankle", "roll", "")
    print_table(columns, rows, title=f"{side} leg, angles in degrees")
    print_text(solutions.explain().capitalize() + ".")


def _info(arguments: argparse.Namespace) -> int:
    from scout_pin.info import document, print_info
    from scout_pin.model import load

    robot = load(arguments.specification, inertia=arguments.inertia)
    if arguments.json:
        from thesis_pin.report import json_bytes

        write_file(arguments.json, json_bytes(document(robot)))
    if arguments.json != "-":
        print_info(robot)
    return OK


def _urdf(arguments: argparse.Namespace) -> int:
    from scout_pin.specification import Specification
    from scout_pin.urdf import files, urdf
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
