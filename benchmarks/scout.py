"""Scout's rows of the benchmark table; ``python benchmarks/run.py`` prints them all."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin
from timing import Comparison, Work, again

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.inverse import leg_inverse_kinematics
from scout_pin.kinematics.rates import leg_rates
from scout_pin.motion.trajectory import joint_trajectory

RNEA = "RNEA, one thread"


def newton(model: pin.Model, frame: int, target: pin.SE3, start: np.ndarray) -> np.ndarray:
    """The usual loop on Pinocchio: damped Newton steps until the sole is there."""
    data, q = model.createData(), start.copy()
    for _ in range(100):
        pin.framesForwardKinematics(model, data, q)
        error = pin.log6(data.oMf[frame].actInv(target)).vector
        if np.linalg.norm(error) < 1e-10:
            break
        jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL)
        step = np.linalg.lstsq(jacobian, error, rcond=None)[0]
        q = pin.integrate(model, q, step)
    return q


def numeric_leg(robot: scout_pin.Scout, poses: np.ndarray, theta: np.ndarray) -> Work:
    """Newton's method on the left leg alone, from 0.1 rad beside each solution."""
    names = [n for n in robot.model.names if n.startswith("right") or n == "root_joint"]
    joints = [robot.model.getJointId(name) for name in names]
    alone = pin.buildReducedModel(robot.model, joints, pin.neutral(robot.model))
    frame = alone.getFrameId("left_sole")
    pairs = [(pin.SE3(pose), start + 0.1) for pose, start in zip(poses, theta, strict=True)]
    return lambda: [newton(alone, frame, target, start) for target, start in pairs]


def eaik_solvers(leg: LegGeometry, poses: np.ndarray) -> tuple[Callable[[], object], ...] | None:
    """EAIK on the same leg: a stack and a single pose; None if it isn't installed."""
    try:
        from eaik.IK_HP import HPRobot
    except ImportError:
        return None
    letters = {"x": [1.0, 0, 0], "y": [0, 1.0, 0], "z": [0, 0, 1.0]}
    axes = np.array([letters[a] for a in "zyzzzx"])
    origins = np.array(
        [[leg.x_0, 0, 0], [0, 0, -leg.z_1], [leg.x_2, 0, 0], [leg.x_3, 0, 0],
         [leg.x_4, 0, 0], [leg.x_5, 0, 0], [0, leg.y_6, 0]]
    )  # fmt: skip
    other = HPRobot(axes, origins)
    turned = poses.copy()
    turned[:, :3, :3] = turned[:, :3, :3] @ leg.foot.T
    one = turned[0]
    return lambda: other.IK_batched(turned), lambda: other.IK(one)


def kinematics(count: int = 20_000) -> list[Comparison]:
    """Leg inverse kinematics, all eight branches, and rates."""
    robot = scout_pin.load()
    leg = robot.legs["left"]
    theta = np.random.default_rng(0).uniform(-1, 1, (count, 6))
    poses = leg_forward_kinematics(leg, theta)
    one = pin.SE3(poses[0])

    def stack() -> object:
        return leg_inverse_kinematics(leg, poses)

    single = again(lambda: leg_inverse_kinematics(leg, one), 200)
    numeric = numeric_leg(robot, poses[:100], theta[:100])
    rows = [
        Comparison("leg IK, 8 branches, stack", stack, count, "Newton, one", numeric, 100, 5),
        Comparison("leg IK, 8 branches, single", single, 200, "Newton, one", numeric, 100, 5),
    ]
    if (eaik := eaik_solvers(leg, poses[:2000])) is not None:
        batched, alone = eaik
        rows += [
            Comparison("leg IK, 8 branches, stack", stack, count, "EAIK, batched", batched, 2000),
            Comparison(
                "leg IK, 8 branches, single", single, 200, "EAIK, single", again(alone, 200), 200
            ),
        ]
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(count))
    joints = joint_trajectory(robot, motion)
    seen = motion.left_foot.seen_from(motion.torso)

    def rates() -> object:
        return leg_rates(leg, joints.q[:, :6], seen)

    return [
        *rows,
        Comparison("leg rates, accelerations", rates, count, "leg IK, stack", stack, count),
    ]


def dynamics(count: int = 20_000) -> list[Comparison]:
    """Contact inverse dynamics against bare RNEA of the same samples."""
    robot = scout_pin.load()
    gait = scout_pin.load_gait("thesis")
    t = gait.sample_times(count)
    motion = gait.sample(t)
    joints = joint_trajectory(robot, motion)
    columns = [np.asfortranarray(part.T) for part in free_flyer_state(motion.torso, joints)]
    pool, tau, number = pin.ModelPool(robot.model, 1), np.empty((18, len(t)), order="F"), len(t)

    def rnea() -> object:
        return pin.rneaInParallel(1, pool, *columns, tau)

    def contact() -> object:
        return inverse_dynamics(robot, motion, joints)

    def whole() -> object:
        return inverse_dynamics(robot, motion)

    def stream() -> None:
        for _ in scout_pin.torque_blocks(robot, gait, t):
            pass

    return [
        Comparison("contact inverse dynamics", contact, number, RNEA, rnea, number),
        Comparison("task space to torques", whole, number, RNEA, rnea, number),
        Comparison("gait's curves to torques", stream, number, RNEA, rnea, number),
    ]
