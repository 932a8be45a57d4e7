"""Derivatives of joints, torques and soles' wrenches by the torso's jet.

The feet's motion is given, so a foot's twist and acceleration in its own axes don't change with
the torso: differentiating them, with Pinocchio's derivatives of a frame, leaves six equations a
leg for angles, rates and accelerations each. Wrenches enter Pinocchio's RNEA as external forces
that are fixed in the soles, and change by what keeps the root without a force of its own.

Source: Scout thesis, (3.16), (3.24), 4.5, corrected; J. Carpentier, N. Mansard, "Analytical
derivatives of rigid body dynamics algorithms", RSS 2018.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from scout_pin.model import Scout
from scout_pin.specification import SIDES
from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.sampling.jets import JET, root_slopes
from scout_pin.study.plan.sampling.sharing import shared_slopes
from scout_pin.study.plan.sampling.soft import soft_slopes
from scout_pin.study.plan.sampling.state import State

ROOT = slice(0, 6)
LEGS = (slice(6, 12), slice(12, 18))


@dataclass(frozen=True)
class StateSlopes:
    """Derivatives by the torso's jet, last axis 18.

    Attributes:
        angle, rate, torque: Of the joints, ``(n, 12, 18)``.
        knee: Of the cosines that knees are asked for, ``(n, 2, 18)``.
        wrench: Of the floor's wrenches in the soles' axes, ``(n, 2, 6, 18)``.
        sole: Of the places to which the joints bring the soles, world axes, ``(n, 2, 3, 18)``;
            zero where angles are exact.
    """

    angle: np.ndarray
    rate: np.ndarray
    torque: np.ndarray
    knee: np.ndarray
    wrench: np.ndarray
    sole: np.ndarray


@dataclass(frozen=True)
class FrameSlopes:
    """Pinocchio's derivatives at n samples, in the soles' axes.

    Attributes:
        jacobian: Of both soles, ``(n, 2, 6, 18)``.
        twist: Of their twists by the configuration, likewise.
        bend: Of their accelerations by the configuration, likewise.
        drift: Of their accelerations by the rates, likewise.
        force: Of the generalized forces by configuration, rates and accelerations,
            ``(3, n, 18, 18)``, wrenches on the soles fixed in their axes.
    """

    jacobian: np.ndarray
    twist: np.ndarray
    bend: np.ndarray
    drift: np.ndarray
    force: np.ndarray


def state_slopes(
    robot: Scout,
    jets: np.ndarray,
    footing: Footing,
    here: State,
    straight: float,
    rate: float = 0.0,
) -> StateSlopes:
    """Derivatives of a state.

    Args:
        robot: The biped.
        jets: The torso's, shape ``(n, 18)``.
        footing: Its feet.
        here: The state of these jets.
        straight: Cosine of a knee's angle up to which angles are exact.
        rate: Of the heading that the torso's angles count from [rad/s].
    """
    of = _frame_slopes(robot, here)
    root = root_slopes(jets, here.torso, rate)
    inverses = [np.linalg.inv(of.jacobian[:, k, :, mine]) for k, mine in enumerate(LEGS)]
    q, v, a = np.zeros((3, len(jets), 18, JET))
    q[:, ROOT], v[:, ROOT], a[:, ROOT] = root.q, root.v, root.a
    for k, mine in enumerate(LEGS):
        back, jacobian = -inverses[k], of.jacobian[:, k, :, ROOT]
        q[:, mine] = back @ (jacobian @ root.q)
    sines = np.sin(here.joints.q[:, [3, 9]] + _knee_zero(robot))
    knee, sole = -sines[..., None] * q[:, [9, 15]], np.zeros((len(jets), 2, 3, JET))
    for k, side in enumerate(SIDES):
        some = np.flatnonzero(np.abs(here.knee[:, k]) > straight)
        if some.size:
            turn = here.torso.rotation[some]
            theta = here.joints.q[some, 6 * k : 6 * k + 6]
            short = np.einsum("nji,nj->ni", turn, here.short[some, k])
            leg, asked = robot.legs[side], here.knee[some, k]
            found = soft_slopes(leg, theta, short, asked, straight, root.q[some])
            q[some, LEGS[k]], knee[some, k] = found
            moved = of.jacobian[some, k, :3] @ q[some]
            sole[some, k] = here.feet[k].rotation[some] @ moved
    for k, mine in enumerate(LEGS):
        back, jacobian = -inverses[k], of.jacobian[:, k, :, ROOT]
        v[:, mine] = back @ (of.twist[:, k] @ q + jacobian @ root.v)
        # A leg's own rates alone change its sole's acceleration, the root's too.
        a[:, mine] = back @ (of.bend[:, k] @ q + of.drift[:, k] @ v + jacobian @ root.a)
    force = of.force[0] @ q + of.force[1] @ v + of.force[2] @ a
    wrench, torque = np.zeros((len(jets), 2, 6, JET)), force[:, 6:].copy()
    double = footing.support.all(axis=1)
    for k in (0, 1):
        alone = footing.support[:, k] & ~double
        turned = np.swapaxes(of.jacobian[alone, k], 1, 2)
        wrench[alone, k] = np.linalg.solve(turned[:, ROOT], force[alone, :6])
    if double.any():
        wrench[double] = shared_slopes(
            robot, here, np.flatnonzero(double), of.jacobian[double], force[double], q[double]
        )
    for k, mine in enumerate(LEGS):
        turned = np.swapaxes(of.jacobian[:, k, :, mine], 1, 2)
        torque[:, 6 * k : 6 * k + 6] -= turned @ wrench[:, k]
    torque += robot.specification.assumptions.joint_friction.viscous * v[:, 6:]
    return StateSlopes(q[:, 6:], v[:, 6:], torque, knee, wrench, sole)


def _knee_zero(robot: Scout) -> np.ndarray:
    """β_4 of each leg, left then right."""
    return np.array([robot.legs[side].beta[3] for side in SIDES])


def _frame_slopes(robot: Scout, here: State) -> FrameSlopes:
    """What Pinocchio gives, sample by sample: it has no batch form of these."""
    model, data = robot.model, robot.model.createData()
    frames = [robot.sole_frames[side] for side in SIDES]
    joints = [model.frames[frame].parentJoint for frame in frames]
    places = [model.frames[frame].placement for frame in frames]
    outer = pin.StdVec_Force()
    outer.extend([pin.Force.Zero()] * model.njoints)
    q, v, a = here.pinocchio()
    count = len(q)
    kept = np.empty((4, count, 2, 6, 18))
    force = np.empty((3, count, 18, 18))
    wrench = here.dynamics.sole_wrench
    for i in range(count):
        for k, joint in enumerate(joints):
            outer[joint] = places[k].act(pin.Force(wrench[i, k]))
        force[:, i] = pin.computeRNEADerivatives(model, data, q[i], v[i], a[i], outer)
        pin.computeForwardKinematicsDerivatives(model, data, q[i], v[i], a[i])
        for k, frame in enumerate(frames):
            found = pin.getFrameAccelerationDerivatives(model, data, frame, pin.LOCAL)
            kept[1, i, k], kept[2, i, k], kept[3, i, k], kept[0, i, k] = found
    return FrameSlopes(kept[0], kept[1], kept[2], kept[3], force)
