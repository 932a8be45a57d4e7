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
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import Answer, check_new, put, put_new
from thesis_pin.command.running import ExitCode
from thesis_pin.command.showing.words import refuse_set, shown_by
from thesis_pin.command.text import say
from thesis_pin.command.verbs.simulate import tried
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput
from thesis_pin.model.loading import shipped_folder
from thesis_pin.numeric.checks import choice

if TYPE_CHECKING:  # inverse kinematics alone needs none of them
    from scout_pin.motion.gait import Gait
    from scout_pin.report.document import GaitReport
    from scout_pin.study.servo import ServoGains
    from scout_pin.study.simulate.conditions import Conditions
    from thesis_pin.pages.live.page import LivePage
    from thesis_pin.pages.scene import Scene
    from thesis_pin.report.exchange.movement import Movement


def report(
    arguments: argparse.Namespace,
    robot: Scout,
    samples: Callable[[float], int],
    progress: Callable[[int, int], None],
) -> GaitReport:
    """The report on the gait that the arguments ask for."""
    from scout_pin.motion.cycles import repeat_gait
    from scout_pin.report.document import gait_report

    gait = _gait(arguments, robot)
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
    from scout_pin.report.drawn.neutral import neutral_scene

    if arguments.gait is not None or arguments.specification is None:
        return None
    return neutral_scene(robot)


def sliders(arguments: argparse.Namespace, robot: Scout) -> LivePage:
    """The biped moved by sliders.

    Raises:
        BadInput: Something is asked of a gait.
    """
    from scout_pin.report.drawn.sliders import slider_page

    refuse_beside(arguments, "sliders", ("gait", "interpolation", "time-unit", "cycle", "branch"))
    refuse_set(arguments, "sliders", smooth="auto", repeat=1)
    return slider_page(robot, shown_by(arguments, "scout-pin"))


def motion(arguments: argparse.Namespace, robot: Scout) -> Movement:
    """The gait that the arguments ask for, to be written down."""
    from scout_pin.report.movement import gait_movement

    gait = _gait(arguments, robot)
    if gait.variants is not None:
        say(
            "warning: the samples are smoothed within their resolution, which what is written "
            "doesn't tell; --smooth none writes them as they are"
        )
    return gait_movement(
        robot,
        gait,
        samples=arguments.samples,
        time_unit=arguments.time_unit,
        branch=arguments.branch,
    )


def _gait(arguments: argparse.Namespace, robot: Scout) -> Gait:
    """The gait that the arguments ask for, once."""
    from scout_pin.motion.files import load_gait

    if arguments.gait is None and arguments.specification is not None:
        say(
            "warning: no --gait is given and the thesis's is taken, which was made for its own "
            "robot; scout-pin new FILE --motion sway makes one for this robot"
        )
    gait = load_gait(
        "thesis" if arguments.gait is None else arguments.gait,
        arguments.interpolation,
        robot=robot,
        smooth=arguments.smooth,
        time_unit=arguments.time_unit,
    )
    return replace(gait, cycle=True) if arguments.cycle else gait


def conditions(arguments: argparse.Namespace) -> Conditions:
    """What the arguments have a gait walked with, and on."""
    from scout_pin.study.simulate.conditions import Conditions

    ahead, right = np.radians(arguments.floor_tilt).tolist()
    return Conditions(
        gains=gains(arguments),
        sag_compensation=not arguments.no_sag_compensation,
        friction=arguments.friction,
        floor_tilt=(ahead, right),
        armature=arguments.armature,
        **tried(arguments),
    )


def gains(arguments: argparse.Namespace) -> ServoGains:
    """How the arguments have position servos answer."""
    from scout_pin.study.servo import ServoGains

    asked = {
        name: getattr(arguments, f"servo_{name}")
        for name in ("stiffness", "damping")
        if getattr(arguments, f"servo_{name}") is not None
    }
    return ServoGains(**asked)


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
    kind, name = arguments.motion or "specification", None
    if arguments.motion and arguments.example:
        raise BadInput("--motion and --example are two files", remedy="Write one at a time")
    if arguments.specification is not None and not arguments.motion:
        raise BadInput("--specification means nothing without --motion", remedy="Add --motion sway")
    check_new(arguments.target, replace=arguments.force)
    with Bar("making it"):
        from thesis_pin.report.writers import json_bytes

        if arguments.motion is not None:
            from scout_pin.making.gaits import gait_text

            with warned():
                robot = load(arguments.specification)
            name, content = robot.specification.name, gait_text(robot, arguments.motion).encode()
        elif arguments.example is not None:
            folder, kind = shipped_folder("examples"), "example"
            names = sorted(path.name for path in folder.iterdir() if path.is_file())
            content = (folder / choice("example", arguments.example, names)).read_bytes()
        else:
            content = NEW_PATH.read_bytes()
    put_new(arguments.target, content, replace=arguments.force)
    if arguments.json:
        document = {"schema": "scout-pin/new", "version": 1, "kind": kind, "robot": name}
        put(arguments.json, json_bytes(document | {"file": arguments.target}))
    return ExitCode.DONE


def from_urdf(arguments: argparse.Namespace) -> ExitCode:
    """Read a robot's description into a specification."""
    check_new(arguments.to, replace=arguments.force)
    with Bar("reading the axes"):
        from scout_pin.making.from_urdf import document, text
        from scout_pin.making.from_urdf import from_urdf as translated
        from thesis_pin.report.writers import json_bytes

        found = translated(
            arguments.file,
            left=arguments.left,
            sole=arguments.sole,
            servo=arguments.servo,
            friction=arguments.friction,
        )
        content = text(found).encode()
    for note in found.notes:
        say(f"note: {note}")
    for odd in implausible(found.specification):
        say(f"warning: {odd}")
    put_new(arguments.to, content, replace=arguments.force)
    if arguments.json:
        put(arguments.json, json_bytes(document(found) | {"file": arguments.to}))
    return ExitCode.DONE
