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

from pollard_pin.dynamics.loops import refuse_open_loops
from pollard_pin.kinematics.screws import Posture
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.trajectory import SolvedTrajectory, joint_trajectory
from pollard_pin.specification import ACTUATORS
from thesis_pin.errors import SingularPose, WrongShape
from thesis_pin.numeric.arrays import finite_array, together
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import LONG, blocks
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.numeric.vectors import Vector, cross, dot
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class PollardDynamics:
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
            found[part] = _tree_torques(self._robot, some.q, some.v, some.a)
        return found


def loop_forces(posture: Posture, tau: np.ndarray, first: int = 0) -> tuple[Vector, Vector]:
    """Forces on the forearm at the two ball joints that leave every passive joint free.

    Args:
        posture: Closed posture of n samples.
        tau: RNEA's torques of the open tree [N·m], shape ``(12, n)``.
        first: Number of the first sample, for messages.

    Returns:
        Two forces [N], each ``(3, n)``.

    Raises:
        SingularPose: The forces aren't determined at some sample.
    """
    across, units = [], []
    for i in (0, 1):
        k, length = 7 + 3 * i, posture.geometry.x_87[i]
        unit, yaw = posture.rods[i] / length, posture.yaw_axes[i]
        side = cross(yaw, unit)  # where θ76i moves the tip
        lift = dot(cross(posture.pitch_axes[i], unit), yaw)  # how much θ65i moves it along yaw
        if (np.abs(lift) < TOLERANCES.near_singular).any():
            raise SingularPose(
                f"the rod of chain {i + 1} lies along the axis of θ65{i + 1}, which can't hold it"
            )
        # The rod feels −f; its own joints see nothing else from the loop.
        f_side = -tau[k + 1] / length
        f_yaw = (-tau[k] / length - f_side * dot(cross(posture.pitch_axes[i], unit), side)) / lift
        across.append(f_side * side + f_yaw * yaw)
        units.append(unit)
    ey = np.zeros_like(units[0])
    ey[1] = 1.0
    axes = (ey, posture.forearm_axes[2])  # θ43 and θ54
    pull = [[dot(cross(axis, posture.levers[i]), units[i]) for i in (0, 1)] for axis in axes]
    rest = [
        tau[1 + k] - sum(dot(cross(axis, posture.levers[i]), across[i]) for i in (0, 1))
        for k, axis in enumerate(axes)
    ]
    det = pull[0][0] * pull[1][1] - pull[0][1] * pull[1][0]
    size = np.hypot(pull[0][0], pull[1][0]) * np.hypot(pull[0][1], pull[1][1])
    sine = det / np.where(size > 0, size, 1.0)
    if (np.abs(sine) < TOLERANCES.near_singular).any():
        sample = int(np.argmax(np.abs(sine) < TOLERANCES.near_singular))
        raise SingularPose(
            "the two rods pull the forearm in one direction: their forces aren't determined",
            where=f"sample {first + sample}",
        )
    one = (rest[0] * pull[1][1] - pull[0][1] * rest[1]) / det
    two = (pull[0][0] * rest[1] - pull[1][0] * rest[0]) / det
    return across[0] + one * units[0], across[1] + two * units[1]


def motor_torques(posture: Posture, tau: np.ndarray, forces: tuple[Vector, Vector]) -> np.ndarray:
    """Torques of the six motors [N·m], shape ``(6, n)``."""
    torque = tau[list(ACTUATORS)]
    for i in (0, 1):
        # ey × p, seen from the shoulder of chain 0, and ez × p from the arm's axis.
        point, reach = posture.upper_arm + posture.levers[i], posture.side_reach(i)
        fx, fy, fz = forces[i]
        torque[0] -= point[2] * fx - point[0] * fz
        torque[1 + i] += reach[0] * fy - reach[1] * fx
    return torque


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
    return _tree_torques(robot, *together(**stack))


def _tree_torques(robot: Pollard, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    columns = [np.asfortranarray(np.ascontiguousarray(x).T) for x in (q, v, a)]
    # For a single sample Pinocchio drops the second axis.
    return np.asarray(pin.rneaInParallel(1, robot.pool, *columns)).reshape(12, -1).T


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
    # What joint_trajectory has solved is closed, and its posture known.
    count = len(joints.q)
    if count < LONG:
        posture = joints.solutions.posture
        return inverse_dynamics_at(robot, joints.q, joints.v, joints.a, posture)
    found = LongDynamics(np.empty((count, 6)), np.empty((count, 2, 3)), robot, joints)
    for part in blocks(count):
        some, solved = joints.part(part), joints.solutions.angles[part]
        posture = Posture.of(robot.geometry, solved)
        here = _solve(robot, posture, some.q, some.v, some.a, part.start)
        found.torque[part], found.loop_force[part] = here.torque, here.loop_force
    return found


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
    angles, rates, accelerations = map(np.ascontiguousarray, together(**stack))
    shape = angles.shape[:-1]
    if posture is None:
        posture = Posture.of(robot.geometry, angles)
        refuse_open_loops(posture, angles, rates, accelerations)
    else:
        instance("posture", posture, Posture, "Pollard.posture()")
        if posture.shape != shape:
            raise WrongShape("q", angles.shape, f"{(*posture.shape, 12)}, as posture")
    return _solve(robot, posture, angles, rates, accelerations)


def _solve(
    robot: Pollard, posture: Posture, q: np.ndarray, v: np.ndarray, a: np.ndarray, first: int = 0
) -> PollardDynamics:
    shape = q.shape[:-1]
    tau = _tree_torques(robot, *(x.reshape(-1, 12) for x in (q, v, a)))
    rows = np.ascontiguousarray(tau.T)
    one, two = loop_forces(posture, rows, first)
    torque = motor_torques(posture, rows, (one, two))
    return PollardDynamics(
        np.ascontiguousarray(torque.T).reshape(*shape, 6),
        np.ascontiguousarray(np.stack([one, two]).transpose(2, 0, 1)).reshape(*shape, 2, 3),
        tau.reshape(*shape, 12),
    )
