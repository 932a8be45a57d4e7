"""Which servos of a list carry a gait."""

from __future__ import annotations

from scout_pin.report.document import GaitReport
from scout_pin.specification import JOINT_NAMES
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.long import gathered
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.document import Sizing
from thesis_pin.sizing.document import size as size_loads
from thesis_pin.sizing.loads import Loads, resolution_notes

SHARING = (
    "In double support the feet share the load as they do with the specification's own servos."
)


def size(report: GaitReport, catalogue: Catalogue, factor: float = 1.0) -> Sizing:
    """Hold servos against what a gait asks of each joint.

    Args:
        report: From :func:`scout_pin.gait_report`.
        catalogue: From :func:`thesis_pin.sizing.catalogue.read_catalogue`.
        factor: Least safety factor.
    """
    instance("report", report, GaitReport, "scout_pin.gait_report()")
    return size_loads(loads_of(report), catalogue, factor)


def loads_of(report: GaitReport) -> Loads:
    """What a gait asks of each joint, without any rotor."""
    joints, count = report.joints, len(report.joints.time)
    held = report.headlines
    return Loads.of(
        report.robot.specification.name,
        f"gait {report.gait.name!r}",
        JOINT_NAMES,
        joints.time,
        report.dynamics.torque,
        gathered(count, joints.part, lambda part: part.v),
        gathered(count, joints.part, lambda part: part.a),
        report.robot.specification.armature(),
        [
            *(f"{one[0].upper()}{one[1:]}." for one in report.foreign),
            SHARING,
            *([] if held is None else resolution_notes(JOINT_NAMES, held.peak_torque)),
        ],
    )
