"""What a specification describes, as a document."""

from __future__ import annotations

import numpy as np

from scout_pin.implausible import implausible
from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from scout_pin.urdf import JOINT_AXES
from thesis_pin.report import info


def document(robot: Scout) -> info.Info:
    """A robot's joints, bodies, reach and assumptions, JSON-ready."""
    spec = robot.specification
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
        stated=spec.assumptions,
        implausible=implausible(spec),
    )
