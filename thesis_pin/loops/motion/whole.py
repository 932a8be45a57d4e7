"""Motion of all joints of a closed robot from that of some, starting at a pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.display.counted import counted
from thesis_pin.errors import SingularPose, TrajectoryError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close, motor_positions
from thesis_pin.loops.configurations.following import follow
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.sampled import with_derivatives
from thesis_pin.loops.motion.told import JointMotion, Tool
from thesis_pin.loops.motion.tool import approach, inverted, tool_view
from thesis_pin.loops.motion.turned import refuse_tilted
from thesis_pin.loops.system.idle import joint_names
from thesis_pin.model.mechanism.supplement import Motor
from thesis_pin.numeric import quaternions
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.trajectory import JointTrajectory

Array = NDArray[np.float64]

STRIDE = 0.1
"""Longest step of a joint [rad], [m] on the way from the pose to the first sample."""

JUMP = 0.2
"""Share of a passive joint's largest rate by which it may jump between two samples."""

RESTS = 1e-9
"""Share of the largest rate of all joints below which a joint rests."""


@dataclass(frozen=True, eq=False)
class WholeMotion(Brief):
    """What all joints do.

    Attributes:
        joints: Positions, rates and accelerations in Pinocchio's coordinates.
        driving: Joints whose motion determines the others'.
        still: Those of them that no column moves: they stay at the pose.
        tool: The frame that leads them; None if joints do.
        view: The robot seen from it.
    """

    joints: JointTrajectory
    driving: tuple[str, ...]
    still: tuple[str, ...]
    tool: Tool | None = None
    view: ClosedRobot | None = None


def whole_motion(
    robot: ClosedRobot, motion: JointMotion, pose: ArrayLike, *, precision: float | None = None
) -> WholeMotion:
    """What every joint does while some move as they are told.

    Where only motors are told, the other motors stay at the pose; where joints are told
    that aren't motors, or a frame is, they alone determine the motion.

    Args:
        robot: The robot.
        motion: How some of its joints move.
        pose: Closed configuration from which the joints go to the first sample, which
            picks the assembly, shape ``(nq,)``.
        precision: What counts as dependent; see
            :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Raises:
        Unreachable: A sample can't be closed.
        SingularPose: What is told doesn't determine the other joints, at a sample or between two.
        TrajectoryError: The base is told to move, and the robot is tied to the world.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    instance("motion", motion, JointMotion, "read_motion()")
    start = vector("pose", pose, robot.model.nq)
    if motion.tool is not None:
        return _by_tool(robot, motion, motion.tool, start, precision)
    motors = robot.actuators or tuple(singles(robot.model))
    alone = not set(motion.joints) <= set(motors)
    still = () if alone else tuple(name for name in motors if name not in motion.joints)
    driving = (*motion.joints, *still)
    view = driven_by(robot, driving)
    resting = motor_positions(view, start)[len(motion.joints) :]
    count = len(motion.time)
    position = np.column_stack([motion.position, np.tile(resting, (count, 1))])
    rate, acceleration = (
        np.column_stack([values, np.zeros((count, len(still)))])
        for values in (motion.rate, motion.acceleration)
    )
    base = None
    if motion.base is not None and motion.base_change is not None:
        _refuse_tied_base(robot)
        base = flown(motion.base, *motion.base_change)
    elif motion.base is not None:
        base = base_motion(robot, motion.time, motion.base)
    guess = _approach(view, start, position[0], precision)
    found = follow(
        view,
        motion.time,
        position,
        rate,
        acceleration,
        guess,
        base=base,
        precision=precision,
        where=motion.where,
    )
    _refuse_jump(view, found)
    return WholeMotion(found, driving, still)


def _by_tool(
    robot: ClosedRobot, motion: JointMotion, tool: Tool, pose: Array, precision: float | None
) -> WholeMotion:
    """What every joint does while a frame is led, and maybe some joints beside it."""
    view = tool_view(robot, tool, motion.joints, pose)
    if motion.base is None:
        raise TrajectoryError(f"nothing says how frame {tool.frame!r} moves")
    change = motion.base_change
    course = (motion.base, *change) if change else _splined(motion.time, motion.base)
    base = inverted(tool, *course)
    guess = approach(robot, view, tool, pose, (course[0][0], motion.position[0]), precision)
    still = view.actuators[len(motion.joints) :]
    resting = motor_positions(view, guess)[len(motion.joints) :]
    nothing = np.zeros((len(motion.time), len(still)))
    found = follow(
        view,
        motion.time,
        np.column_stack([motion.position, nothing + resting]),
        np.column_stack([motion.rate, nothing]),
        np.column_stack([motion.acceleration, nothing]),
        guess,
        base=base,
        precision=precision,
        where=motion.where,
    )
    _refuse_jump(view, found)
    nq, nv = robot.model.nq, robot.model.nv
    joints = JointTrajectory(found.time, found.q[:, -nq:], found.v[:, -nv:], found.a[:, -nv:])
    refuse_tilted(robot, tool, pose, joints.q)
    return WholeMotion(joints, view.actuators, still, tool, view)


def driven_by(robot: ClosedRobot, joints: Sequence[str]) -> ClosedRobot:
    """The same robot with other joints for motors."""
    supplement = replace(robot.supplement, motors=tuple(Motor(name, joint=name) for name in joints))
    root = pin.JointModelFreeFlyer() if len(robot.base) else None
    return ClosedRobot(replace(robot.description, supplement=supplement), root_joint=root)


def _approach(robot: ClosedRobot, pose: Array, first: Array, precision: float | None) -> Array:
    """A closed configuration at the first sample, reached in small steps from the pose."""
    start = motor_positions(robot, pose)
    way = first - start
    steps = int(np.ceil(np.abs(way).max(initial=0.0) / STRIDE))
    q = pose
    for share in np.arange(1, steps + 1) / max(steps, 1):
        q = close(robot, q, start + share * way, precision=precision)
    return q


def _refuse_jump(robot: ClosedRobot, found: JointTrajectory) -> None:
    """Refuse a motion in which passive joints turn back where the driving ones don't.

    Where the driving joints lose control two assemblies meet; samples step over that pose,
    and the joints go on in either. Their rates then jump by more than accelerations explain.
    """
    step = np.diff(found.time)[:, None]
    jump = np.abs(np.diff(found.v, axis=0) - step * (found.a[1:] + found.a[:-1]) / 2)
    size = np.abs(found.v).max(axis=0, initial=0.0)
    # Rates of what rests beside the others are rounding, which jumps as it likes.
    size = np.where(size > RESTS * size.max(initial=0.0), size, np.inf)
    share = jump / size
    leading = np.concatenate([robot.actuated, robot.base])
    driving = share[:, leading].max(axis=1, initial=0.0)
    passive = share[:, robot.passive].max(axis=1, initial=0.0)
    bad = (passive > JUMP) & (driving < JUMP / 2)
    if bad.any():
        k = int(np.argmax(bad))
        name = joint_names(robot.model)[robot.passive[share[k, robot.passive].argmax()]]
        raise SingularPose(
            f"the rate of {name!r} jumps by {passive[k]:.0%} of its largest: there "
            f"{', '.join(robot.actuators) or robot.leader} don't determine the other joints",
            where=f"between t = {found.time[k]:.6g} and {found.time[k + 1]:.6g} s",
            remedy="Give the motors' motion, sample more finely, or keep away from that pose",
        )


def base_motion(robot: ClosedRobot, time: Array, base: Array) -> tuple[Array, Array, Array]:
    """Poses, rates and accelerations of a free root through sampled placements.

    Positions and quaternions follow the curves of :func:`with_derivatives`.

    Args:
        robot: The robot.
        time: Sample times [s], shape ``(n,)``.
        base: Positions and quaternions x, y, z, w, shape ``(n, 7)``.

    Returns:
        Poses ``(n, 7)``, rates and accelerations ``(n, 6)`` in the root's own axes, as
        Pinocchio counts them.

    Raises:
        TrajectoryError: A loop ties the robot to the world, or there are too few samples.
    """
    _refuse_tied_base(robot)
    return flown(*_splined(time, base))


def _splined(time: Array, base: Array) -> tuple[Array, Array, Array]:
    """Places and quaternions through samples, and their derivatives, each ``(n, 7)``."""
    if len(time) < 4:
        raise TrajectoryError(
            f"{counted(len(time), 'sample')} of a placement", allowed="at least 4"
        )
    size = np.linalg.norm(base[:, 3:], axis=1, keepdims=True)
    places = np.column_stack([base[:, :3], quaternions.unbroken(base[:, 3:] / size)])
    courses = [with_derivatives(time, column, None, None) for column in places.T]
    rates, pushes = (np.column_stack(columns) for columns in zip(*courses, strict=True))
    return places, rates, pushes


def flown(value: Array, first: Array, second: Array) -> tuple[Array, Array, Array]:
    """What a free root does whose position and quaternion move in a known way.

    Args:
        value: Positions and quaternions x, y, z, w, nearly of unit length, shape ``(n, 7)``.
        first: Their first derivatives, same shape.
        second: Their second derivatives, same shape.

    Returns:
        As :func:`base_motion`.
    """
    size = np.linalg.norm(value[:, 3:], axis=1, keepdims=True)
    places = np.column_stack([value[:, :3], value[:, 3:] / size])
    turn, omega, alpha = quaternions.motion(value[:, 3:], first[:, 3:], second[:, 3:])
    omega, alpha, linear, pushed = (
        np.einsum("nji,nj->ni", turn, x) for x in (omega, alpha, first[:, :3], second[:, :3])
    )
    # Pinocchio's acceleration is the derivative of the velocity's components in moving axes.
    pushed = pushed - np.cross(omega, linear)
    return places, np.column_stack([linear, omega]), np.column_stack([pushed, alpha])


def _refuse_tied_base(robot: ClosedRobot) -> None:
    for loop in robot.loops:
        if any(robot.model.frames[k].parentJoint == 0 for k in loop.ids):
            raise TrajectoryError(
                f"the base moves, and loop {loop.name!r} ties the robot to the world",
                remedy="Leave the base's columns out",
            )
