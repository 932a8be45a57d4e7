"""What the verbs of ``thesis-pin`` do; imported when a verb runs."""

from __future__ import annotations

import argparse
import warnings

import pinocchio as pin

from thesis_pin.command.flags.words import closures_and_motion
from thesis_pin.command.results import Answer, deliver, give, put_folder
from thesis_pin.command.running import ExitCode
from thesis_pin.command.showing.beside import ANY, TWO, Beside, reports, scene_of, second_of
from thesis_pin.command.showing.sliders import any_robot, show_sliders
from thesis_pin.command.sizing.delivering import deliver as deliver_smallest
from thesis_pin.command.sizing.finding import bounded, check_words, deliver_sizes
from thesis_pin.command.verbs.alike import show_scene
from thesis_pin.command.warned import warned
from thesis_pin.display.counted import counted
from thesis_pin.errors import BadInput, ModelWarning
from thesis_pin.loops.checking import soundness
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.model.mechanism.supplement import Motor
from thesis_pin.model.pair import pair
from thesis_pin.numeric.checks import shown
from thesis_pin.pages.scene import Scene
from thesis_pin.report import formats as read
from thesis_pin.report.tables import Part, Table
from thesis_pin.report.torque.document import TorqueReport, torque_report
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.document import Sizing
from thesis_pin.sizing.motors import motor_family, size_motors, smallest_motors
from thesis_pin.sizing.smallest.answer import Answer as Smallest


def check(arguments: argparse.Namespace) -> ExitCode:
    """Say whether a description is sound, where it closes, and what holds it."""

    def answer() -> Answer:
        robot = loaded(arguments)
        found = soundness.check(robot, pose=arguments.pose, precision=arguments.precision)
        if arguments.out:
            files = {name: text.encode() for name, text in pair(robot.description).items()}
            put_folder(arguments.out, files)
        yes = found.sound and (found.held or not arguments.strict)
        return Answer(found.document, lambda: _tell(found), yes=yes)

    return give(arguments, answer, "checking")


def torque(arguments: argparse.Namespace) -> ExitCode:
    """Report on a motion of any robot."""
    if arguments.beside is not None:
        return deliver(arguments, "working out the torques", lambda _: _paired(arguments), **TWO)
    return deliver(
        arguments,
        "working out the torques",
        lambda _: _report(arguments),
        figures="thesis_pin.report.torque.figures:figures",
        page="thesis_pin.pages.reports.torque:torque_page",
        table="thesis_pin.report.torque.tables:summary",
    )


def size(arguments: argparse.Namespace) -> ExitCode:
    """Find motors for a motion of any robot: of lists, or the smallest of any size."""
    check_words(arguments)

    def least(_: object) -> Smallest:
        report = _report(arguments)
        family = motor_family(report, **bounded(arguments))
        alike = arguments.per == "robot"
        return smallest_motors(
            report, family, per="robot" if alike else "joint", factor=arguments.factor
        )

    if not arguments.servos:
        return deliver_smallest(arguments, "thesis-pin", least)

    def make(catalogue: Catalogue, _: object) -> Sizing:
        return size_motors(_report(arguments), catalogue, arguments.factor)

    return deliver_sizes(arguments, "thesis-pin", make)


def view(arguments: argparse.Namespace) -> ExitCode:
    """Show any robot in the browser, on a motion or moved by sliders, or write it as a page."""
    arguments.closures, arguments.motion = closures_and_motion(arguments)
    if arguments.motion is None:
        return show_sliders(
            arguments, "thesis-pin", lambda: any_robot(arguments, loaded(arguments))
        )
    from thesis_pin.pages.reports.torque_scene import scene

    def make(_: object) -> Scene:
        return (
            scene_of(_paired(arguments))
            if arguments.beside is not None
            else scene(_report(arguments))
        )

    return show_scene(arguments, "thesis-pin", make)


def _paired(arguments: argparse.Namespace) -> Beside:
    """The reports on both motions that the arguments name."""
    return reports(ANY, _report(arguments), _report(second_of(arguments, "motion")))


def _report(arguments: argparse.Namespace) -> TorqueReport:
    """The report on the motion that the arguments name."""
    robot = loaded(arguments)
    with warned():
        motion = _motion(arguments, robot)
        x = arguments.precision
        pose = assembly(robot, arguments.pose, precision=x).q
        external = _external(arguments)
        return torque_report(robot, motion, pose=pose, precision=x, external=external)


def formats(arguments: argparse.Namespace) -> ExitCode:
    """Say what is read of each format, and what is passed over."""
    return give(arguments, lambda: Answer(read.document, read.summary))


def loaded(arguments: argparse.Namespace) -> ClosedRobot:
    """The robot that the arguments name."""
    root = pin.JointModelFreeFlyer() if arguments.free_flyer else None
    with warnings.catch_warnings(action="ignore", category=ModelWarning):  # the verbs say them
        return load(arguments.file, arguments.closures, root_joint=root)


def _motion(arguments: argparse.Namespace, robot: ClosedRobot) -> JointMotion:
    """The motion that the arguments name."""
    return read_motion(
        robot,
        arguments.motion,
        smooth=arguments.smooth,
        frame=arguments.frame,
        euler=arguments.euler,
    )


def _external(arguments: argparse.Namespace) -> dict[str, tuple[float, ...]]:
    """Wrenches by frame, each frame once."""
    found: dict[str, tuple[float, ...]] = {}
    for frame, wrench in arguments.external:
        if frame in found:
            raise BadInput(
                f"--external is given twice for {shown(frame)}", remedy="Add the wrenches up"
            )
        found[frame] = wrench
    return found


def _named(motor: Motor) -> str:
    return motor.joint if motor.name == motor.joint else f"{motor.name} on {motor.joint}"


def _tell(found: soundness.Soundness) -> list[Part]:
    robot = found.robot
    rows = [
        (loop.name, loop.kind, *loop.frames, f"{gap.distance:.1e}", f"{gap.angle:.1e}")
        for loop, gap in zip(robot.loops, found.assembly.gaps, strict=False)
    ]
    columns = ("loop", "type", "frame", "frame", "gap m", "gap rad")
    motors = ", ".join(_named(motor) for motor in robot.motors)
    return [
        *([Table("", columns, rows)] if rows else []),
        f"{robot.model.name}: {counted(robot.model.njoints - 1, 'joint')}, "
        f"{counted(len(robot.motors), 'motor')}{f' ({motors})' if motors else ''}.",
        *found.sentences(),
        *(f"Warning: {one}" for one in found.warnings),
        *(f"Not used: {one}" for one in robot.description.passed_over),
    ]
