"""How a frame that leads a robot is turned: by three angles, by one, or as the robot keeps it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, SingularPose, Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.motion.told import COORDINATES, Tool
from thesis_pin.loops.system.rows import Mask
from thesis_pin.model.loading import frame_id
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_ALIGNED = 1e-6  # turns of a frame that counts as aligned with an axis [rad]
_UPRIGHT = 1e-3  # cosine of a pitch at which roll and yaw turn about one axis


def placed(robot: ClosedRobot, frame: str, q: Array) -> pin.SE3:
    """Where a frame of a robot is at a configuration ``(nq,)``."""
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q)
    return pin.SE3(pin.updateFramePlacement(robot.model, data, frame_id(robot.model, frame)))


def offset_of(robot: ClosedRobot, tool: Tool, pose: Array) -> Array:
    """What turns the frame into the one whose told orientation is that of the file.

    One angle alone turns about the world's axis from where the frame stands at the pose.
    """
    turns = [name for name in COORDINATES[3:] if name in tool.told]
    if len(turns) == 3 or not turns:
        return np.eye(3)
    what = f"{', '.join(turns)} of frame {tool.frame!r}"
    every = "Tell roll, pitch and yaw, or none of them"
    if len(turns) == 2:
        raise BadInput(f"{what} alone don't say an orientation", remedy=every)
    axis = COORDINATES[3:].index(turns[0])
    plane = {"xyz"[k] for k in range(3) if k != axis}
    if len(plane & set(tool.told)) == 1:
        raise BadInput(
            f"{what} is told, and only one of {' and '.join(sorted(plane))}", remedy="Tell both"
        )
    if tool.kept is not None and axis == 2:
        return np.asarray(_matrix(tool.kept).T)
    turn = placed(robot, tool.frame, pose).rotation
    angles = pin.rpy.matrixToRpy(turn)
    if axis == 1 and np.abs(np.abs(angles[[0, 2]]) - np.pi).max() < _ALIGNED:
        angles = np.array([0.0, np.pi - angles[1], 0.0])  # the same orientation
    upright = axis == 2 and abs(np.cos(angles[1])) < _UPRIGHT  # roll and yaw can't be told apart
    if (
        upright
        or (axis == 1 and abs(np.sin(angles[2])) > _ALIGNED)
        or (axis == 0 and max(abs(np.sin(angles[1])), abs(np.sin(angles[2]))) > _ALIGNED)
    ):
        raise BadInput(f"{what} alone doesn't say how it is turned here", remedy=every)
    alone = np.zeros(3)
    alone[axis] = angles[axis]
    return np.asarray(turn.T @ pin.rpy.rpyToMatrix(alone))


def refuse_otherwise(robot: ClosedRobot, tool: Tool, pose: Array) -> None:
    """Refuse an orientation that the robot doesn't keep by itself."""
    assert tool.kept is not None
    turn, here = _matrix(tool.kept), placed(robot, tool.frame, pose).rotation
    apart = here @ turn.T
    if "yaw" in tool.told:  # of which the column says how much
        apart = pin.Quaternion.FromTwoVectors(here.T[:, 2], turn.T[:, 2]).matrix()
    off = float(np.linalg.norm(pin.log3(apart)))
    if off > TOLERANCES.kept_turn:
        raise Unreachable(
            f"frame {tool.frame!r} is told to stand {np.degrees(off):.3g}° otherwise than the "
            "robot keeps it, which has no motor for that",
            remedy="Leave the orientation's columns out, or name another frame",
        )


def pose_told(robot: ClosedRobot, tool: Tool, pose: Array) -> Array:
    """Placement ``(7,)`` of what is told of a frame, at a configuration of the robot ``(nq,)``."""
    here = placed(robot, tool.frame, pose)
    turn = here.rotation @ offset_of(robot, tool, pose) if any(tool.rows[3:]) else np.eye(3)
    return np.concatenate([here.translation, pin.Quaternion(turn).coeffs()])


def refuse_tilted(robot: ClosedRobot, tool: Tool, pose: Array, q: Array) -> None:
    """Refuse a motion in which a frame turns otherwise than by the one angle that is told.

    Args:
        robot: The robot.
        tool: The frame.
        pose: Configuration that says how the frame is turned, shape ``(nq,)``.
        q: Configurations of the motion, shape ``(n, nq)``.
    """
    rows: Mask = tool.rows
    if sum(rows[3:]) != 1:
        return
    axis = rows[3:].index(True)
    offset = offset_of(robot, tool, pose)
    for configuration in q[:: max(1, len(q) // 64)]:
        turn = placed(robot, tool.frame, configuration).rotation @ offset
        lean = float(np.linalg.norm(np.cross(turn[:, axis], np.eye(3)[axis])))
        if lean > (_ALIGNED if tool.kept is None else TOLERANCES.kept_turn):
            raise SingularPose(
                f"frame {tool.frame!r} leans by {np.degrees(lean):.3g}° where only its "
                f"{COORDINATES[3 + axis]} is told",
                remedy="Tell roll, pitch and yaw",
            )


def _matrix(quaternion: Sequence[float]) -> Array:
    """The rotation of a quaternion x, y, z, w of nearly unit length."""
    x, y, z, w = quaternion
    return np.asarray(pin.Quaternion(w, x, y, z).normalized().matrix())
