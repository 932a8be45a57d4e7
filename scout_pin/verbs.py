"""What each verb of ``scout-pin`` does. Each imports what it needs when it runs."""

from __future__ import annotations

import argparse
from importlib import import_module

from thesis_pin.command import verbs
from thesis_pin.command.parser import LIMIT_VIOLATED, OK, run_view
from thesis_pin.command.progress import LONG, Bar
from thesis_pin.command.verbs import show, write_report


def gait(arguments: argparse.Namespace) -> int:
    """Work out a gait and write or print its report."""
    from scout_pin.model import load
    from scout_pin.motion.files import load_gait
    from scout_pin.report.document import gait_report

    robot = load(arguments.specification, inertia=arguments.inertia)
    planned = load_gait(arguments.gait, arguments.interpolation)
    with Bar("working out the gait", wanted=arguments.samples >= LONG) as bar:
        report = gait_report(
            robot,
            planned,
            samples=arguments.samples,
            time_unit=arguments.time_unit,
            progress=bar,
        )
    if write_report(
        arguments,
        report,
        figures=lambda: import_module("scout_pin.report.figures").figures(report),
        page=lambda: import_module("scout_pin.report.page").gait_page(report),
    ):
        from scout_pin.report.tables import print_report

        print_report(report)
    return OK if report.within_limits or not arguments.strict else LIMIT_VIOLATED


def view(arguments: argparse.Namespace) -> int:
    """Show a gait in the browser, or write it as a page."""
    from scout_pin.model import load
    from scout_pin.motion.files import load_gait
    from scout_pin.report.document import gait_report
    from scout_pin.report.view import gait_scene
    from thesis_pin.pages.scene import frames

    robot = load(arguments.specification, inertia=arguments.inertia)
    planned = load_gait(arguments.gait, arguments.interpolation)
    unit = arguments.time_unit or planned.time_unit
    samples = frames((planned.end - planned.start) * unit)
    report = gait_report(robot, planned, samples=samples, time_unit=unit)
    run_view(gait_scene(report), arguments)
    return OK


def ik(arguments: argparse.Namespace) -> int:
    """Print or write the branches of one foot pose."""
    import numpy as np

    from scout_pin.model import load
    from scout_pin.report.tables import ik_document, print_solutions
    from thesis_pin.errors import Unreachable
    from thesis_pin.numeric.rotations import euler_placement, transform

    robot = load(arguments.specification, inertia=arguments.inertia)
    pose, zero = np.concatenate([arguments.position, np.radians(arguments.rotation)]), np.zeros(3)
    rotation = euler_placement("xyz", pose[3:], zero, zero)[0]
    solutions = robot.leg_inverse_kinematics(arguments.side, transform(rotation, pose[:3]))
    if not solutions.reachable.any():
        raise Unreachable(solutions.explain(), where=f"{arguments.side} foot")
    return show(
        arguments, lambda: ik_document(robot, solutions, pose), lambda: print_solutions(solutions)
    )


def info(arguments: argparse.Namespace) -> int:
    """Say what a specification describes."""
    from scout_pin.model import load
    from scout_pin.report.info import document, print_info

    robot = load(arguments.specification, inertia=arguments.inertia)
    return show(arguments, lambda: document(robot), lambda: print_info(robot))


def urdf(arguments: argparse.Namespace) -> int:
    """Print the URDF, or write every generated file."""
    from scout_pin import urdf as generator
    from scout_pin.specification import Specification

    specification = Specification.read(arguments.specification)
    text = generator.urdf(specification, arguments.inertia)
    return verbs.urdf(arguments, specification.name, text, lambda: generator.files(specification))


def audit(arguments: argparse.Namespace) -> int:
    """A verdict on each printed equation of the thesis."""
    from scout_pin.thesis.audit import THESIS
    from thesis_pin.command.audit import run_verb

    return run_verb(arguments, THESIS)
