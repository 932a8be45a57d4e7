"""Scout's dynamics against RNEA and MuJoCo of the same samples, and DAQP where both feet stand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import daqp
import numpy as np
import pinocchio as pin
from machine import installed
from measuring import Equal, Goal, Peer, Row, Scale
from peers.common import RNEA, rnea

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.numeric.trajectory import JointTrajectory

EXAMPLES = Path(__file__).parents[2] / "examples"
FORCES = "RNEA's forces from torques and soles' wrenches [N, N·m]"


def rows(scale: Scale) -> Iterator[Row]:
    """Every row, once its data are made."""
    robot, gait = scout_pin.load(), scout_pin.load_gait("thesis")
    for count in dict.fromkeys((scale.sizes[1], scale.many)):
        t = gait.sample_times(count)
        motion = gait.sample(t)
        joints = joint_trajectory(robot, motion)
        state = free_flyer_state(motion.torso, joints)
        number, forces = len(t), rnea(robot.model, state)
        contact = partial(inverse_dynamics, robot, motion, joints)
        equal = _explained(robot, motion, joints, scale)
        peer = Peer(RNEA, number, forces)
        goals = [(Goal(most),) if count == scale.many else () for most in (1.15, 1.6, 1.75)]
        yield Row("contact inverse dynamics", number, contact, peer, equal, goals[0])
        if count == scale.many:
            yield _beside_mujoco(robot, state, contact, forces())
        whole = partial(inverse_dynamics, robot, motion)
        yield Row("feet and torso to torques", number, whole, peer, equal, goals[1])
        stream = partial(_stream, robot, gait, t)
        yield Row("gait's curves to torques", number, stream, peer, equal, goals[2])
    yield _double_support(robot, scale)
    yield _one_sample(robot, gait)


def _stream(robot: scout_pin.Scout, gait: scout_pin.Gait, t: np.ndarray) -> None:
    for _ in scout_pin.torque_blocks(robot, gait, t):
        pass


def _explained(
    robot: scout_pin.Scout, motion: GaitMotion, joints: JointTrajectory, scale: Scale
) -> Equal:
    """Torques and soles' wrenches, by Pinocchio's Jacobians, must give RNEA's forces again."""
    few = slice(None, None, max(1, len(motion.t) // scale.few))

    def difference() -> float:
        some, bent = motion.part(few), joints.part(few)
        found = inverse_dynamics(robot, some, bent)
        return unexplained(robot, free_flyer_state(some.torso, bent), found.torque, found.wrench)

    return Equal(FORCES, difference, 1e-9)


def unexplained(
    robot: scout_pin.Scout,
    state: Sequence[np.ndarray],
    torque: np.ndarray,
    wrench: np.ndarray,
) -> float:
    """What RNEA's forces differ from those of torques ``(n, 12)`` and soles' wrenches.

    The wrenches ``(n, 2, 6)`` are in world axes, about the soles' origins.
    """
    model, data, worst = robot.model, robot.model.createData(), 0.0
    axes = pin.LOCAL_WORLD_ALIGNED
    for k, (q, v, a) in enumerate(zip(*state, strict=True)):
        total = np.concatenate([np.zeros(6), torque[k]])
        for foot, side in enumerate(("left", "right")):
            frame = robot.sole_frames[side]
            jacobian = pin.computeFrameJacobian(model, data, q, frame, axes)
            total += jacobian.T @ wrench[k, foot]
        worst = max(worst, float(np.abs(total - pin.rnea(model, data, q, v, a)).max()))
    return worst


def _beside_mujoco(
    robot: scout_pin.Scout, state: tuple[np.ndarray, ...], ours: partial, forces: np.ndarray
) -> Row:
    name = "mj_inverse of the same tree"
    if not installed("mujoco"):
        return Row("contact inverse dynamics", len(state[0]), ours, Peer(name, 1, None))
    from peers.mujoco_trees import mujoco_biped

    other = mujoco_biped(robot.urdf, state)

    def difference() -> float:
        return float(np.abs(other.work()[:, 6:] - forces.T[:, 6:]).max())

    equal = Equal("forces of the tree's joints [N·m]", difference, 1e-9)
    peer = Peer(name, len(state[0]), other.work)
    return Row("contact inverse dynamics", len(state[0]), ours, peer, equal)


def _one_sample(robot: scout_pin.Scout, gait: scout_pin.Gait) -> Row:
    motion = gait.sample(np.array([3.0]))
    joints = joint_trajectory(robot, motion)
    state = free_flyer_state(motion.torso, joints)
    q, v, a = (part[0] for part in state)

    def ours() -> ContactDynamics:
        return inverse_dynamics(robot, motion, joint_trajectory(robot, motion))

    def difference() -> float:
        found = ours()
        return unexplained(robot, state, found.torque, found.wrench)

    return Row(
        "one sample: joint_trajectory, inverse_dynamics",
        1,
        ours,
        Peer("pin.rnea, one call", 1, partial(pin.rnea, robot.model, robot.data, q, v, a)),
        Equal(FORCES, difference, 1e-9),
        (Goal(0.3, "ms"),),
    )


# -- both feet on the floor -----------------------------------------------------------


def _double_support(robot: scout_pin.Scout, scale: Scale) -> Row:
    """A walk so fast that the least torques would take a sole beyond its cone at most samples."""
    gait = load_gait(EXAMPLES / "walk.toml")
    t = np.linspace(gait.start, gait.end, 6 * scale.many)
    t = t[gait.sample(t).support.all(axis=1)][: scale.many]
    motion = gait.sample(t, 0.2 * gait.time_unit)
    joints = joint_trajectory(robot, motion)
    state = free_flyer_state(motion.torso, joints)
    few = np.linspace(0, len(t) - 1, scale.few).astype(int)
    programmes = [_Wrenches(robot, motion, k, *(x[k] for x in state)) for k in few]

    def theirs() -> list[np.ndarray]:
        return [one.torques() for one in programmes]

    def difference() -> float:
        found = inverse_dynamics(robot, motion, joints)
        return float(np.abs(found.torque[few] - theirs()).max())

    return Row(
        "both feet on the floor, limits in the way",
        len(t),
        partial(inverse_dynamics, robot, motion, joints),
        Peer("DAQP, a call a sample, 12 variables", len(few), theirs),
        Equal("torques [N·m]", difference, 1e-6),
        (Goal(12.0, "µs"),),
    )


class _Wrenches:
    """One sample's quadratic programme as one would write it down: twelve components.

    Both soles' wrenches in world axes, each in its cone, together what the floor must supply.
    """

    def __init__(
        self,
        robot: scout_pin.Scout,
        motion: GaitMotion,
        sample: int,
        q: np.ndarray,
        v: np.ndarray,
        a: np.ndarray,
    ) -> None:
        model, data = robot.model, robot.model.createData()
        forces = pin.rnea(model, data, q, v, a).copy()
        jacobians, cones = [], []
        feet = (motion.left_foot, motion.right_foot)
        for side, foot, contact in zip(("left", "right"), feet, robot.contacts, strict=True):
            frame, axes = robot.sole_frames[side], pin.LOCAL_WORLD_ALIGNED
            jacobians.append(pin.computeFrameJacobian(model, data, q, frame, axes))
            scales = np.repeat([contact.length, 1.0], 3)[:, None]
            cones.append(contact.facets @ (scales * np.kron(np.eye(2), foot.rotation[sample].T)))
        both, zero = np.concatenate(jacobians).T, np.zeros(cones[0].shape)
        self.joints, self.target = both[6:], forces[6:]
        self.weights = self.joints.T @ self.joints
        self.linear = -self.joints.T @ self.target
        limits = [np.concatenate([cones[0], zero]), np.concatenate([zero, cones[1]])]
        self.rows = np.concatenate([np.concatenate(limits, axis=1), both[:6]])
        count = len(self.rows) - 6
        self.upper = np.concatenate([np.zeros(count), forces[:6]])
        self.lower = np.concatenate([np.full(count, -1e30), forces[:6]])
        self.sense = np.array([0] * count + [5] * 6, dtype=np.int32)  # 5: an equality

    def torques(self) -> np.ndarray:
        """The joints' torques [N·m], ``(12,)``."""
        solution, _, flag, _ = daqp.solve(
            self.weights, self.linear, self.rows, self.upper, self.lower, self.sense.copy()
        )
        if flag <= 0:
            raise ArithmeticError(f"DAQP gives up with {flag}")
        return np.asarray(self.target - self.joints @ solution)
