"""Configurations by name or from a file, for any robot.

A pose's file is TOML: ``format = 1`` and a table ``[joints]`` of positions [rad], [m], or
``[joints_deg]`` [°]; a joint of several coordinates has a list of them, as Pinocchio counts
them. Joints that aren't named are neutral.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray
from pydantic import Field

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.loading import LoadedRobot, joint_id
from thesis_pin.model.specification import Key, Strict, read_toml

Array = NDArray[np.float64]

Values = Annotated[dict[str, float | tuple[float, ...]], Field(max_length=LIMITS.entries)]


class PoseFile(Strict):
    """A pose in TOML."""

    format: Literal[1]
    joints: Values = Field(default_factory=dict)
    joints_deg: Values = Field(default_factory=dict)

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """No joint is given twice; lists aren't angles."""
        for name, value in self.joints_deg.items():
            if name in self.joints:
                yield ("joints_deg", name), "is given in joints too", None
            if isinstance(value, tuple):
                yield ("joints_deg", name), "must be one angle", None


def neutral(robot: ClosedRobot) -> Array:
    """The neutral configuration, moved into the joints' ranges, shape ``(nq,)``."""
    return in_range(robot, robot.q0)


def in_range(robot: ClosedRobot, q: Array) -> Array:
    """A configuration with every joint moved into its range, shape ``(nq,)``."""
    q = q.copy()
    for joint in singles(robot.model).values():
        if not joint.continuous:
            q[joint.q] = np.clip(q[joint.q], joint.low, joint.high)
    return q


def named_pose(robot: ClosedRobot, pose: str) -> Array:
    """A configuration by the name that the description gives it, or from a file.

    Args:
        robot: The robot.
        pose: ``neutral``, a name of the description's, or a path that ends in ``.toml``.

    Returns:
        The configuration, loops not necessarily closed, shape ``(nq,)``.

    Raises:
        UnknownName: There is no such pose, or it names a joint that isn't there.
        BadInput: The file can't be read, or a joint has another number of coordinates.
    """
    poses = robot.supplement.poses
    if pose in poses:
        return configuration(robot, poses[pose], where=f"pose {pose!r}")
    if pose == "neutral":
        return neutral(robot)
    if Path(pose).suffix.lower() != ".toml":
        raise UnknownName("pose", pose, ["neutral", *poses, "a .toml file"])
    file = read_toml("pose", PoseFile, pose)
    values: dict[str, Sequence[float]] = {
        name: value if isinstance(value, tuple) else (value,) for name, value in file.joints.items()
    }
    values |= {name: (float(np.radians(value)),) for name, value in file.joints_deg.items()}
    return configuration(robot, values, where=pose)


def pose_text(robot: LoadedRobot, q: Array) -> str:
    """A configuration ``(nq,)`` as a pose's file: :func:`named_pose` reads it back.

    Args:
        robot: The robot.
        q: The configuration, shape ``(nq,)``.
    """
    known, lines = singles(robot.model), ["format = 1", "[joints]"]
    for name, joint in zip(list(robot.model.names)[1:], list(robot.model.joints)[1:], strict=True):
        values = q[joint.idx_q : joint.idx_q + joint.nq].tolist()
        if name in known and known[name].continuous:
            values = [float(known[name].position(q))]
        if values:
            key = json.dumps(name, ensure_ascii=False).replace("\x7f", "\\u007f")
            lines.append(f"{key} = {values[0] if len(values) == 1 else values}")
    return "\n".join(lines) + "\n"


def configuration(
    robot: ClosedRobot, values: Mapping[str, Sequence[float]], *, where: str = "pose"
) -> Array:
    """Positions of some joints as a configuration; the others are neutral.

    Args:
        robot: The robot.
        values: Joint → its coordinates as Pinocchio counts them; a continuous joint's may be
            its angle.
        where: For messages.

    Raises:
        UnknownName: The robot has no such joint.
        BadInput: A joint has another number of coordinates.
    """
    q = neutral(robot)
    known = singles(robot.model)
    for name, given in values.items():
        joint = robot.model.joints[joint_id(robot.model, name, where=where)]
        numbers = np.array(given, dtype=float)
        if name in known and known[name].continuous and numbers.size == 1:
            numbers = np.array([np.cos(numbers[0]), np.sin(numbers[0])])
        if numbers.size != joint.nq:
            raise BadInput(
                f"joint {name!r} has {numbers.size} coordinates", where=where, allowed=f"{joint.nq}"
            )
        q[joint.idx_q : joint.idx_q + joint.nq] = numbers
    return np.asarray(pin.normalize(robot.model, q))
