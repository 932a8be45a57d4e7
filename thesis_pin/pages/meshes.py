"""Shapes of a robot whose files may be missing: what is there is drawn, what isn't is said."""

from __future__ import annotations

from collections.abc import Sequence

import pinocchio as pin

from thesis_pin.errors import ThesisPinError
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.model.meshes import with_meshes_there


def seen(robot: LoadedRobot, kind: str, notes: list[str]) -> pin.GeometryModel:
    """The geometry of a robot without the shapes whose meshes are missing or can't be read.

    Args:
        robot: The robot.
        kind: ``visual`` or ``collision``.
        notes: Is told of these.
    """
    try:
        whole: pin.GeometryModel = getattr(robot, f"{kind}_model")
        return whole
    except ThesisPinError as error:
        why = str(error)
    text, missing = with_meshes_there(robot.description, kind)
    try:
        kinds = {"visual": pin.GeometryType.VISUAL, "collision": pin.GeometryType.COLLISION}
        found = pin.buildGeomFromUrdfString(robot.model, text, kinds[kind])
    except (RuntimeError, ValueError):  # a mesh that is there and can't be read
        notes.append(f"{kind} shapes aren't drawn: {why}")
        return pin.GeometryModel()
    few = "a shape isn't" if len(missing) == 1 else f"{len(missing)} meshes aren't there and aren't"
    notes.append(f"{kind}: {few} drawn: {missing[0]}" if missing else f"{kind} shapes: {why}")
    return found


def bare(robot: LoadedRobot, found: pin.GeometryModel, notes: Sequence[str]) -> bool:
    """Whether bars have to show where the robot is: it has no shape, or most joints lost theirs.

    Args:
        robot: The robot.
        found: Its visual shapes that are there.
        notes: On those that aren't.
    """
    joints = {one.parentJoint for one in found.geometryObjects} - {0}
    return not found.ngeoms or (bool(notes) and 2 * len(joints) < robot.model.njoints - 1)
