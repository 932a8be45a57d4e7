"""Accuracy along a path, and over a workspace."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, one_branch
from pollard_pin.kinematics.singularity import actuation, actuation_along, require_one_sign
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.specification import six
from pollard_pin.study.accuracy.document import Accuracy
from pollard_pin.study.accuracy.draws import drawn
from pollard_pin.study.accuracy.stacking import stacked
from pollard_pin.study.accuracy.tolerances import Tolerances, default_tolerances
from pollard_pin.study.accuracy.within import within as tolerances_within
from pollard_pin.study.workspace import Workspace, evaluate_workspace
from thesis_pin.errors import BadInput, Unreachable
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import function, instance, real, whole
from thesis_pin.numeric.workers import silent

MOST = 250_000
"""Poses at most: of each, two numbers are kept of every tolerance."""


def path_accuracy(
    robot: Pollard,
    path: ToolPath,
    allowed: Tolerances | None = None,
    *,
    samples: int = 401,
    branch: Branch = DEFAULT_BRANCH,
    draws: int = 200,
    seed: int = 0,
    within: float | None = None,
    stiffness: ArrayLike | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Accuracy:
    """How errors of the robot's numbers reach the spray tip along a path.

    Args:
        robot: The planned robot.
        path: The path of the spray tip.
        allowed: What may be off; None for ±0.1 mm of every length and ±0.1° of every angle.
        samples: Number of evenly spaced samples.
        branch: Which inverse-kinematics solution.
        draws: Robots that are drawn and sent along the path on exact kinematics; 0 for none.
        seed: Of their errors.
        within: How far off the tip may be [m]: adds which tolerances keep it there.
        stiffness: Of each motor's joint [N·m/rad], one number or six: adds how far the tip gives
            way to a force.
        progress: Called with what is done and its total.

    Raises:
        Unreachable, SingularPose, TrajectoryError: The motion is impossible; with the place.
        BadInput: There are too many samples or draws, or a number can't be.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    instance("path", path, ToolPath, "load_path() or appendix_b()")
    path = path.followed_by(robot.specification)
    allowed, limit, stiff = _asked(allowed, within, stiffness)
    function("progress", progress, "progress(done, total)")
    branch, draws, seed = one_branch(branch), whole("draws", draws, 0), whole("seed", seed, 0)
    if whole("samples", samples, 2) > MOST:
        raise BadInput(f"{samples:,} samples", allowed=f"at most {MOST:,}")
    motion = path.sample(samples)
    angles = joint_trajectory(robot, motion, branch=branch).solutions.angles

    def determinant(time: float) -> float:
        there = robot.inverse_kinematics(path.at(time).pose, branch)
        return float(actuation(there.posture).base_determinant[0])

    signs = actuation_along(robot.geometry, angles).base_determinant
    require_one_sign(determinant, motion.time, signs)
    return Accuracy(
        robot,
        branch,
        allowed,
        motion.pose,
        angles,
        stacked(robot, angles, allowed, stiff, progress),
        path=path,
        time=motion.time,
        draws=drawn(robot, angles, allowed, draws, seed, progress) if draws else None,
        limit=limit,
        within=None if limit is None else tolerances_within(robot, angles, allowed, limit),
        stiffness=stiff,
    )


def workspace_accuracy(
    robot: Pollard,
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    orientation: Sequence[float] = (0.0, 0.0, 0.0),
    allowed: Tolerances | None = None,
    *,
    branch: Branch = DEFAULT_BRANCH,
    draws: int = 0,
    seed: int = 0,
    within: float | None = None,
    stiffness: ArrayLike | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Accuracy:
    """How errors of the robot's numbers reach the spray tip over a grid of positions.

    Args:
        robot: The planned robot.
        x: Grid values [m], shape ``(nx,)``, or one number for a slice.
        y: The same for y.
        z: The same for z.
        orientation: ψ, θ, φ of the tool [rad].
        allowed: See :func:`path_accuracy`.
        branch: Which inverse-kinematics solution.
        draws: See :func:`path_accuracy`.
        seed: The same.
        within: The same; adds at which share of the positions it is so.
        stiffness: The same.
        progress: Called with what is done and its total.

    Raises:
        Unreachable: No position can be reached.
        BadInput: The grid is too large, or a number can't be.
    """
    allowed, limit, stiff = _asked(allowed, within, stiffness)
    draws, seed = whole("draws", draws, 0), whole("seed", seed, 0)
    space = evaluate_workspace(robot, x, y, z, orientation, branch)
    angles, pose = _regular(space)
    return Accuracy(
        robot,
        space.branch,
        allowed,
        pose,
        angles,
        stacked(robot, angles, allowed, stiff, progress),
        space=space,
        draws=drawn(robot, angles, allowed, draws, seed, progress) if draws else None,
        limit=limit,
        stiffness=stiff,
    )


def _asked(
    allowed: Tolerances | None, within: float | None, stiffness: ArrayLike | None
) -> tuple[Tolerances, float | None, np.ndarray | None]:
    """The same, checked: what may be off, how far the tip may be [m], how stiff motors are."""
    if allowed is None:
        allowed = default_tolerances()
    instance("allowed", allowed, Tolerances, "read_tolerances()")
    if within is not None:
        within = real("within", within, low=1e-9, high=10.0, unit="m")
    if stiffness is None:
        return allowed, within, None
    given = finite_array("stiffness", stiffness)
    if given.shape not in ((), (1,), (6,)) or not (given > 0).all():
        raise BadInput(
            f"stiffness is {', '.join(f'{one:g}' for one in given.ravel()[:6])}",
            allowed="a positive number [N·m/rad], or six in the motors' order",
        )
    return allowed, within, six(tuple(given.tolist()) if given.size > 1 else float(given.item()))


def _regular(space: Workspace) -> tuple[np.ndarray, np.ndarray]:
    """Joint angles and poses of a workspace's reachable and regular positions."""
    places = space.points[space.reachable & np.isfinite(space.condition)]
    if not len(places):
        raise Unreachable(
            "no position of the grid can be reached",
            where=f"branch {space.branch}",
            remedy="Move the grid, turn the tool, or choose another branch",
        )
    if len(places) > MOST:
        raise BadInput(
            f"{len(places):,} positions of the grid can be reached",
            allowed=f"at most {MOST:,}",
            remedy="Use fewer points an axis",
        )
    pose = np.concatenate([places, np.broadcast_to(space.orientation, places.shape)], axis=1)
    return space.robot.inverse_kinematics(pose, space.branch).angles, pose
