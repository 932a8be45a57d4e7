"""Which motors carry a motion of any robot: of a list, or the smallest of any size."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import choice, instance
from thesis_pin.report.torque.document import TorqueReport
from thesis_pin.sizing.actuator import RATED
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.document import Sizing
from thesis_pin.sizing.document import size as size_loads
from thesis_pin.sizing.loads import Array, Loads, resolution_notes
from thesis_pin.sizing.smallest.answer import Answer
from thesis_pin.sizing.smallest.family import Bound, Family
from thesis_pin.sizing.smallest.result import smallest

ROTORS = (
    "The description's own rotors at the motors' joints aren't counted: each servo's stands in for "
    "them."
)
_UNBOUNDED = 1e6
"""Speed [rad/s] from which a description's limit is none."""
SHARED = (
    "There are more motors than freedoms: they share the load with the least sum of squares, and "
    "another sharing asks otherwise of them."
)


def size_motors(report: TorqueReport, catalogue: Catalogue, factor: float = 1.0) -> Sizing:
    """Hold servos or motors against what a motion asks of each motor of a robot.

    Args:
        report: From :func:`thesis_pin.torque_report`.
        catalogue: From :func:`thesis_pin.read_catalogue`.
        factor: Least safety factor.

    Returns:
        The answer, by the motors' own names. Motors that slide are left out, and named.

    Raises:
        BadInput: No motor turns.
    """
    loads = loads_of(report)
    if np.asarray(report.robot.model.armature)[_places(report)].any():
        loads = replace(loads, notes=(ROTORS, *loads.notes))
    return size_loads(loads, catalogue, factor)


def motor_family(
    report: TorqueReport,
    *,
    speed: float | None = None,
    armature: float | None = None,
    exponent: float = 0.0,
    power: float | None = None,
    rating: float = RATED,
    bound: Bound = "box",
) -> Family:
    """Motors of any size with the speeds and rotors that the robot's description says.

    Args:
        report: From :func:`thesis_pin.torque_report`.
        speed: No-load or greatest speed [rad/s]; None for what the description says of each
            motor's joint, and none where it says nothing.
        armature: N² J of a motor of 1 N·m [kg·m²]; None for what the description says.
        exponent: How it grows with the stall torque.
        power: Greatest power [W], instead of the speed.
        rating: Share of the stall torque that is borne for long.
        bound: How torque and speed bound each other.
    """
    places = _places(report)
    model = report.robot.model
    limit = np.asarray(model.velocityLimit)[places]
    own = np.where(np.isfinite(limit) & (limit > 0.0) & (limit < _UNBOUNDED), limit, np.inf)
    return Family.of(
        len(places),
        own if speed is None else speed,
        np.asarray(model.armature)[places] if armature is None else armature,
        exponent=exponent,
        bound=bound,
        power=power,
        rating=rating,
    )


def smallest_motors(
    report: TorqueReport,
    family: Family | None = None,
    *,
    per: Literal["joint", "robot"] = "joint",
    factor: float = 1.0,
) -> Answer:
    """The smallest motors of one kind that carry a motion of any robot as it is timed.

    Args:
        report: From :func:`thesis_pin.torque_report`.
        family: Which motors there are; None for :func:`motor_family`.
        per: Whether each ``"joint"`` has its own, or all of the ``"robot"`` are alike.
        factor: Least safety factor.

    Raises:
        BadInput: No motor turns, or a number can't be.
    """
    loads = loads_of(report)
    family = motor_family(report) if family is None else family
    choice("way to group joints", per, ("joint", "robot"))
    alike = None if per == "joint" else {"all motors": tuple(range(len(loads.joints)))}
    duration = float(loads.time[-1] - loads.time[0])
    case = smallest(loads, family, alike, factor=factor, timing=f"As it is timed, {duration:.4g} s")
    return Answer(loads.robot, loads.motion, loads.joints, (case,))


def loads_of(report: TorqueReport) -> Loads:
    """What a motion asks of each motor that turns, without any rotor.

    Raises:
        BadInput: No motor turns.
    """
    places = _places(report)
    turning = np.flatnonzero(report.turning)
    robot, joints = report.robot, report.joints
    names = [report.names[k] for k in turning]
    notes = (
        []
        if report.headlines is None
        else resolution_notes(names, [report.headlines.peak_torque[k] for k in turning])
    )
    armature = np.asarray(robot.model.armature)[places]
    if not report.dynamics.unique.all():
        notes.append(SHARED)
    slide = [name for name in report.names if name not in names]
    if slide:
        notes.append(f"Left out, for they slide: {', '.join(slide)}.")
    return Loads.of(
        robot.model.name,
        report.motion.name,
        names,
        joints.time,
        report.dynamics.torque[:, turning],
        joints.v[:, places],
        joints.a[:, places],
        armature,
        notes,
    )


def _places(report: TorqueReport) -> Array:
    """Where the motors that turn stand among the velocities.

    Raises:
        BadInput: No motor turns.
    """
    instance("report", report, TorqueReport, "thesis_pin.torque_report()")
    if not report.turning.any():
        raise BadInput(
            "no motor turns: servos carry torques",
            where=report.robot.description.where,
            remedy="Name the motors in the closure file (name_mot)" if not report.names else "",
        )
    return np.asarray(report.robot.actuated[np.flatnonzero(report.turning)])
