"""What a specification describes, as a document."""

from __future__ import annotations

import numpy as np

from scout_pin.implausible import implausible
from scout_pin.kinematics.neutral import Tilt, tilts
from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, JOINT_SYMBOLS, SIDES, Leg
from scout_pin.urdf import JOINT_AXES
from thesis_pin.errors import Problem, SpecificationError
from thesis_pin.report import info

LENGTHS = ("x_0", "z_1", "x_2", "x_3", "x_4", "x_5", "y_6")
"""Keys of a leg's lengths."""


def document(robot: Scout) -> info.Info:
    """A robot's joints, bodies, lengths, neutral soles and assumptions, JSON-ready.

    Raises:
        SpecificationError: A sole is tilted in the neutral pose; says which angles level it.
    """
    spec = robot.specification
    if wrong := tilts(spec):
        raise SpecificationError("specification", [_problem(robot, tilt) for tilt in wrong])
    joints: list[info.JointEntry] = [
        {
            "name": name,
            "symbol": JOINT_SYMBOLS[k],
            "axis": JOINT_AXES[k % 6],
            "motor": True,
            "lower": float(robot.lower[k]),
            "upper": float(robot.upper[k]),
            "effort": float(robot.stall_torque[k]),
            "velocity": float(robot.no_load_speed[k]),
        }
        for k, name in enumerate(JOINT_NAMES)
    ]
    bodies = [
        info.body(
            name,
            link.mass,
            np.array(link.com),
            link.centroidal(spec.inertia_convention, robot.inertia),
            spec.span(name),
        )
        for name, link in spec.links.items()
    ]
    feet = robot.neutral_feet()
    return info.document(
        "scout-pin",
        spec.name,
        source=spec.source,
        inertia=robot.inertia,
        mass=robot.mass,
        joints=joints,
        bodies=bodies,
        freedom={"counted": 6 + len(joints), "by_rank": robot.model.nv, "at_pose": None},
        neutral={f"{side}_sole": foot[:3, 3].copy() for side, foot in feet.items()},
        lengths={
            side: {name: float(getattr(spec.leg(side), name)) for name in LENGTHS} for side in SIDES
        },
        angles={side: _angles(spec.leg(side)) for side in SIDES},
        stated=spec.assumptions,
        implausible=implausible(spec),
    )


def page(robot: Scout) -> bytes:
    """The same as a page, with a drawing of each leg in the neutral pose.

    Raises:
        SpecificationError: See :func:`document`.
    """
    found = document(robot)
    from scout_pin.report.drawn.drawing import leg_drawing
    from thesis_pin.pages.page import Drawing
    from thesis_pin.pages.reports.info import info_page

    drawings = [
        Drawing(
            f"The {side} leg in the neutral pose",
            leg_drawing(robot, side),
            "Lengths x_0 to y_6 and constant angles β_1 to β_8; each angle turns the dashed axis "
            "into the next one about the joint's own axis.",
        )
        for side in SIDES
    ]
    return info_page(found, drawings)


def _angles(leg: Leg) -> dict[str, float]:
    degrees = (*leg.beta_deg, leg.beta_7_deg, leg.beta_8_deg)
    return {f"β_{k + 1}": float(np.radians(value)) for k, value in enumerate(degrees)}


def _problem(robot: Scout, tilt: Tilt) -> Problem:
    leg = robot.specification.leg(tilt.side)
    what = tilt.sentence(np.radians(leg.beta_deg))
    escape = '; if it is meant, write neutral_soles = "tilted" at the top'
    return Problem(robot.specification.name, f"legs.{tilt.side}.beta_deg", what + escape, "")
