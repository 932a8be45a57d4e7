"""Which foot carries what: trivial on one foot, a small quadratic programme on two."""

from __future__ import annotations

import daqp
import numpy as np
from scipy.optimize import nnls

from scout_pin.contact import Contact
from scout_pin.forward import leg_frames
from scout_pin.gait import Motion
from scout_pin.model import Scout
from scout_pin.specification import SIDES
from thesis_pin.trajectory import JointTrajectory


def share_load(
    robot: Scout,
    motion: Motion,
    joints: JointTrajectory,
    forces: np.ndarray,
    double: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Each foot's wrench where both stand, and the least wrench that is missing.

    Args:
        robot: The biped.
        motion: The sampled gait.
        joints: Its joint trajectory.
        forces: RNEA of the free-flying robot, shape ``(n, 18)``.
        double: Samples in double support, shape ``(m,)``.

    Returns:
        Wrenches about the torso's origin in its axes, ``(m, 2, 6)``, and their
        violation [N·m, forces scaled], ``(m,)``.
    """
    contacts = robot.contacts
    shares, violation = np.empty((len(double), 2, 6)), np.empty(len(double))
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
        left, violation[row] = _least_torque(forces[sample], jacobians, maps, contacts)
        shares[row, 0], shares[row, 1] = left, forces[sample, :6] - left
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
