"""Pollard's rows of the benchmark table; ``python benchmarks/run.py`` prints them all."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from scipy.optimize import least_squares
from timing import Comparison, again

import pollard_pin
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.motion.curves import appendix_b
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.specification import ACTUATORS
from thesis_pin.loops import dynamics as loop_dynamics
from thesis_pin.loops import kinematics as loops

RNEA = "RNEA, one thread"


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


def kinematics(count: int = 20_000) -> list[Comparison]:
    """Inverse and forward kinematics against numeric peers."""
    robot = pollard_pin.load()
    motion = appendix_b(robot.specification).sample(count)
    pose = motion.pose
    q = robot.inverse_kinematics(pose).angles
    data, few = robot.model.createData(), 20
    frame = robot.model.getFrameId("tool_tip")
    pairs = []
    for one in q[:few]:
        pin.framesForwardKinematics(robot.model, data, one)
        pairs.append((data.oMf[frame].copy(), one + 0.05))
    motors = q[:2000, ACTUATORS]

    def stack() -> object:
        return robot.inverse_kinematics(pose)

    def every() -> object:
        return robot.inverse_kinematics(pose, "useful")

    def numeric() -> object:
        return [newton(robot, target, start) for target, start in pairs]

    def squares() -> object:
        return [least_squares(lambda q, t=t: _gap(robot, t, q), s) for t, s in pairs[:5]]

    def near() -> object:
        return [loops.close(robot, one + 0.05, one[list(ACTUATORS)]) for one in q[:few]]

    single = again(lambda: robot.inverse_kinematics(pose[0]), 200)
    sixteen = again(lambda: robot.inverse_kinematics(pose[0], "useful"), 100)
    one_branch = "IK, one branch"
    return [
        Comparison("IK, 12 angles, stack", stack, count, "Newton, one", numeric, few, 5),
        Comparison("IK, 12 angles, stack", stack, count, "scipy least squares", squares, 5, 3),
        Comparison("IK, 12 angles, single", single, 200, "Newton, one", numeric, few, 5),
        Comparison("IK, 16 branches, single", sixteen, 100, "Newton, one", numeric, few, 5),
        Comparison("IK, 16 branches, stack", every, count, one_branch, stack, count, 5),
        Comparison(
            "IK, rates, accelerations",
            lambda: joint_trajectory(robot, motion),
            count,
            one_branch,
            stack,
            count,
        ),
        Comparison(
            "FK, every assembly mode",
            lambda: robot.forward_kinematics(motors),
            2000,
            "Newton, one mode",
            near,
            few,
            5,
        ),
    ]


def dynamics(count: int = 20_000) -> list[Comparison]:
    """Loop inverse dynamics against bare RNEA of the open tree and the general solver."""
    robot = pollard_pin.load()
    path = appendix_b(robot.specification)
    motion = path.sample(count)
    joints = joint_trajectory(robot, motion)
    state = (joints.q, joints.v, joints.a)
    columns = [np.asfortranarray(part.T) for part in state]
    pool, tau = pin.ModelPool(robot.model, 1), np.empty((12, count), order="F")
    some = tuple(x[:500] for x in state)

    def rnea() -> object:
        return pin.rneaInParallel(1, pool, *columns, tau)

    def fast() -> object:
        return inverse_dynamics_at(robot, *state)

    def general() -> object:
        return loop_dynamics.inverse_dynamics(robot, *some)

    def whole() -> None:
        joints = joint_trajectory(robot, motion)
        inverse_dynamics_at(robot, joints.q, joints.v, joints.a)

    def stream() -> None:
        for _ in pollard_pin.torque_blocks(robot, path, motion.time):
            pass

    return [
        Comparison("loop inverse dynamics", fast, count, RNEA, rnea, count),
        Comparison("loop inverse dynamics", fast, count, "general solver", general, 500, 3),
        Comparison("path to torques", whole, count, RNEA, rnea, count),
        Comparison("path's curve to torques", stream, count, RNEA, rnea, count),
    ]
