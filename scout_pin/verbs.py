"""What the verbs of ``scout-pin`` do that only Scout does; imported when a verb runs."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from scout_pin.implausible import implausible
from scout_pin.model import Scout, load
from scout_pin.specification import NEW_PATH, SIDES
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import Answer, put_new
from thesis_pin.command.running import ExitCode
from thesis_pin.command.text import say
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput
from thesis_pin.model.loading import shipped_folder
from thesis_pin.numeric.checks import choice

if TYPE_CHECKING:
    from thesis_pin.pages.scene import Scene


def report(
    arguments: argparse.Namespace,
    robot: Scout,
    samples: Callable[[float], int],
    progress: Callable[[int, int], None],
) -> object:
    """The report on the gait that the arguments ask for."""
    from scout_pin.motion.cycles import repeat_gait
    from scout_pin.motion.files import load_gait
    from scout_pin.report.document import gait_report

    if arguments.gait is None and arguments.specification is not None:
        say(
            "warning: no --gait is given and the thesis's is taken, which was made for its own "
            "robot; scout-pin new FILE --gait sway makes one for this robot"
        )
    gait = load_gait(arguments.gait or "thesis", arguments.interpolation, robot=robot)
    if arguments.cycle:
        gait = replace(gait, cycle=True)
    one = gait.end - gait.start
    if arguments.repeat > 1:
        gait = repeat_gait(gait, arguments.repeat)
    unit = arguments.time_unit or gait.time_unit
    return gait_report(
        robot,
        gait,
        # As many for each walk: peaks don't get lost where it is repeated.
        samples=1 + arguments.repeat * (samples(one * unit) - 1),
        time_unit=unit,
        branch=arguments.branch,
        progress=progress,
    )


def still(arguments: argparse.Namespace, robot: Scout) -> Scene | None:
    """The neutral pose, where a robot is named and no gait."""
    from scout_pin.report.neutral import neutral_scene

    if arguments.gait is not None or arguments.specification is None:
        return None
    return neutral_scene(robot)


def ik(arguments: argparse.Namespace, robot: Scout) -> Answer:
    """The branches of the foot pose that the arguments ask for."""
    from scout_pin.report.tables import ik_document, solutions_table
    from thesis_pin.numeric.rotations import euler_placement, transform

    pose, zero = np.concatenate([arguments.position, np.radians(arguments.rotation)]), np.zeros(3)
    rotation = euler_placement("xyz", pose[3:], zero, zero)[0]
    solutions = robot.leg_inverse_kinematics(arguments.side, transform(rotation, pose[:3]))
    only = None  # all, whatever the specification would choose
    if arguments.branch is not None:
        only = robot.allowed_branches(arguments.branch)[SIDES.index(arguments.side)]
    reached = solutions.reachable if only is None else solutions.reachable[list(only)]
    return Answer(
        lambda: ik_document(robot, solutions, pose, only),
        lambda: solutions_table(solutions, only),
        yes=bool(reached.any()),
    )


def new(arguments: argparse.Namespace) -> ExitCode:
    """Write a specification to begin with, a first gait for one, or a shipped example."""
    if arguments.gait is not None and arguments.example is not None:
        raise BadInput("--gait and --example are two files", remedy="Write one at a time")
    if arguments.gait is not None:
        from scout_pin.making.gaits import gait_text

        with warned():
            robot = load(arguments.specification)
        content = gait_text(robot, arguments.gait).encode()
    elif arguments.example is not None:
        folder = shipped_folder("examples")
        names = sorted(path.name for path in folder.iterdir() if path.is_file())
        content = (folder / choice("example", arguments.example, names)).read_bytes()
    else:
        content = NEW_PATH.read_bytes()
    put_new(arguments.file, content, replace=arguments.force)
    return ExitCode.DONE


def from_urdf(arguments: argparse.Namespace) -> ExitCode:
    """Read a robot's description into a specification."""
    from scout_pin.making.from_urdf import from_urdf as translated
    from scout_pin.making.text import toml
    from scout_pin.specification import JOINT_NAMES

    with Bar("reading the axes"):
        found = translated(
            arguments.file,
            left=arguments.left,
            sole=arguments.sole,
            servo=arguments.servo,
            friction=arguments.friction,
        )
        names = zip(JOINT_NAMES, found.joints, found.signs, strict=True)
        joints = ", ".join(f"{mine} is {'−' if s < 0 else ''}{file}" for mine, file, s in names)
        text = toml(found.specification, [*found.notes, f"Joints: {joints}."])
    for note in found.notes:
        say(f"note: {note}")
    for odd in implausible(found.specification):
        say(f"warning: {odd}")
    put_new(arguments.toml, text.encode(), replace=arguments.force)
    return ExitCode.DONE
