"""Motion of all joints of a closed robot from that of some, starting at a pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.errors import BadInput, SingularPose, TrajectoryError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import is_free, singles
from thesis_pin.loops.kinematics import close, follow
from thesis_pin.loops.motion.files import JointMotion
from thesis_pin.loops.motion.sampled import with_derivatives
from thesis_pin.model.supplement import Motor
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.trajectory import JointTrajectory

Array = NDArray[np.float64]

STRIDE = 0.1
"""Longest step of a joint [rad], [m] on the way from the pose to the first sample."""

JUMP = 0.2
"""Share of a passive joint's largest rate by which it may jump between two samples."""


@dataclass(frozen=True, eq=False)
class WholeMotion:
    """What all joints do.

    Attributes:
        joints: Positions, rates and accelerations in Pinocchio's coordinates.
        driving: Joints whose motion determines the others'.
        still: Those of them that no column moves: they stay at the pose.
    """

    joints: JointTrajectory
    driving: tuple[str, ...]
    still: tuple[str, ...]


def whole_motion(robot: ClosedRobot, motion: JointMotion, pose: ArrayLike) -> WholeMotion:
    """What every joint does while some move as they are told.

    Where only motors are told, the other motors stay at the pose; where joints are told
    that aren't motors, they alone determine the motion.

    Args:
        robot: The robot.
        motion: How some of its joints move.
        pose: Closed configuration from which the joints go to the first sample, which
            picks the assembly, shape ``(nq,)``.

    Raises:
        Unreachable: A sample can't be closed.
        SingularPose: The given joints don't determine the others, at a sample or between two.
        TrajectoryError: The base is told to move, and the robot is tied to the world.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    instance("motion", motion, JointMotion, "read_motion()")
    start = vector("pose", pose, robot.model.nq)
    motors = robot.actuators or tuple(singles(robot.model))
    alone = not set(motion.joints) <= set(motors)
    still = () if alone else tuple(name for name in motors if name not in motion.joints)
    driving = (*motion.joints, *still)
    view = driven_by(robot, driving)
    resting = positions_of(view, start)[len(motion.joints) :]
    count = len(motion.time)
    position = np.column_stack([motion.position, np.tile(resting, (count, 1))])
    rate, acceleration = (
        np.column_stack([values, np.zeros((count, len(still)))])
        for values in (motion.rate, motion.acceleration)
    )
    guess = _approach(view, start, position[0])
    found = follow(view, motion.time, position, rate, acceleration, guess)
    _refuse_jump(view, found)
    if motion.base is not None:
        found = _carried(robot, found, motion.base)
    return WholeMotion(found, driving, still)


def driven_by(robot: ClosedRobot, joints: Sequence[str]) -> ClosedRobot:
    """The same robot with other joints for motors."""
    supplement = replace(robot.supplement, motors=tuple(Motor(name, joint=name) for name in joints))
    root = pin.JointModelFreeFlyer() if is_free(robot.model) else None
    return ClosedRobot(replace(robot.description, supplement=supplement), root_joint=root)


def positions_of(robot: ClosedRobot, q: ArrayLike) -> Array:
    """Positions of a robot's motors in a configuration ``(..., nq)``, shape ``(..., motors)``.

    A continuous joint's, whose coordinates are a cosine and a sine, is its angle.
    """
    known, q = singles(robot.model), np.asarray(q, dtype=float)
    columns = [known[name].position(q) for name in robot.actuators]
    return np.stack(columns, axis=-1) if columns else np.empty((*q.shape[:-1], 0))


def _approach(robot: ClosedRobot, pose: Array, first: Array) -> Array:
    """A closed configuration at the first sample, reached in small steps from the pose."""
    start = positions_of(robot, pose)
    way = first - start
    steps = int(np.ceil(np.abs(way).max(initial=0.0) / STRIDE))
    q = pose
    for share in np.arange(1, steps + 1) / max(steps, 1):
        q = close(robot, q, start + share * way)
    return q


def _refuse_jump(robot: ClosedRobot, found: JointTrajectory) -> None:
    """Refuse a motion in which passive joints turn back where the driving ones don't.

    Where the driving joints lose control two assemblies meet; samples step over that pose,
    and the joints go on in either. Their rates then jump by more than accelerations explain.
    """
    step = np.diff(found.time)[:, None]
    jump = np.abs(np.diff(found.v, axis=0) - step * (found.a[1:] + found.a[:-1]) / 2)
    size = np.abs(found.v).max(axis=0, initial=0.0)
    share = jump / np.where(size > 0, size, 1.0)
    driving = share[:, robot.actuated].max(axis=1, initial=0.0)
    passive = share[:, robot.passive].max(axis=1, initial=0.0)
    bad = (passive > JUMP) & (driving < JUMP / 2)
    if bad.any():
        k = int(np.argmax(bad))
        name = _name_at(robot, int(robot.passive[share[k, robot.passive].argmax()]))
        raise SingularPose(
            f"the rate of {name!r} jumps by {passive[k]:.0%} of its largest: there "
            f"{', '.join(robot.actuators)} don't determine the other joints",
            where=f"between t = {found.time[k]:.6g} and {found.time[k + 1]:.6g} s",
            remedy="Give the motors' motion, sample more finely, or keep away from that pose",
        )


def _name_at(robot: ClosedRobot, place: int) -> str:
    """The joint that a place in a velocity belongs to."""
    for name, joint in zip(list(robot.model.names)[1:], list(robot.model.joints)[1:], strict=True):
        if joint.idx_v <= place < joint.idx_v + joint.nv:
            return str(name)
    return ""


def _carried(robot: ClosedRobot, found: JointTrajectory, base: Array) -> JointTrajectory:
    """The same motion on a moving root; loops among the bodies don't notice it."""
    from scipy.spatial.transform import Rotation, RotationSpline

    model = robot.model
    for loop in robot.loops:
        if any(model.frames[k].parentJoint == 0 for k in loop.ids):
            raise TrajectoryError(
                f"the base moves, and loop {loop.name!r} ties the robot to the world",
                remedy="Leave the base's columns out",
            )
    if len(found.time) < 4:
        raise BadInput(f"{len(found.time)} samples of the base", allowed="at least 4")
    time = found.time
    turns = Rotation.from_quat(base[:, 3:])
    spline, course = RotationSpline(time, turns), _course(time, base[:, :3])
    omega, alpha = spline(time, 1), spline(time, 2)
    linear = turns.apply(course[1], inverse=True)
    q, v, a = found.q.copy(), found.v.copy(), found.a.copy()
    q[:, :3], q[:, 3:7] = base[:, :3], turns.as_quat()
    v[:, :3], v[:, 3:6] = linear, omega
    # Pinocchio's acceleration is the derivative of the velocity's body components.
    a[:, :3] = turns.apply(course[2], inverse=True) - np.cross(omega, linear)
    a[:, 3:6] = alpha
    return JointTrajectory(time, q, v, a)


def _course(time: Array, place: Array) -> tuple[Array, Array, Array]:
    made = [with_derivatives(time, column, None, None) for column in place.T]
    return place, np.column_stack([v for v, _ in made]), np.column_stack([a for _, a in made])
