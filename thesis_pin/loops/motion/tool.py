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
from thesis_pin.loops.motion.turned import offset_of, pose_told, refuse_otherwise
from thesis_pin.model.loading import frame_id
from thesis_pin.model.mechanism.closure_types import word_of
from thesis_pin.numeric import quaternions

Array = NDArray[np.float64]

STRIDE = 0.1
"""Longest step from a pose to the first sample [rad], or relative to the robot's size."""

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
    if tool.kept is not None:
        refuse_otherwise(robot, tool, pose)
    base = pin.Model()
    root = base.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "root_joint")
    end = base.addJointFrame(root)
    model = pin.appendModel(base, robot.model, end, pin.SE3.Identity())
    model.name = robot.model.name
    names = [f"{tool.frame} as told", tool.frame]
    frame = model.frames[frame_id(model, tool.frame)]
    offset = pin.SE3(frame.placement)
    offset.rotation = offset.rotation @ offset_of(robot, tool, pose)
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
                where=f"{share:.2%} of the way from the pose to the first sample",
                remedy="Start from a pose beside the first sample",
            )
        q = found.q
        if not share:
            refuse_redundant(robot, view, q[0], precision)
    return np.asarray(q[0])


def _rotation(placement: Array) -> Array:
    return np.asarray(pin.Quaternion(*placement[[6, 3, 4, 5]]).normalized().matrix())


def refuse_redundant(
    robot: ClosedRobot,
    view: ClosedRobot,
    q: Array,
    precision: float | None,
    remedy: str = "Tell more coordinates of the frame, or add columns of some joints",
) -> None:
    """Refuse a frame that may rest while motors move; harmless idle rods are none."""
    motors = set(robot.actuators or singles(robot.model))
    for group in surveyed(view, q, precision).idle:
        if loose := [name for name in group.joints if name in motors]:
            raise SingularPose(
                f"{view.leader} don't determine the other joints: {', '.join(loose[:6])} "
                "move while they stand still",
                remedy=remedy,
            )
