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

import daqp
import numpy as np
import pinocchio as pin
from scipy.optimize import nnls
from scipy.spatial.transform import Rotation

from scout_pin.contact import Contact, in_sole_axes
from scout_pin.gait import Gait, Motion
from scout_pin.kinematics import leg_frames, leg_rates
from scout_pin.model import Scout
from scout_pin.specification import SIDES
from thesis_pin.errors import TrajectoryError
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
        TrajectoryError: At some sample no foot is in support.
        Unreachable, SingularPose: See :func:`joint_trajectory`.
    """
    joints = joint_trajectory(robot, motion) if joints is None else joints
    if not motion.support.any(axis=1).all():
        k = int(np.argmin(motion.support.any(axis=1)))
        raise TrajectoryError("no foot is in support", where=f"t = {motion.t[k]:g}")
    forces = free_flying_forces(robot, *free_flyer_state(motion.torso, joints))
    contacts = robot.contacts
    shares, violation = _share_load(robot, motion, joints, forces, contacts)
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


def _share_load(
    robot: Scout,
    motion: Motion,
    joints: JointTrajectory,
    forces: np.ndarray,
    contacts: tuple[Contact, ...],
) -> tuple[np.ndarray, np.ndarray]:
    """Wrench of each foot about the torso's origin, torso axes, ``(n, 2, 6)``."""
    shares = motion.support[:, :, None] * forces[:, None, :6]
    violation = np.full(len(forces), np.nan)
    double = np.flatnonzero(motion.support.all(axis=1))
    if not double.size:
        return shares, violation
    frames = [
        leg_frames(robot.legs[s], joints.q[double, 6 * k : 6 * k + 6]) for k, s in enumerate(SIDES)
    ]
    feet = (motion.left_foot, motion.right_foot)
    to_sole = [
        np.einsum("nji,njk->nik", feet[k].rotation[double], motion.torso.rotation[double])
        for k in range(2)
    ]
    for row, sample in enumerate(double):
        # Transposed leg Jacobians and maps to scaled sole wrenches, of wrenches
        # about the torso's origin.
        jacobians, maps = [], []
        for k in range(2):
            axes, points = frames[k].axes[..., row], frames[k].points[..., row]
            jacobians.append(np.concatenate([np.cross(points, axes), axes], axis=1))
            maps.append(_to_scaled_sole(to_sole[k][row], frames[k].sole[:, row], contacts[k]))
        left, violation[sample] = _least_torque(forces[sample], jacobians, maps, contacts)
        shares[sample, 0], shares[sample, 1] = left, forces[sample, :6] - left
    return shares, violation


def _to_scaled_sole(rotation: np.ndarray, sole: np.ndarray, contact: Contact) -> np.ndarray:
    """Map from a wrench about the torso's origin to the sole's scaled wrench, ``(6, 6)``."""
    x, y, z = sole
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    result = np.zeros((6, 6))
    result[:3, :3] = contact.length * rotation
    result[3:, :3], result[3:, 3:] = -rotation @ skew, rotation
    return result


def _least_torque(
    forces: np.ndarray,
    jacobians: list[np.ndarray],
    maps: list[np.ndarray],
    contacts: tuple[Contact, ...],
) -> tuple[np.ndarray, float]:
    """Left foot's wrench w with least |τ|², the right one carrying the rest.

    τ_left = τ − J_leftᵀ w and τ_right = τ − J_rightᵀ (W − w), subject to both
    wrenches lying in their cones.
    """
    total = forces[:6]
    matrix = np.concatenate([jacobians[0], -jacobians[1]])
    target = np.concatenate([forces[6:12], forces[12:18] - jacobians[1] @ total])
    # Columns scaled like the wrench, so that the programme works in N·m throughout.
    unit = np.repeat([contacts[0].length, 1.0], 3)
    scaled = matrix / unit
    hessian = scaled.T @ scaled
    gradient = -scaled.T @ target
    normals = np.concatenate([contacts[0].facets @ maps[0], -contacts[1].facets @ maps[1]]) / unit
    bounds = np.concatenate(
        [np.zeros(len(contacts[0].facets)), -contacts[1].facets @ (maps[1] @ total)]
    )
    lower = np.full(len(bounds), -1e30)
    sense = np.zeros(len(bounds), dtype=np.int32)
    solution, _, flag, _ = daqp.solve(hessian, gradient, normals, bounds, lower, sense)
    if flag > 0:
        return solution / unit, 0.0
    glued = np.linalg.lstsq(scaled, target, rcond=None)[0] / unit
    return glued, _missing(total, maps, contacts)


def _missing(total: np.ndarray, maps: list[np.ndarray], contacts: tuple[Contact, ...]) -> float:
    """Size of the least wrench [N·m, forces scaled] two feet can't supply together."""
    reference = maps[0]  # distances are measured about the left sole
    rays = [contacts[0].rays, contacts[1].rays @ np.linalg.inv(maps[1]).T @ reference.T]
    return float(nnls(np.concatenate(rays).T, reference @ total)[1])


@dataclass(frozen=True)
class Impact:
    """An inelastic landing: what the velocity loses in an instant.

    Attributes:
        t: Time in the gait's unit.
        side: Foot that lands.
        held: Feet that stick to the floor in the impact.
        foot_velocity: Planned velocity of the landing sole just before [m/s], ``(6,)``
            linear then angular, world axes.
        velocity_jump: Change of the joints' rates [rad/s], shape ``(12,)``.
        impulse: Impulse on each held foot about p_i, world axes: [N·s], [N·m·s],
            shape ``(held, 6)``.
        energy_lost: Kinetic energy lost [J].
    """

    t: float
    side: str
    held: tuple[str, ...]
    foot_velocity: np.ndarray
    velocity_jump: np.ndarray
    impulse: np.ndarray
    energy_lost: float


def touchdown_impact(
    robot: Scout, q: np.ndarray, v: np.ndarray, side: str, t: float = 0.0
) -> Impact:
    """Inelastic landing of a foot, the other one standing.

    The landing sole stops dead. The standing foot is held only while the floor
    pushes it: if its vertical impulse would be negative it is let go. Servos
    give no impulsive torque.

    Args:
        robot: The biped, with a free-flyer root.
        q: Configuration, shape ``(19,)``.
        v: Velocity just before, shape ``(18,)``.
        side: The landing foot.
        t: Time, for the record.

    Returns:
        The impact.
    """
    model, data = robot.model, robot.model.createData()
    other = SIDES[1 - SIDES.index(side)]
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    rows = {
        s: pin.getFrameJacobian(model, data, robot.sole_frames[s], pin.LOCAL_WORLD_ALIGNED).copy()
        for s in SIDES
    }
    for held in ((side, other), (side,)):
        jacobian = np.concatenate([rows[s] for s in held])
        after = np.array(pin.impulseDynamics(model, data, q, v, jacobian, 0.0, 0.0))
        impulse = np.array(data.impulse_c).reshape(-1, 6)
        if len(held) == 1 or impulse[1, 2] >= 0:
            break
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    lost = 0.5 * float(v @ mass @ v - after @ mass @ after)
    return Impact(t, side, held, rows[side] @ v, after[6:] - v[6:], impulse, lost)


def impacts(robot: Scout, gait: Gait, time_unit: float | None = None) -> list[Impact]:
    """Impacts of every touchdown of a gait, from the planned motion just before it."""
    result = []
    for t, side in gait.touchdowns():
        before = np.array([np.nextafter(t, -np.inf)])
        motion = gait.sample(before, time_unit)
        joints = joint_trajectory(robot, motion)
        q, v, _ = free_flyer_state(motion.torso, joints)
        result.append(touchdown_impact(robot, q[0], v[0], side, t))
    return result
