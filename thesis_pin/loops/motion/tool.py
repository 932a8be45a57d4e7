"""A frame that leads a robot: the robot seen from the frame, on a base that is told to move.

What the frame is told stands still, and the robot's root flies as the inverse of it; a loop
between the two holds the told coordinates. So the joints that follow are the passive ones of
a robot with loops, closed, ranked and refused as all others are.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, SingularPose, Unreachable
from thesis_pin.loops.closures import ClosedRobot, Loop
from thesis_pin.loops.configurations.chaining import place
from thesis_pin.loops.configurations.closing import close_stack, motor_positions
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.told import COORDINATES, Tool
from thesis_pin.loops.system.rows import Mask
from thesis_pin.model.loading import frame_id
from thesis_pin.model.mechanism.closure_types import word_of
from thesis_pin.numeric import quaternions

Array = NDArray[np.float64]

STRIDE = 0.1
"""Longest step from a pose to the first sample [rad], or relative to the robot's size."""

_ALIGNED = 1e-6  # turns of a frame that counts as aligned with an axis [rad]
_STEPS = 60  # Newton steps at most


def tool_view(robot: ClosedRobot, tool: Tool, joints: Sequence[str], pose: Array) -> ClosedRobot:
    """The robot seen from a frame: its base is led by the frame's inverse motion.

    Args:
        robot: The robot, its root fixed.
        tool: The frame, and what of it is told.
        joints: Joints that are told beside it.
        pose: A closed configuration, which says how the frame is turned where that isn't told,
            shape ``(nq,)``.

    Returns:
        Its configurations are those of the robot behind the base's seven coordinates. Behind the
        joints that are told, its motors are those of the robot that don't move the frame, as
        fingers or other legs: they stay where they are.

    Raises:
        BadInput: The root flies freely, or what is told doesn't belong together.
        UnknownName: There is no such frame.
    """
    if len(robot.base):
        raise BadInput(
            f"frame {tool.frame!r} can't lead a robot whose root flies freely",
            remedy="Tell the base and the joints, or fix the root",
        )
    base = pin.Model()
    root = base.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "root_joint")
    end = base.addJointFrame(root)
    model = pin.appendModel(base, robot.model, end, pin.SE3.Identity())
    model.name = robot.model.name
    names = [f"{tool.frame} as told", tool.frame]
    frame = model.frames[frame_id(model, tool.frame)]
    offset = pin.SE3(frame.placement)
    offset.rotation = offset.rotation @ _offset(robot, tool, pose)
    seat = model.addFrame(
        pin.Frame(f"{tool.frame} of a loop", frame.parentJoint, offset, pin.FrameType.OP_FRAME)
    )
    loops = [_moved(loop, robot, model) for loop in robot.loops]
    if not any(tool.rows):
        raise BadInput(f"nothing of frame {tool.frame!r} is told", allowed=", ".join(COORDINATES))
    kind = word_of(tool.rows)
    loops.append(Loop(tool.frame, kind, (names[0], names[1]), (0, seat), tool.rows))
    view = robot.led(model, joints, loops)
    return robot.led(model, (*joints, *_others(robot, view)), loops)


def _others(robot: ClosedRobot, view: ClosedRobot) -> list[str]:
    """Motors that no equation ties to the frame, the last of a view's loops."""
    row = view.system.rows[-1].start
    parts = (columns for rows, columns in view.system.parts().each if row in rows)
    tied = {int(column) for columns in parts for column in columns}
    places = {name: one.v for name, one in singles(view.model).items()}
    motors = robot.actuators or tuple(singles(robot.model))
    return [name for name in motors if places[name] not in tied and name not in view.actuators]


def _moved(loop: Loop, robot: ClosedRobot, model: pin.Model) -> Loop:
    """A loop with its frames found again in another model; what was the world is the root."""
    root = model.getFrameId("root_joint")
    first, second = (
        root if k == 0 else model.getFrameId(robot.model.frames[k].name, robot.model.frames[k].type)
        for k in loop.ids
    )
    return Loop(loop.name, loop.kind, loop.frames, (first, second), loop.rows, loop.length)


def _offset(robot: ClosedRobot, tool: Tool, pose: Array) -> Array:
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
    turn = placed(robot, tool.frame, pose).rotation
    angles = pin.rpy.matrixToRpy(turn)
    if axis == 1 and np.abs(np.abs(angles[[0, 2]]) - np.pi).max() < _ALIGNED:
        angles = np.array([0.0, np.pi - angles[1], 0.0])  # the same orientation
    if (axis == 1 and abs(np.sin(angles[2])) > _ALIGNED) or (
        axis == 0 and max(abs(np.sin(angles[1])), abs(np.sin(angles[2]))) > _ALIGNED
    ):
        raise BadInput(f"{what} doesn't turn about an axis of the world here", remedy=every)
    alone = np.zeros(3)
    alone[axis] = angles[axis]
    return np.asarray(turn.T @ pin.rpy.rpyToMatrix(alone))


def placed(robot: ClosedRobot, frame: str, q: Array) -> pin.SE3:
    """Where a frame of a robot is at a configuration ``(nq,)``."""
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q)
    return pin.SE3(pin.updateFramePlacement(robot.model, data, frame_id(robot.model, frame)))


def lifted(view: ClosedRobot, q: Array) -> Array:
    """Configurations ``(n, nq)`` behind a base that doesn't move, where a view has one beside."""
    more = view.model.nq - q.shape[1]
    if not more:
        return q
    still = np.tile(pin.neutral(view.model)[:more], (len(q), 1))
    return np.column_stack([still, q])


def inverted(tool: Tool, value: Array, first: Array, second: Array) -> tuple[Array, Array, Array]:
    """What the base does where a frame's place and quaternion move in a known way.

    Args:
        tool: What of the frame is told; where no turn is, the base doesn't turn.
        value: Places and quaternions x, y, z, w, nearly of unit length, shape ``(n, 7)``.
        first: Their first derivatives, same shape.
        second: Their second derivatives, same shape.

    Returns:
        Poses ``(n, 7)`` of the base in the frame, its rates and accelerations ``(n, 6)`` in its
        own axes, as Pinocchio counts them: the frame's twist at the base's origin, reversed.
    """
    if not any(tool.rows[3:]):
        value, first, second = (np.pad(x[:, :3], ((0, 0), (0, 4))) for x in (value, first, second))
        value[:, 6] = 1.0
    turn, omega, alpha = quaternions.motion(value[:, 3:], first[:, 3:], second[:, 3:])
    point, speed, push = value[:, :3], first[:, :3], second[:, :3]
    back = -np.einsum("nji,nj->ni", turn, point)
    size = np.linalg.norm(value[:, 3:], axis=1, keepdims=True)
    poses = np.column_stack([back, value[:, 3:] * [-1.0, -1.0, -1.0, 1.0] / size])
    linear = speed - np.cross(omega, point)
    pushed = push - np.cross(alpha, point) - np.cross(omega, speed)
    return poses, -np.column_stack([linear, omega]), -np.column_stack([pushed, alpha])


def approach(
    robot: ClosedRobot,
    view: ClosedRobot,
    tool: Tool,
    pose: Array,
    first: tuple[Array, Array],
    precision: float | None,
) -> Array:
    """A closed configuration of the view at a first sample, reached in small steps from a pose.

    Args:
        robot: The robot.
        view: It seen from the frame.
        tool: The frame.
        pose: Closed configuration of the robot, shape ``(nq,)``.
        first: Placement of the frame ``(7,)`` and positions of the joints told beside it.
        precision: What counts as dependent.

    Raises:
        Unreachable: A place on the straight way can't be reached.
        SingularPose: The frame doesn't determine the joints that motors drive.
    """
    told, data = np.array(tool.rows), view.model.createData()
    q = lifted(view, pose[None])
    there = pose_told(robot, tool, pose)
    shift = np.where(told[:3], first[0][:3] - there[:3], 0.0)
    start = motor_positions(view, q[0])
    way = np.zeros(len(start))
    way[: len(first[1])] = first[1] - start[: len(first[1])]
    turn = pin.log3(_rotation(first[0]) @ _rotation(there).T) if told[3:].any() else np.zeros(3)
    far = max(
        float(np.abs(shift).max()) / view.scale.length,
        float(np.linalg.norm(turn)),
        float(np.abs(way / view.scale.columns[view.actuated]).max(initial=0.0)),
    )
    steps = max(int(np.ceil(far / STRIDE)), 1)
    for share in np.arange(0, steps + 1) / steps:
        at = np.zeros((1, 7))
        at[0, :3] = np.where(told[:3], there[:3] + share * shift, 0.0)
        at[0, 3:] = pin.Quaternion(pin.exp3(share * turn) @ _rotation(there)).coeffs()
        still = np.zeros((1, 7))
        base = inverted(tool, at, still, still)[0]
        guess = place(view, q, (start + share * way)[None], base)
        found, reasons = close_stack(view, data, guess, view.passive, _STEPS, precision)
        if reasons[0]:
            raise Unreachable(
                reasons[0],
                where=f"{share:.0%} of the way from the pose to the first sample",
                remedy="Start from a pose beside the first sample",
            )
        q = found.q
        if not share:
            refuse_redundant(robot, view, q[0], precision)
    return np.asarray(q[0])


def pose_told(robot: ClosedRobot, tool: Tool, pose: Array) -> Array:
    """Placement ``(7,)`` of what is told of a frame, at a configuration of the robot ``(nq,)``."""
    here = placed(robot, tool.frame, pose)
    turn = here.rotation @ _offset(robot, tool, pose) if any(tool.rows[3:]) else np.eye(3)
    return np.concatenate([here.translation, pin.Quaternion(turn).coeffs()])


def _rotation(placement: Array) -> Array:
    return np.asarray(pin.Quaternion(*placement[[6, 3, 4, 5]]).normalized().matrix())


def refuse_redundant(
    robot: ClosedRobot, view: ClosedRobot, q: Array, precision: float | None
) -> None:
    """Refuse a frame that may rest while motors move; harmless idle rods are none."""
    motors = set(robot.actuators or singles(robot.model))
    for group in surveyed(view, q, precision).idle:
        if motors & set(group.joints):
            raise SingularPose(
                f"{view.leader} don't determine the other joints: {', '.join(group.joints[:6])} "
                "move while they stand still",
                remedy="Tell more coordinates of the frame, or add columns of some joints",
            )


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
    offset = _offset(robot, tool, pose)
    for configuration in q[:: max(1, len(q) // 64)]:
        turn = placed(robot, tool.frame, configuration).rotation @ offset
        lean = float(np.linalg.norm(np.cross(turn[:, axis], np.eye(3)[axis])))
        if lean > _ALIGNED:
            raise SingularPose(
                f"frame {tool.frame!r} leans by {np.degrees(lean):.3g}° where only its "
                f"{COORDINATES[3 + axis]} is told",
                remedy="Tell roll, pitch and yaw",
            )
