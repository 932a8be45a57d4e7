"""Poses in which somebody stood a robot: group states of SRDF files beside its URDF."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.loops.checking.poses import configuration
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.formats.xml import parse_xml
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.source import read_bytes

Array = NDArray[np.float64]

PREFERRED = ("half_sitting", "standing")
"""Names of poses that robots stand in, the first of which is taken."""

_FOLDERS = ("srdf", "../srdf", ".")


def reference_poses(robot: ClosedRobot) -> dict[str, Array]:
    """Group states of an SRDF beside the robot's description, by name; joints it lacks count not.

    Looked for in the file's folder, in ``srdf`` below and beside it: files called as the
    description or its robot. The root's placement in them is dropped.

    Returns:
        Name → configuration, shape ``(nq,)``; empty if there is no such file.
    """
    names = {robot.model.name, Path(robot.description.where).stem}
    found: dict[str, Array] = {}
    for folder in robot.description.mesh_folders[:1]:
        for place in _FOLDERS:
            for file in sorted(Path(folder, place).glob("*.srdf")):
                if file.stem in names and not found:
                    found = _states(robot, file)
    return found


def preferred(poses: Sequence[str]) -> str | None:
    """The pose to stand in, of several; None if there is none."""
    return next((name for name in (*PREFERRED, *poses) if name in poses), None)


def _states(robot: ClosedRobot, file: Path) -> dict[str, Array]:
    try:
        root, _ = parse_xml("SRDF", read_bytes("SRDF", file, LIMITS.urdf_bytes), where=str(file))
    except BadInput:  # a file nobody named; its pose is a convenience
        return {}
    known = dict.fromkeys(list(robot.model.names)[2:])
    found = {}
    for state in root.iter("group_state"):
        values = {}
        for joint in state.iter("joint"):
            name, numbers = joint.get("name", ""), joint.get("value", "").split()
            if name in known:
                try:
                    values[name] = tuple(float(number) for number in numbers)
                except ValueError:
                    continue
        try:
            found[state.get("name", "")] = configuration(robot, values, where=str(file))
        except BadInput:
            continue
    return found
