"""What the verb ``balance`` of ``thesis-pin`` does; imported when it runs."""

from __future__ import annotations

import argparse
import warnings

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.command.flags.words import closures_and_motion
from thesis_pin.command.results import deliver
from thesis_pin.command.running import ExitCode
from thesis_pin.command.warned import warned
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.finding import find_feet
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.soles.stated import stated_feet
from thesis_pin.contacts.standing.references import preferred, reference_poses
from thesis_pin.contacts.standing.told import headings_of, told_contacts
from thesis_pin.errors import BadInput, ModelWarning, UnknownName
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.balance.making import balance_report
from thesis_pin.smoothing.stated import stated

Array = NDArray[np.float64]


def balance(arguments: argparse.Namespace) -> ExitCode:
    """Report on a robot on its feet."""
    return deliver(
        arguments,
        "working out the balance",
        lambda _: _report(arguments),
        figures="thesis_pin.report.balance.figures:figures",
        page="thesis_pin.pages.reports.balance:balance_page",
        table="thesis_pin.report.balance.tables:summary",
    )


def _report(arguments: argparse.Namespace) -> BalanceReport:
    stated(arguments.smooth)  # also where a pose is held, which has no samples
    closures, file = closures_and_motion(arguments)
    with warnings.catch_warnings(action="ignore", category=ModelWarning):  # the report says them
        robot = load(arguments.file, closures, root_joint=pin.JointModelFreeFlyer())
    with warned():
        pose, said = _pose(robot, arguments)
        feet = _feet(robot, arguments, pose)
        if arguments.feet is None:
            said.append(f"Feet, which nobody named: {', '.join(foot.name for foot in feet)}.")
        placed = bool(np.abs(pose[:7] - robot.q0[:7]).max() > 0) and arguments.pose is not None
        motion = support = None
        if file is not None:
            names = [foot.name for foot in feet]
            support = told_contacts(file, names)  # before: two tables don't fit into memory
            motion = read_motion(robot, file, smooth=arguments.smooth, beside=headings_of(names))
        return balance_report(
            robot,
            motion,
            pose=pose,
            placed=placed,
            feet=feet,
            support=support,
            floor=_floor(arguments),
            fitted=arguments.floor_height is None,
            sharing=arguments.sharing,
            precision=arguments.precision,
            chosen=said,
        )


def _pose(robot: ClosedRobot, arguments: argparse.Namespace) -> tuple[Array, list[str]]:
    """The pose that is held or started from, and what was chosen."""
    known = {**reference_poses(robot)}
    name, said = arguments.pose, list[str]()
    if name is None and (name := preferred(list(known))) is not None:
        said.append(f"The pose, which nobody named: {name}, of the SRDF beside the description.")
    if name in known and name not in robot.supplement.poses:
        return close(robot, known[name], precision=arguments.precision), said
    try:
        found = assembly(robot, name, precision=arguments.precision)
    except UnknownName as error:
        if error.kind != "pose":
            raise
        raise UnknownName("pose", name, [*known, *error.known], where=error.where) from None
    if not found.closed:
        raise BadInput(
            f"its loops don't close from {found.start}",
            where=robot.description.where,
            remedy="thesis-pin check says where they are open least",
        )
    if name is None:
        said.append(f"The pose, which nobody named: {found.start}.")
    return found.q, said


def _feet(robot: ClosedRobot, arguments: argparse.Namespace, pose: Array) -> tuple[Foot, ...]:
    if arguments.feet is None:
        return find_feet(robot, pose=pose, friction=arguments.friction)
    words = arguments.feet.split(",")
    return stated_feet(robot, words, pose=pose, friction=arguments.friction)


def _floor(arguments: argparse.Namespace) -> Floor | None:
    """The floor that the arguments say; None if they leave it open."""
    slope, uphill = np.radians(arguments.slope)
    if arguments.floor_height is None and not slope:
        return None
    return Floor(arguments.floor_height or 0.0, float(slope), float(uphill))
