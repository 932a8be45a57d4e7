"""Which motors of a list carry a motion of any robot."""

from __future__ import annotations

import numpy as np

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import instance
from thesis_pin.report.torque.document import TorqueReport
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.document import Sizing
from thesis_pin.sizing.document import size as size_loads
from thesis_pin.sizing.loads import Loads, resolution_notes

ROTORS = (
    "The description's own rotors at the motors' joints aren't counted: each servo's stands in for "
    "them."
)
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
    instance("report", report, TorqueReport, "thesis_pin.torque_report()")
    if not report.turning.any():
        raise BadInput(
            "no motor turns: servos carry torques",
            where=report.robot.description.where,
            remedy="Name the motors in the closure file (name_mot)" if not report.names else "",
        )
    turning = np.flatnonzero(report.turning)
    robot, joints = report.robot, report.joints
    places = robot.actuated[turning]
    names = [report.names[k] for k in turning]
    notes = (
        []
        if report.headlines is None
        else resolution_notes(names, [report.headlines.peak_torque[k] for k in turning])
    )
    armature = np.asarray(robot.model.armature)[places]
    if armature.any():
        notes.append(ROTORS)
    if not report.dynamics.unique.all():
        notes.append(SHARED)
    slide = [name for name in report.names if name not in names]
    if slide:
        notes.append(f"Left out, for they slide: {', '.join(slide)}.")
    return size_loads(
        Loads.of(
            robot.model.name,
            report.motion.name,
            names,
            joints.time,
            report.dynamics.torque[:, turning],
            joints.v[:, places],
            joints.a[:, places],
            armature,
            notes,
        ),
        catalogue,
        factor,
    )
