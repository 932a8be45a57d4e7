"""Pollard's dynamics against RNEA and MuJoCo of the open tree, and the general solver for loops."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
import pinocchio as pin
from machine import installed
from measuring import Equal, Goal, Peer, Row, Scale
from peers.common import RNEA, rnea

import pollard_pin
from pollard_pin.dynamics.inverse import inverse_dynamics, inverse_dynamics_at
from pollard_pin.mjcf import mjcf
from pollard_pin.motion.curves import appendix_b
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.specification import ACTUATORS
from pollard_pin.urdf import anchors
from thesis_pin.loops import dynamics as loop_dynamics

LOOP = "loop inverse dynamics"
State = tuple[np.ndarray, np.ndarray, np.ndarray]


def rows(scale: Scale) -> Iterator[Row]:
    """Every row, once its data are made."""
    robot = pollard_pin.load()
    path = appendix_b(robot.specification)
    for count in dict.fromkeys((scale.sizes[1], scale.many)):
        motion = path.sample(count)
        joints = joint_trajectory(robot, motion)
        state = (joints.q, joints.v, joints.a)
        forces = rnea(robot.model, state)
        few = np.linspace(0, count - 1, scale.few).astype(int)
        equal = _explained(robot, [x[few] for x in state])
        peer = Peer(RNEA, count, forces)
        goals = [(Goal(most),) if count == scale.many else () for most in (1.3, 1.7, 1.9)]
        anywhere = partial(inverse_dynamics_at, robot, *state)
        along = partial(inverse_dynamics, robot, motion, joints)
        yield Row(f"{LOOP}, any q, v, a", count, anywhere, peer, equal, goals[0])
        yield Row(f"{LOOP}, along a path", count, along, peer, equal, goals[0])
        if count == scale.many:
            yield _beside_mujoco(robot, state, along, forces())
            yield _beside_general(robot, state, along)
        whole = partial(inverse_dynamics, robot, motion)
        yield Row("path to torques", count, whole, peer, equal, goals[1])
        stream = partial(_stream, robot, path, motion.time)
        yield Row("path's curve to torques", count, stream, peer, equal, goals[2])
    yield _one_sample(robot, path)


def _stream(robot: pollard_pin.Pollard, path: pollard_pin.ToolPath, time: np.ndarray) -> None:
    for _ in pollard_pin.torque_blocks(robot, path, time):
        pass


def _explained(robot: pollard_pin.Pollard, state: State) -> Equal:
    """Motors' torques and ball joints' forces, by Pinocchio's Jacobians, give RNEA's torques."""

    def difference() -> float:
        found = inverse_dynamics_at(robot, *state)
        return unexplained(robot, state, found.torque, found.loop_force)

    return Equal(
        "RNEA's torques from motors and ball joints [N·m]",
        difference,
        1e-9,
    )


def unexplained(
    robot: pollard_pin.Pollard, state: State, torque: np.ndarray, loop_force: np.ndarray
) -> float:
    """What RNEA's torques differ from those of motors ``(n, 6)`` and ball joints ``(n, 2, 3)``."""
    model, data, worst = robot.model, robot.model.createData(), 0.0
    axes = pin.LOCAL_WORLD_ALIGNED
    frames = [model.getFrameId(f"forearm_anchor_{i}") for i in (1, 2)]
    rods = [model.getFrameId(f"chain{i}_rod_tip") for i in (1, 2)]
    for k, (q, v, a) in enumerate(zip(*state, strict=True)):
        total = np.zeros(12)
        total[list(ACTUATORS)] = torque[k]
        for i in (0, 1):
            pair = (
                pin.computeFrameJacobian(model, data, q, frame, axes)[:3].copy()
                for frame in (frames[i], rods[i])
            )
            forearm, rod = pair
            total += (forearm - rod).T @ loop_force[k, i]
        worst = max(worst, float(np.abs(total - pin.rnea(model, data, q, v, a)).max()))
    return worst


def _beside_mujoco(
    robot: pollard_pin.Pollard, state: State, ours: partial, forces: np.ndarray
) -> Row:
    name, count = "mj_inverse of the open tree", len(state[0])
    if not installed("mujoco"):
        return Row(f"{LOOP}, along a path", count, ours, Peer(name, count, None))
    from peers.mujoco_trees import mujoco_tree

    other = mujoco_tree(mjcf(robot.specification, anchors(robot.specification)), state)

    def difference() -> float:
        return float(np.abs(other.work() - forces.T).max())

    equal = Equal("torques of the open tree [N·m]", difference, 1e-9)
    return Row(f"{LOOP}, along a path", count, ours, Peer(name, count, other.work), equal)


def _beside_general(robot: pollard_pin.Pollard, state: State, ours: partial) -> Row:
    few = [part[:: max(1, len(part) // 500)] for part in state]
    theirs = partial(loop_dynamics.inverse_dynamics, robot, *few)

    def difference() -> float:
        found = inverse_dynamics_at(robot, *few).torque
        return float(np.abs(found - theirs().torque).max())

    peer = Peer("thesis_pin's solver for any loops", len(few[0]), theirs)
    equal = Equal("torques [N·m]", difference, 1e-9)
    return Row(f"{LOOP}, along a path", len(state[0]), ours, peer, equal)


def _one_sample(robot: pollard_pin.Pollard, path: pollard_pin.ToolPath) -> Row:
    motion = path.at([0.4 * path.duration])
    joints = joint_trajectory(robot, motion)
    state = (joints.q, joints.v, joints.a)

    def ours() -> object:
        return inverse_dynamics(robot, motion, joint_trajectory(robot, motion))

    single = partial(pin.rnea, robot.model, robot.data, *(part[0] for part in state))
    return Row(
        "one sample: joint_trajectory, inverse_dynamics",
        1,
        ours,
        Peer("pin.rnea, one call", 1, single),
        _explained(robot, state),
        (Goal(0.3, "ms"),),
    )
