"""Pollard's rows of the benchmark table; ``python benchmarks/run.py`` prints them all."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin
from scipy.optimize import least_squares

import pollard_pin
from pollard_pin.motion import joint_trajectory
from pollard_pin.path import appendix_b
from pollard_pin.specification import ACTUATORS
from thesis_pin import loop_dynamics, loops

Row = tuple[str, float, str, float]
"""Work, its seconds per item, a peer, the peer's seconds per item."""

Clock = Callable[..., float]
"""``median_time(work, count, repeats=7)`` of benchmarks/run.py."""


def _gap(robot: pollard_pin.Pollard, target: pin.SE3, q: np.ndarray) -> np.ndarray:
    """Twelve equations: the tool's pose and both loops."""
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    tip = data.oMf[robot.model.getFrameId("tool_tip")]
    return np.concatenate([pin.log6(target.actInv(tip)).vector, loops.residual(robot, q)])


def newton(robot: pollard_pin.Pollard, target: pin.SE3, start: np.ndarray) -> np.ndarray:
    """The usual loop on Pinocchio: Newton steps on pose and loops together."""
    q, data = start.copy(), robot.model.createData()
    frame = robot.model.getFrameId("tool_tip")
    for _ in range(50):
        gap = _gap(robot, target, q)
        if np.linalg.norm(gap) < 1e-10:
            break
        matrix = pin.computeFrameJacobian(robot.model, data, q, frame, pin.LOCAL)
        q = q - np.linalg.solve(np.concatenate([matrix, loops.jacobian(robot, q)]), gap)
    return q


def pollard_kinematics(median_time: Clock, count: int = 20_000) -> list[Row]:
    """Inverse and forward kinematics against numeric peers."""
    robot = pollard_pin.load()
    motion = appendix_b(robot.specification).sample(count)
    pose = motion.pose
    stack = median_time(lambda: robot.inverse_kinematics(pose), count)
    all_16 = median_time(lambda: robot.inverse_kinematics(pose, "useful"), count, repeats=3)
    single = median_time(lambda: [robot.inverse_kinematics(pose[0]) for _ in range(200)], 200)
    q = robot.inverse_kinematics(pose).angles
    data, few = robot.model.createData(), 20
    frame = robot.model.getFrameId("tool_tip")
    starts, targets = q[:few] + 0.05, []
    for one in q[:few]:
        pin.framesForwardKinematics(robot.model, data, one)
        targets.append(data.oMf[frame].copy())
    pairs = list(zip(targets, starts, strict=True))
    numeric = median_time(lambda: [newton(robot, t, s) for t, s in pairs], few, repeats=3)
    squares = median_time(
        lambda: [least_squares(lambda q, t=t: _gap(robot, t, q), s) for t, s in pairs[:5]],
        5,
        repeats=3,
    )
    rates = median_time(lambda: joint_trajectory(robot, motion), count)
    motors = q[:2000, ACTUATORS]
    forward = median_time(lambda: robot.forward_kinematics(motors), 2000, repeats=3)
    near = median_time(
        lambda: [loops.close(robot, one + 0.05, one[list(ACTUATORS)]) for one in q[:few]], few, 3
    )
    return [
        ("IK, 12 angles, stack", stack, "Newton on Pinocchio", numeric),
        ("IK, 12 angles, stack", stack, "scipy least squares", squares),
        ("IK, 12 angles, one pose", single, "Newton on Pinocchio", numeric),
        ("IK, 16 branches, stack", all_16, "IK, one branch", stack),
        ("IK, rates, accelerations", rates, "IK, one branch", stack),
        ("FK, every assembly mode", forward, "Newton, one mode", near),
    ]


def pollard_dynamics(median_time: Clock, count: int = 20_000) -> list[Row]:
    """Loop inverse dynamics against bare RNEA and the general solver."""
    robot = pollard_pin.load()
    motion = appendix_b(robot.specification).sample(count)
    joints, _ = joint_trajectory(robot, motion)
    state = (joints.q, joints.v, joints.a)
    rnea = median_time(lambda: robot.tree_torques(*state), count)
    fast = median_time(lambda: robot.inverse_dynamics(*state), count)
    some = tuple(x[:500] for x in state)
    general = median_time(lambda: loop_dynamics.inverse_dynamics(robot, *some), 500, repeats=3)

    def whole() -> None:
        joints, _ = joint_trajectory(robot, motion)
        robot.inverse_dynamics(joints.q, joints.v, joints.a)

    peer = "RNEA, one thread"
    return [
        ("loop inverse dynamics", fast, peer, rnea),
        ("loop inverse dynamics", fast, "general solver", general),
        ("path to torques", median_time(whole, count), peer, rnea),
    ]
