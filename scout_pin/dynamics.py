"""Inverse dynamics of the biped on the floor, and what a foot's landing does.

RNEA gives the generalized forces of the free-flying robot. Its six base rows
are the wrench the floor must supply; carried to the stance foot, that wrench
takes its share of the leg's joint rows away. No Jacobian has to be formed and
no system solved while one foot stands.

Source: Scout thesis, 4.5–4.7, corrected: six constraint rows a stance foot and
A_τ = [0; I] instead of the printed (4.15)–(4.23); see docs/audit/scout.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pinocchio as pin
from scipy.spatial.transform import Rotation

from scout_pin.contact import Contact, in_sole_axes
from scout_pin.forward import leg_frames
from scout_pin.gait import Motion
from scout_pin.load_sharing import share_load
from scout_pin.model import Scout
from scout_pin.rates import leg_rates
from scout_pin.specification import SIDES
from thesis_pin.checks import instance
from thesis_pin.errors import BadInput, TrajectoryError, WrongShape
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.trajectory import BodyMotion, JointTrajectory


@dataclass(frozen=True)
class ContactDynamics:
    """Joint torques and floor wrenches of a motion.

    Attributes:
        torque: Joint torques [N·m], shape ``(n, 12)``, joint friction included.
        wrench: Floor's wrench on each foot, world axes, about p_i: force [N],
            moment [N·m], shape ``(n, 2, 6)``, left then right; zero off the floor.
        sole_wrench: The same in the sole's axes.
        contacts: Contact of each sole, left then right.
        support: Feet in support, shape ``(n, 2)``.
        required: Wrench the floor must supply in all, about the torso's origin in
            its axes, shape ``(n, 6)``.
        double_violation: Least wrench missing in double support [N·m, forces
            scaled], zero where the floor can supply it, NaN in single support.
    """

    torque: np.ndarray
    wrench: np.ndarray
    sole_wrench: np.ndarray
    contacts: tuple[Contact, Contact]
    support: np.ndarray
    required: np.ndarray
    double_violation: np.ndarray

    @cached_property
    def contact_margin(self) -> np.ndarray:
        """Distance of each foot's wrench inside its cone [N·m], ``(n, 2)``; NaN off the floor."""
        margin = np.stack(
            [contact.margin(self.sole_wrench[:, k]) for k, contact in enumerate(self.contacts)],
            axis=1,
        )
        return np.where(self.support, margin, np.nan)

    @cached_property
    def admissible(self) -> np.ndarray:
        """Whether the floor can supply the wrench, booleans ``(n,)``."""
        single = np.where(self.support, self.contact_margin, np.inf).min(axis=1)
        double = self.support.all(axis=1)
        # On the cone's border the margin is zero to rounding: a QP stops there.
        return np.where(double, self.double_violation <= 1e-7, single >= -1e-7)

    @cached_property
    def friction_used(self) -> np.ndarray:
        """Share of the admissible friction in use by each foot, ``(n, 2)``; NaN off the floor."""
        used = [c.friction_used(self.sole_wrench[:, k]) for k, c in enumerate(self.contacts)]
        return np.where(self.support, np.stack(used, axis=1), np.nan)

    @cached_property
    def centre_of_pressure(self) -> np.ndarray:
        """Centre of pressure in each sole's frame [m], ``(n, 2, 2)``; NaN off the floor."""
        points = [c.centre_of_pressure(self.sole_wrench[:, k]) for k, c in enumerate(self.contacts)]
        return np.where(self.support[..., None], np.stack(points, axis=1), np.nan)

    def least_violation(self, sample: int) -> tuple[float, np.ndarray]:
        """Least wrench, in size [N·m, forces scaled] and itself ``(6,)``, the floor can't supply.

        In single support about the stance foot's origin, in its axes; in double
        support only the size is known, and the wrench is NaN.
        """
        if self.support[sample].all():
            return float(self.double_violation[sample]), np.full(6, np.nan)
        k = int(np.argmax(self.support[sample]))
        return self.contacts[k].violation(self.sole_wrench[sample, k])


def joint_trajectory(robot: Scout, motion: Motion) -> JointTrajectory:
    """Inverse kinematics of a whole motion, rates and accelerations included.

    Raises:
        Unreachable: Some pose has no valid branch.
        SingularPose: A leg's Jacobian loses rank on the way.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    instance("motion", motion, Motion, "Gait.sample()")
    feet = {"left": motion.left_foot, "right": motion.right_foot}
    q = robot.inverse_kinematics(
        motion.torso.placement, motion.left_foot.placement, motion.right_foot.placement
    )
    parts = [
        leg_rates(robot.legs[side], q[:, 6 * k : 6 * k + 6], feet[side].seen_from(motion.torso))
        for k, side in enumerate(SIDES)
    ]
    v, a = (np.concatenate([part[order] for part in parts], axis=1) for order in (0, 1))
    return JointTrajectory(motion.time, q, v, a)


def walking(robot: Scout) -> Scout:
    """The biped, if its root is a free flyer.

    Raises:
        BadInput: It is no :class:`Scout`, or has the thesis's eighteen coordinates.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    if robot.root != "free_flyer":
        raise BadInput(
            f"the robot's root is {robot.root!r}",
            allowed="'free_flyer'",
            remedy="Load it with scout_pin.load(), and convert with to_free_flyer()",
        )
    return robot


def free_flyer_state(
    torso: BodyMotion, joints: JointTrajectory
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pinocchio's q ``(n, 19)``, v ``(n, 18)``, a ``(n, 18)`` of a free-flyer root."""

    def local(vector: np.ndarray) -> np.ndarray:
        return np.einsum("nji,nj->ni", torso.rotation, vector)

    quaternion = Rotation.from_matrix(torso.rotation).as_quat()
    linear, angular = local(torso.velocity), local(torso.omega)
    moving = local(torso.acceleration) - np.cross(angular, linear)
    return (
        np.concatenate([torso.position, quaternion, joints.q], axis=1),
        np.concatenate([linear, angular, joints.v], axis=1),
        np.concatenate([moving, local(torso.alpha), joints.a], axis=1),
    )


def free_flying_forces(robot: Scout, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """RNEA of many samples, shape ``(n, 18)``; the robot must have a free-flyer root."""
    pool = pin.ModelPool(robot.model, 1)
    # Pinocchio wants one sample a column; the transpose of a C array is that, uncopied.
    columns = [np.ascontiguousarray(part).T for part in (q, v, a)]
    return np.ascontiguousarray(pin.rneaInParallel(1, pool, *columns).T)


def inverse_dynamics(
    robot: Scout, motion: Motion, joints: JointTrajectory | None = None
) -> ContactDynamics:
    """Torques and floor wrenches of a motion.

    With one foot on the floor both are determined. With two, six components are
    free: of all admissible pairs of wrenches the one with the least sum of
    squared joint torques is taken (a quadratic programme; all its terms are N²·m²).
    Where no admissible pair exists, the same rule holds without the floor's
    limits (feet glued), and ``double_violation`` says how much is missing.

    Args:
        robot: The biped, with a free-flyer root.
        motion: The sampled gait.
        joints: Its joint trajectory; None computes it.

    Raises:
        BadInput: The robot's root is no free flyer, or the joints aren't this motion's.
        TrajectoryError: At some sample no foot is in support.
        Unreachable, SingularPose: See :func:`joint_trajectory`.
    """
    walking(robot)
    if joints is None:
        joints = joint_trajectory(robot, motion)
    instance("motion", motion, Motion, "Gait.sample()")
    instance("joints", joints, JointTrajectory, "joint_trajectory()")
    if np.shape(joints.q) != (len(motion.time), 12):
        raise WrongShape("joints.q", np.shape(joints.q), f"({len(motion.time)}, 12), as motion")
    if not motion.support.any(axis=1).all():
        k = int(np.argmin(motion.support.any(axis=1)))
        raise TrajectoryError("no foot is in support", where=f"t = {motion.t[k]:g}")
    forces = free_flying_forces(robot, *free_flyer_state(motion.torso, joints))
    contacts = robot.contacts
    shares, violation = share_load(robot, motion, joints, forces, contacts)
    torque = forces[:, 6:].copy()
    count = len(forces)
    wrench, sole_wrench = np.zeros((count, 2, 6)), np.zeros((count, 2, 6))
    for k, side in enumerate(SIDES):
        foot = motion.left_foot if side == "left" else motion.right_foot
        frames = leg_frames(robot.legs[side], joints.q[:, 6 * k : 6 * k + 6])
        force, moment = shares[:, k, :3], shares[:, k, 3:]
        # z_j · (m about p_j) for each joint of the leg, in the torso's axes.
        about_joint = moment.T[None] - np.cross(frames.points, force.T[None], axis=1)
        torque[:, 6 * k : 6 * k + 6] -= np.einsum("jxn,jxn->nj", frames.axes, about_joint)
        about_sole = moment - np.cross(frames.sole.T, force)
        for column, vector in ((0, force), (3, about_sole)):
            wrench[:, k, column : column + 3] = np.einsum(
                "nij,nj->ni", motion.torso.rotation, vector
            )
        sole_wrench[:, k] = in_sole_axes(foot.rotation, wrench[:, k])
    torque += joint_friction(robot, joints.v)
    return ContactDynamics(
        torque,
        wrench,
        sole_wrench,
        contacts,
        motion.support,
        forces[:, :6],
        violation,
    )


def joint_friction(robot: Scout, v: np.ndarray) -> np.ndarray:
    """Torque that overcomes joint friction [N·m]: ``(n, 12)`` rates → ``(n, 12)``.

    Coulomb friction of a joint at rest is undetermined and taken as zero.
    """
    friction = robot.specification.assumptions.joint_friction
    moving = np.abs(v) > TOLERANCES.static
    return friction.viscous * v + friction.coulomb * np.where(moving, np.sign(v), 0.0)
