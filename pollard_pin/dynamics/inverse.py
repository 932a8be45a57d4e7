"""Inverse dynamics of the closed mechanism: six torques and both ball-joint forces.

The general method is in :mod:`thesis_pin.loops.dynamics`. Here the loops are
opened by hand: a rod's two passive joints carry no torque, so what RNEA asks of
them fixes the ball joint's force up to a part along the rod; the two elbow
joints carry none either, and give the two parts along the rods. One 2×2 system
a sample, and no Jacobian.

Source: Pollard thesis, 3.1 (3.1–3.4), 3.9 (3.150–3.154). The thesis inverts its
3×6 matrix J_τ in (3.154), which has no inverse: see :mod:`pollard_pin.dynamics.three_motors`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from pollard_pin.dynamics.forces import loads
from pollard_pin.dynamics.loops import refuse_open_loops
from pollard_pin.kinematics.linkage import Linkage
from pollard_pin.kinematics.screws import Posture
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.trajectory import SolvedTrajectory, joint_trajectory
from thesis_pin.display.brief import Brief
from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array, together
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import FLOATS, LONG, blocks, components, pieces, put
from thesis_pin.numeric.trajectory import JointTrajectory


@dataclass(frozen=True)
class PollardDynamics(Brief):
    """Torques and reactions of a motion.

    Attributes:
        torque: Of the six motors [N·m], shape ``(..., 6)``, order θ21, θ211, θ212,
            θ1615, θ1716, θ1817.
        loop_force: On the forearm at each ball joint, world axes [N], ``(..., 2, 3)``;
            the rod feels the opposite.
        joint_force: RNEA's torques of the open tree [N·m], shape ``(..., 12)``.
    """

    torque: np.ndarray
    loop_force: np.ndarray
    joint_force: np.ndarray


class LongDynamics(PollardDynamics):
    """Of very many samples: RNEA's torques are worked out when asked for."""

    def __init__(
        self, torque: np.ndarray, loop_force: np.ndarray, robot: Pollard, joints: JointTrajectory
    ) -> None:
        values = {"torque": torque, "loop_force": loop_force, "_robot": robot, "_joints": joints}
        for name, value in values.items():
            object.__setattr__(self, name, value)

    _robot: Pollard
    _joints: JointTrajectory

    @property
    def joint_force(self) -> np.ndarray:
        """RNEA's torques of the open tree [N·m], shape ``(n, 12)``."""
        found = np.empty(self._joints.q.shape)
        for part in blocks(len(found)):
            some = self._joints.part(part)
            _tree_torques(self._robot, some.q, some.v, some.a, found[part])
        return found


def tree_torques(robot: Pollard, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> np.ndarray:
    """RNEA of the open tree over a stack [N·m].

    Args:
        robot: The robot.
        q: Joint angles [rad], shape ``(n, 12)``.
        v: Their rates [rad/s], same shape.
        a: Their accelerations [rad/s²], same shape.

    Returns:
        Torques of all twelve joints, shape ``(n, 12)``.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    stack = {name: finite_array(name, x, None, 12) for name, x in (("q", q), ("v", v), ("a", a))}
    q, v, a = map(np.ascontiguousarray, together(**stack))
    tau = np.empty(q.shape)
    if len(tau):
        _tree_torques(robot, q, v, a, tau)
    return tau


def _tree_torques(
    robot: Pollard, q: np.ndarray, v: np.ndarray, a: np.ndarray, out: np.ndarray
) -> None:
    """RNEA of contiguous stacks ``(n, 12)``, which Pinocchio reads as columns without a copy."""
    pin.rneaInParallel(1, robot.pool, q.T, v.T, a.T, out.T)


def inverse_dynamics(
    robot: Pollard, motion: ToolMotion, joints: JointTrajectory | None = None
) -> PollardDynamics:
    """Six torques and both ball-joint forces of a motion.

    Args:
        robot: The robot.
        motion: The sampled path.
        joints: Its joint trajectory; None computes it, on the default branch.

    Raises:
        BadInput: The joints aren't this motion's, or open a ball joint.
        SingularPose: The forces aren't determined.
        Unreachable: See :func:`pollard_pin.joint_trajectory`.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    instance("motion", motion, ToolMotion, "ToolPath.sample()")
    if joints is None:
        joints = joint_trajectory(robot, motion)
    instance("joints", joints, JointTrajectory, "joint_trajectory()")
    if np.shape(joints.q) != (len(motion.time), 12):
        raise WrongShape("joints.q", np.shape(joints.q), f"({len(motion.time)}, 12), as motion")
    if not isinstance(joints, SolvedTrajectory):
        return inverse_dynamics_at(robot, joints.q, joints.v, joints.a)
    # What joint_trajectory has solved is closed; whole turns of its angles change nothing.
    count, solved = len(joints.q), joints.solutions.angles
    if count < LONG:
        found = _empty(count)
        _fill(robot, solved, (joints.q, joints.v, joints.a), found)
        return found
    long = LongDynamics(np.empty((count, 6)), np.empty((count, 2, 3)), robot, joints)
    for part in blocks(count):
        some, tau = joints.part(part), np.empty((part.stop - part.start, 12))
        here = PollardDynamics(long.torque[part], long.loop_force[part], tau)
        _fill(robot, solved[part], (some.q, some.v, some.a), here, part.start)
    return long


def inverse_dynamics_at(
    robot: Pollard,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    posture: Posture | None = None,
) -> PollardDynamics:
    """:func:`inverse_dynamics` of joint angles, rates and accelerations ``(..., 12)``.

    Args:
        robot: The robot.
        q: Closed configurations [rad], shape ``(..., 12)``.
        v: Their rates [rad/s], same shape.
        a: Their accelerations [rad/s²], same shape.
        posture: That of q, for motions of ``Pollard.joint_motion``: with it, q, v and a
            are taken to keep the loops closed.

    Raises:
        BadInput: q, v or a opens a ball joint.
        SingularPose: The forces aren't determined.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    stack = {name: finite_array(name, x, 12) for name, x in (("q", q), ("v", v), ("a", a))}
    state = tuple(map(np.ascontiguousarray, together(**stack)))
    shape = state[0].shape[:-1]
    if posture is not None:
        instance("posture", posture, Posture, "Pollard.posture()")
        if posture.shape != shape:
            raise WrongShape("q", state[0].shape, f"{(*posture.shape, 12)}, as posture")
    q, v, a = (one.reshape(-1, 12) for one in state)
    found = _empty(len(q))
    angles = q if posture is None else posture.angles.T
    _fill(robot, angles, (q, v, a), found, check=posture is None)
    return PollardDynamics(
        found.torque.reshape(*shape, 6),
        found.loop_force.reshape(*shape, 2, 3),
        found.joint_force.reshape(*shape, 12),
    )


def _empty(count: int) -> PollardDynamics:
    return PollardDynamics(np.empty((count, 6)), np.empty((count, 2, 3)), np.empty((count, 12)))


def _fill(
    robot: Pollard,
    angles: np.ndarray,
    state: tuple[np.ndarray, np.ndarray, np.ndarray],
    found: PollardDynamics,
    first: int = 0,
    *,
    check: bool = False,
) -> None:
    """Torques and forces of contiguous stacks ``(n, 12)``, a few by floats, many in blocks.

    Args:
        robot: The robot.
        angles: Those of the postures [rad], which may differ from q by whole turns.
        state: Angles, rates, accelerations.
        found: Where to write.
        first: Number of the first sample, for messages.
        check: Whether to refuse what opens a ball joint.
    """
    geometry, torque, force = robot.geometry, found.torque, found.loop_force.reshape(-1, 6)
    (q, v, a), every = state, pieces(len(angles))
    if every and every[0][0] is FLOATS:
        _tree_torques(robot, q, v, a, found.joint_force)
    for xp, start, part in every:
        if xp is not FLOATS:  # what stays in the cache is read again at once
            _tree_torques(robot, q[part], v[part], a[part], found.joint_force[part])
        known = Linkage.of(geometry, components(angles, part), xp)
        if check:
            rates, second = components(v, part), components(a, part)
            refuse_open_loops(xp, geometry, known, rates, second, first + start)
        here = loads(xp, geometry, known, components(found.joint_force, part), first + start)
        put(torque, part, here.torque)
        put(force, part, [*here.loop_force[0], *here.loop_force[1]])
