"""What a specification describes, as a document and as tables."""

from __future__ import annotations

from typing import Any

import numpy as np

from pollard_pin.closure import gruebler
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH
from pollard_pin.model import Pollard
from pollard_pin.specification import ACTUATORS, JOINT_NAMES, JOINT_SYMBOLS, LINK_NAMES
from thesis_pin.command.output import print_table, print_text
from thesis_pin.version import __version__

SCHEMA = "pollard-pin/info"
VERSION = 1


def document(robot: Pollard) -> dict[str, Any]:
    """Joints, bodies, mobility and assumptions of a robot, JSON-ready."""
    specification = robot.specification
    bodies = []
    for name in LINK_NAMES:
        mass, tensor = specification.links[name].mass, specification.centroidal(name, robot.inertia)
        largest = float(np.linalg.eigvalsh(tensor)[-1])
        bodies.append(
            {
                "name": name,
                "mass": mass,
                "com": specification.com(name),
                "inertia": tensor,
                "radius_of_gyration": float(np.sqrt(largest / mass)),
                "span": specification.span(name),
            }
        )
    pose = typical_pose(robot)
    solution = robot.inverse_kinematics(pose, DEFAULT_BRANCH)
    freedom = robot.mobility(solution.angles).freedom if solution.reachable else None
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "robot": specification.name,
        "source": specification.source,
        "inertia": robot.inertia,
        "mass": robot.mass,
        "joints": [
            {
                "name": name,
                "symbol": symbol,
                "motor": k in ACTUATORS,
                "lower": float(robot.lower[k]),
                "upper": float(robot.upper[k]),
            }
            for k, (name, symbol) in enumerate(zip(JOINT_NAMES, JOINT_SYMBOLS, strict=True))
        ],
        "bodies": bodies,
        "loops": [{"name": loop.name, "frames": list(loop.frames)} for loop in robot.loops],
        "freedom": {"counted": gruebler(), "by_rank": freedom, "at_pose": pose},
        "assumptions": specification.assumptions.model_dump(mode="json"),
        "thesis_pin": __version__,
    }


def typical_pose(robot: Pollard) -> np.ndarray:
    """A pose inside the workspace: where the specification puts appendix B's curve."""
    placement = robot.specification.assumptions.placement
    return np.concatenate([placement.position, np.radians(placement.orientation_deg)])


def print_info(robot: Pollard) -> None:
    """Print the document as tables of at most 80 columns."""
    content = document(robot)
    print_text(
        f"{content['robot']}: {content['source']}. {content['mass']:.3f} kg, "
        f"{robot.inertia} inertias."
    )
    rows = []
    for joint in content["joints"]:
        low, high = np.degrees([joint["lower"], joint["upper"]])
        kind = "motor" if joint["motor"] else "passive"
        rows.append((joint["name"], joint["symbol"], kind, f"{low:g}", f"{high:g}"))
    print_table(("joint", "symbol", "", "lower [°]", "upper [°]"), rows)
    weights = [
        (
            body["name"],
            f"{body['mass']:.3f}",
            f"{body['radius_of_gyration'] * 1e3:.0f}",
            f"{body['span'] * 1e3:.0f}",
        )
        for body in content["bodies"]
    ]
    print_table(("body", "mass [kg]", "gyration [mm]", "length [mm]"), weights)
    freedom = content["freedom"]
    print_text(
        f"Degrees of freedom: {freedom['counted']} by counting (2.2), "
        f"{freedom['by_rank']} by rank at the path's origin; 6 motors.",
        "",
        "Assumptions (numbers the thesis leaves open):",
    )
    for name, entry in content["assumptions"].items():
        for one in entry if isinstance(entry, list) else [entry]:
            print_text(f"- {name.replace('_', ' ')}: {one['why']}")
