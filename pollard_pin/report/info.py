"""What a specification describes, as a document."""

from __future__ import annotations

from typing import Any

import numpy as np

from pollard_pin.closure import gruebler
from pollard_pin.implausible import implausible
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH
from pollard_pin.model import Pollard
from pollard_pin.specification import (
    ACTUATORS,
    JOINT_NAMES,
    JOINT_SYMBOLS,
    LINK_NAMES,
    Chain0,
    SideChain,
    Specification,
)
from pollard_pin.urdf import JOINT_AXES
from thesis_pin.report import info


def document(robot: Pollard) -> info.Info:
    """A robot's joints, bodies, loops, mobility and assumptions, JSON-ready."""
    spec = robot.specification
    limits = [spec.assumptions.joint_limits.of_joint(k) for k in range(len(JOINT_NAMES))]
    joints: list[info.JointEntry] = [
        {
            "name": name,
            "symbol": JOINT_SYMBOLS[k],
            "axis": JOINT_AXES[k],
            "motor": k in ACTUATORS,
            "lower": float(robot.lower[k]),
            "upper": float(robot.upper[k]),
            "effort": limits[k][0] if k in ACTUATORS else None,
            "velocity": limits[k][1] if k in ACTUATORS else None,
        }
        for k, name in enumerate(JOINT_NAMES)
    ]
    bodies = [
        info.body(
            name,
            spec.links[name].mass,
            spec.com(name),
            spec.centroidal(name, robot.inertia),
            spec.span(name),
        )
        for name in LINK_NAMES
    ]
    pose = typical_pose(robot)
    solution = robot.inverse_kinematics(pose, DEFAULT_BRANCH)
    rank = robot.mobility(solution.angles).freedom if solution.reachable else None
    return info.document(
        "pollard-pin",
        spec.name,
        source=spec.source,
        inertia=robot.inertia,
        mass=robot.mass,
        joints=joints,
        bodies=bodies,
        loops=[{"name": loop.name, "frames": list(loop.frames)} for loop in robot.loops],
        freedom={"counted": gruebler(), "by_rank": rank, "at_pose": pose},
        neutral={"spray_tip": pose[:3]},
        lengths={name: _numbers(part, "") for name, part in _chains(spec).items()},
        angles={name: _numbers(part, "_deg") for name, part in _chains(spec).items()},
        stated=spec.assumptions,
        implausible=implausible(spec),
    )


def page(robot: Pollard) -> bytes:
    """The same as a page."""
    from thesis_pin.pages.reports.info import info_page

    return info_page(document(robot))


def _chains(spec: Specification) -> dict[str, Chain0 | SideChain]:
    return {"chain_0": spec.chain_0, "chain_1": spec.chain_1, "chain_2": spec.chain_2}


def _numbers(part: Chain0 | SideChain, unit: str) -> dict[str, float]:
    """Lengths [m], or with ``_deg`` angles [rad], by their symbol."""
    values: dict[str, Any] = {name: value for name, value in part if name != "links"}
    if unit:
        return {
            name.removesuffix(unit).replace("beta", "β"): float(np.radians(value))
            for name, value in values.items()
            if name.endswith(unit)
        }
    return {name: float(value) for name, value in values.items() if not name.endswith("_deg")}


def typical_pose(robot: Pollard) -> np.ndarray:
    """A pose inside the workspace: where the specification puts appendix B's curve."""
    placement = robot.specification.assumptions.placement
    return np.concatenate([placement.position, np.radians(placement.orientation_deg)])
