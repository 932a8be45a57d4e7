"""A path on a robot, in the forms that other programs read."""

from __future__ import annotations

from functools import cache

from pollard_pin.coordinates import POSE_NAMES
from pollard_pin.dynamics.inverse import inverse_dynamics
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.trajectory import SolvedTrajectory, joint_trajectory
from pollard_pin.motion.writing import path_toml
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATORS
from thesis_pin.numeric.elementwise import Samples
from thesis_pin.report.exchange.joint_trajectory import JointStates
from thesis_pin.report.exchange.movement import Movement


def path_movement(
    robot: Pollard,
    path: ToolPath,
    *,
    samples: int | None = None,
    branch: Branch = DEFAULT_BRANCH,
) -> Movement:
    """A path at some times, for :func:`thesis_pin.report.exchange.movement.content`.

    Args:
        robot: The robot.
        path: The path of the spray tip.
        samples: Number of evenly spaced times; None is 401.
        branch: Which inverse-kinematics solution.
    """
    motion = path.sample(samples or 401)
    motors = list(ACTUATORS)

    @cache
    def joints() -> SolvedTrajectory:
        return joint_trajectory(robot, motion, branch=branch)

    def states() -> JointStates:
        q = joints()
        torque = inverse_dynamics(robot, motion, q).torque
        return JointStates(
            ACTUATOR_NAMES, q.time, q.q[:, motors], q.v[:, motors], q.a[:, motors], torque
        )

    return Movement(
        motion.time,
        {},
        {
            name: ("length" if k < 3 else "angle", motion.pose[:, k])
            for k, name in enumerate(POSE_NAMES)
        },
        ACTUATOR_NAMES,
        lambda: joints().q[:, motors],
        states,
        lambda units: path_toml(path.name, motion, path.made_for),
    )


def report_states(report: TrajectoryReport, keep: Samples) -> JointStates:
    """What the six motors do at some samples of a report."""
    q, motors = report.joints.part(keep), list(ACTUATORS)
    torque = report.dynamics.torque[keep]
    return JointStates(
        ACTUATOR_NAMES, q.time, q.q[:, motors], q.v[:, motors], q.a[:, motors], torque
    )
