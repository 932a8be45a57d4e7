"""What the samples of a path leave open, carried through kinematics and dynamics.

Every variant of a smoothed path (see :mod:`pollard_pin.motion.variants`) is judged as the path
itself is, all of them in one stack.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pollard_pin.coordinates import pose_from_placement
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.dynamics.three_motors import three_torques
from pollard_pin.kinematics.geometry import Branch
from pollard_pin.kinematics.rates import stack_rates
from pollard_pin.kinematics.singularity import rate_jacobian
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.variants import Variants
from pollard_pin.specification import ACTUATORS
from thesis_pin.errors import ThesisPinError
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory

Array = NDArray[np.float64]

SAMPLES = 301
"""Evenly spaced samples at which variants are judged, beside extremes."""


@dataclass(frozen=True)
class Judged:
    """Numbers of some samples for each variant that could be worked out.

    Attributes:
        torque, speed: Of each motor, shape ``(variants, k, 6)``.
        loop_force: Size of the force in each ball joint [N], ``(variants, k, 2)``.
        reach: Reach margins [-], ``(variants, k)``.
    """

    torque: Array
    speed: Array
    loop_force: Array
    reach: Array


@dataclass(frozen=True)
class Drawn:
    """The variants of a path beside its own curves, judged.

    Attributes:
        keep: Samples of the path's motion at which they are judged, shape ``(k,)``.
        rival: Order 3's curve, one variant; None if it couldn't be worked out.
        draws: The draws that could.
        lost: How many draws couldn't.
    """

    keep: NDArray[np.intp]
    rival: Judged | None
    draws: Judged
    lost: int


@dataclass(frozen=True)
class Way:
    """How a path is followed.

    Attributes:
        robot: The robot.
        branch: The solution of inverse kinematics.
        three: Whether by the thesis's three motors.
    """

    robot: Pollard
    branch: Branch
    three: bool


def drawn(
    way: Way, motion: ToolMotion, joints: JointTrajectory, extremes: Sequence[int] = ()
) -> Drawn | None:
    """Judge the variants of a path; None if it has none.

    Args:
        way: How it is followed.
        motion: Its sampled motion.
        joints: Its joint trajectory.
        extremes: Samples at which the path itself has its largest numbers.
    """
    variants = None if motion.path is None else motion.path.variants
    if variants is None:
        return None
    last = len(motion.time) - 1
    even = np.linspace(0, last, min(last + 1, SAMPLES)).round().astype(np.intp)
    keep = np.union1d(even, np.asarray(extremes, dtype=np.intp))
    own, count = motion.part(keep), variants.count - 1
    found = _every(way, variants, own, count)
    alive = [number for number, one in enumerate(found) if one is not None]
    if not any(alive):
        return Drawn(keep, found[0], _none(len(keep)), count - 1)
    return Drawn(keep, found[0], _stacked(found[1:]), count - len([k for k in alive if k]) - 1)


def judged(way: Way, tool: BodyMotion, near: Array, count: int) -> Judged:
    """Numbers of a stack of motions, one after the other.

    Args:
        way: How they are followed.
        tool: The tool's motion, as many samples of each as of the others.
        near: Angles ψ, θ, φ near which to name orientations [rad], ``(n, 3)``.
        count: How many motions.

    Raises:
        Unreachable, SingularPose: One can't be followed.
    """
    robot = way.robot
    pose = pose_from_placement(tool.position, tool.rotation, near)
    solutions = robot.inverse_kinematics(pose, way.branch).require("path sample")
    posture, q = solutions.posture, solutions.angles
    v, a = stack_rates(robot.geometry, q, tool)
    dynamics = inverse_dynamics_at(robot, q, v, a, posture)
    torque = dynamics.torque
    if way.three:
        three = three_torques(rate_jacobian(posture, pose), dynamics.joint_force).torque
        torque = np.concatenate([three, np.zeros_like(three)], axis=1)
    values = {
        "torque": torque,
        "speed": v[:, ACTUATORS],
        "loop_force": np.linalg.norm(dynamics.loop_force, axis=-1),
        "reach": solutions.margin,
    }
    return Judged(**{name: x.reshape(count, -1, *x.shape[1:]) for name, x in values.items()})


def _every(way: Way, variants: Variants, own: ToolMotion, count: int) -> list[Judged | None]:
    """All variants in one stack, or each by itself if some can't be followed."""
    tool, near, many = variants.others(own.time), own.pose[:, 3:], len(own.time)
    try:
        whole = judged(way, tool, np.tile(near, (count, 1)), count)
    except ThesisPinError:
        found: list[Judged | None] = []
        for k in range(count):
            part = slice(k * many, (k + 1) * many)
            try:
                found.append(judged(way, tool.part(part), near, 1))
            except ThesisPinError:
                found.append(None)
        return found
    return [Judged(**{n: x[k : k + 1] for n, x in vars(whole).items()}) for k in range(count)]


def _stacked(found: Sequence[Judged | None]) -> Judged:
    alive = [one for one in found if one is not None]
    names = vars(alive[0])
    return Judged(**{name: np.concatenate([getattr(one, name) for one in alive]) for name in names})


def _none(count: int) -> Judged:
    empty = np.empty((0, count, 6))
    return Judged(empty, empty, np.empty((0, count, 2)), np.empty((0, count)))
