"""Pollard's kinematics against Newton's method on Pinocchio and SciPy's least squares."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from measuring import Equal, Goal, Peer, Row, Scale
from peers.common import nearest
from peers.newton import Tree

import pollard_pin
from pollard_pin.motion.curves import appendix_b
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.specification import ACTUATORS

ANGLES = "angles of the nearest branch [rad]"
STACK = "IK, 12 angles"


def rows(scale: Scale) -> Iterator[Row]:
    """Every row, once its data are made."""
    robot = pollard_pin.load()
    path = appendix_b(robot.specification)
    pose = path.sample(scale.sizes[-1]).pose
    motion = path.sample(scale.many)
    angles = robot.inverse_kinematics(motion.pose).angles
    places = np.linspace(0, scale.many - 1, scale.few).astype(int)
    tree = Tree(robot, angles[places], ACTUATORS)
    newton = Peer("Newton on Pinocchio", scale.few, tree.by_pose)
    squares = Peer("SciPy's least_squares", scale.few, tree.squares)

    def gap(work: partial, branch: str) -> float:
        found = robot.inverse_kinematics(motion.pose[places], branch).angles
        return max(nearest(*pair) for pair in zip(found, work(), strict=True))

    def equal(peer: Peer, tolerance: float = 1e-8, branch: str = "all") -> Equal:
        return Equal(ANGLES, lambda: gap(peer.work, branch), tolerance)

    for size in scale.sizes:
        ours = partial(robot.inverse_kinematics, pose[0] if size == 1 else pose[:size])
        goals = (Goal(8.0, "µs"),) if size == 1 else (Goal(0.22, "µs"),) if size >= 10_000 else ()
        yield Row(STACK, size, ours, newton, equal(newton), goals)
    stack = partial(robot.inverse_kinematics, motion.pose)
    yield Row(STACK, scale.many, stack, squares, equal(squares, 1e-6))
    for size in (1, scale.many):
        some = motion.pose[0] if size == 1 else motion.pose
        useful = partial(robot.inverse_kinematics, some, "useful")
        yield Row("IK, 16 branches", size, useful, newton, equal(newton))
    yield _rates(robot, motion, tree, places)
    yield _forward(robot, tree, angles, places)


def _rates(
    robot: pollard_pin.Pollard,
    motion: ToolMotion,
    tree: Tree,
    places: np.ndarray,
) -> Row:
    angles = joint_trajectory(robot, motion).q[places]
    tool = motion.tool.part(places)
    velocity = np.column_stack([tool.velocity, tool.omega])
    acceleration = np.column_stack([tool.acceleration, tool.alpha])
    theirs = partial(tree.rates, angles, velocity, acceleration)

    def difference() -> float:
        found = joint_trajectory(robot, motion)
        pairs = zip((found.v[places], found.a[places]), theirs(), strict=True)
        return max(float(np.abs(a - b).max() / max(1.0, np.abs(b).max())) for a, b in pairs)

    return Row(
        "IK with rates and accelerations",
        len(motion.time),
        lambda: joint_trajectory(robot, motion),
        Peer("Pinocchio's Jacobians, solved", len(places), theirs),
        Equal("rates and accelerations, relative", difference, 1e-8),
    )


def _forward(robot: pollard_pin.Pollard, tree: Tree, angles: np.ndarray, places: np.ndarray) -> Row:
    some = angles[:: max(1, len(angles) // 2000)]
    motors = some[:, ACTUATORS]

    def difference() -> float:
        modes = robot.forward_kinematics(angles[places][:, ACTUATORS])
        return max(nearest(*pair) for pair in zip(modes.angles, tree.by_motors(), strict=True))

    return Row(
        "FK, every assembly mode",
        len(motors),
        partial(robot.forward_kinematics, motors),
        Peer("Newton on Pinocchio, one mode", len(places), tree.by_motors),
        Equal("angles of the nearest mode [rad]", difference, 1e-8),
    )
