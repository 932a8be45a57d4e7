"""What a specification describes, as a table and as JSON."""

from __future__ import annotations

from typing import Any

import numpy as np

from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, JOINT_SYMBOLS, LINK_NAMES, SIDES
from scout_pin.urdf import JOINT_AXES
from thesis_pin.command.output import print_table, print_text


def document(robot: Scout) -> dict[str, Any]:
    """A robot's joints, bodies, reach and assumptions, JSON-ready."""
    spec = robot.specification
    feet = robot.neutral_feet()
    joints = [
        {
            "name": name,
            "symbol": JOINT_SYMBOLS[k],
            "axis": JOINT_AXES[k % 6],
            "lower": float(robot.lower[k]),
            "upper": float(robot.upper[k]),
            "stall_torque": float(robot.stall_torque[k]),
            "no_load_speed": float(robot.no_load_speed[k]),
        }
        for k, name in enumerate(JOINT_NAMES)
    ]
    bodies = {"torso": spec.torso} | {
        f"{side}_{name}": link
        for side in SIDES
        for name, link in zip(LINK_NAMES, spec.leg(side).links, strict=True)
    }
    return {
        "schema": "scout-pin/info",
        "version": 1,
        "name": spec.name,
        "source": spec.source,
        "mass": robot.mass,
        "inertia": robot.inertia,
        "joints": joints,
        "bodies": [
            {
                "name": name,
                "mass": link.mass,
                "com": list(link.com),
                "principal_moments": np.linalg.eigvalsh(
                    link.centroidal(spec.inertia_convention, robot.inertia)
                ),
            }
            for name, link in bodies.items()
        ],
        "neutral_feet": {side: feet[side][:3, 3].copy() for side in SIDES},
        "assumptions": [
            {"name": name, **getattr(spec.assumptions, name).model_dump()}
            for name in type(spec.assumptions).model_fields
        ],
    }


def print_info(robot: Scout) -> None:
    """Print :func:`document` for people."""
    data = document(robot)
    print_text(f"{data['name']}: {data['source']}. Mass {robot.mass:.5g} kg, 18 DoF, 13 links.")
    print_table(
        ("joint", "", "axis", "range °", "stall N·m", "no-load rad/s"),
        [
            (
                joint["name"],
                joint["symbol"],
                joint["axis"],
                f"{np.degrees(joint['lower']):g} to {np.degrees(joint['upper']):g}",
                f"{joint['stall_torque']:g}",
                f"{joint['no_load_speed']:g}",
            )
            for joint in data["joints"]
        ],
    )
    print_table(
        ("link", "mass g", "centre of mass mm", "principal moments kg·mm²"),
        [
            (
                body["name"],
                f"{body['mass'] * 1e3:.2f}",
                " ".join(f"{value * 1e3:.2f}" for value in body["com"]),
                " ".join(f"{value * 1e6:.2f}" for value in body["principal_moments"]),
            )
            for body in data["bodies"]
        ],
        title=f"Inertias: {robot.inertia} reading, about the centre of mass",
    )
    for side, point in data["neutral_feet"].items():
        place = ", ".join(f"{value * 1e3:.3f}" for value in point)
        print_text(f"Neutral {side} sole in the torso frame: ({place}) mm.")
    for assumption in data["assumptions"]:
        values = ", ".join(
            f"{key} {value}" for key, value in assumption.items() if key not in ("name", "why")
        )
        print_text(
            f"Assumed {assumption['name'].replace('_', ' ')}: {values} ({assumption['why']})."
        )
