"""Which motors of a list carry a path."""

from __future__ import annotations

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATORS
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.long import gathered
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.document import Sizing
from thesis_pin.sizing.document import size as size_loads
from thesis_pin.sizing.loads import Loads, resolution_notes


def size(report: TrajectoryReport, catalogue: Catalogue, factor: float = 1.0) -> Sizing:
    """Hold motors against what a path asks of each joint.

    Args:
        report: From :func:`pollard_pin.trajectory_report`, with six motors.
        catalogue: From :func:`thesis_pin.sizing.catalogue.read_catalogue`.
        factor: Least safety factor.

    Raises:
        BadInput: The report is of the thesis's three motors, which leave part of the load.
    """
    return size_loads(loads_of(report), catalogue, factor)


def loads_of(report: TrajectoryReport) -> Loads:
    """What a path asks of each motor's joint, without any rotor.

    Raises:
        BadInput: The report is of the thesis's three motors.
    """
    instance("report", report, TrajectoryReport, "pollard_pin.trajectory_report()")
    if report.three is not None:
        raise BadInput(
            "three motors don't carry the whole load, so that their torques size nothing",
            allowed="six",
        )
    joints, count = report.joints, len(report.joints.time)
    held = report.headlines
    return Loads.of(
        report.robot.specification.name,
        report.path.name,
        ACTUATOR_NAMES,
        joints.time,
        report.torque,
        gathered(count, joints.part, lambda part: part.v[:, ACTUATORS]),
        gathered(count, joints.part, lambda part: part.a[:, ACTUATORS]),
        report.robot.specification.motors.armature(),
        [
            *(f"{one[0].upper()}{one[1:]}." for one in report.foreign),
            *([] if held is None else resolution_notes(ACTUATOR_NAMES, held.peak_torque)),
        ],
    )
