"""Which foot carries what: trivial on one foot, a small quadratic programme on two."""

from __future__ import annotations

import daqp
import numpy as np

from scout_pin.kinematics.forward import leg_frames
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.contacts.cones import Contact
from thesis_pin.numeric.arrays import skew
from thesis_pin.numeric.trajectory import JointTrajectory


def share_load(
    robot: Scout,
    motion: GaitMotion,
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
    lengths = (contacts[0].length, contacts[1].length)
    jacobians, maps = [], []
    for k, foot in enumerate((motion.left_foot, motion.right_foot)):
        # Transposed leg Jacobians and maps to scaled sole wrenches, of wrenches
        # about the torso's origin.
        frames = leg_frames(robot.legs[SIDES[k]], joints.q[double, 6 * k : 6 * k + 6])
        axes, points = (x.transpose(2, 0, 1) for x in (frames.axes, frames.points))
        jacobians.append(np.concatenate([np.cross(points, axes), axes], axis=2))
        turn = np.swapaxes(foot.rotation[double], 1, 2) @ motion.torso.rotation[double]
        maps.append(_to_scaled_sole(turn, frames.sole.T, lengths[k]))
    total = forces[double, :6]
    # Left foot's wrench w with least |τ|², the right one carrying the rest:
    # τ_left = τ − J_leftᵀ w and τ_right = τ − J_rightᵀ (W − w). Columns are scaled
    # like the wrench, so that the programme works in N·m throughout.
    unit = np.repeat([lengths[0], 1.0], 3)
    matrix = np.concatenate([jacobians[0], -jacobians[1]], axis=1) / unit
    carried = np.einsum("nij,nj->ni", jacobians[1], total)
    target = np.concatenate([forces[double, 6:12], forces[double, 12:18] - carried], axis=1)
    all_on_right = np.einsum("nij,nj->ni", maps[1], total)
    violation = np.zeros(len(double))
    left = np.empty((len(double), 6))
    programme = _Programme(contacts)
    for row in range(len(double)):
        found = programme.solve(
            matrix[row], target[row], maps[0][row] / unit, maps[1][row] / unit, all_on_right[row]
        )
        if found is None:
            found = np.linalg.lstsq(matrix[row], target[row], rcond=None)[0]
            violation[row] = _missing(total[row], [maps[0][row], maps[1][row]], contacts)
        left[row] = found / unit
    return np.stack([left, total - left], axis=1), violation


def _to_scaled_sole(rotation: np.ndarray, sole: np.ndarray, length: float) -> np.ndarray:
    """Maps from wrenches about the torso's origin to scaled wrenches of the sole, ``(n, 6, 6)``."""
    result = np.zeros((len(sole), 6, 6))
    result[:, :3, :3] = length * rotation
    result[:, 3:, :3], result[:, 3:, 3:] = -rotation @ skew(sole), rotation
    return result


class _Programme:
    """The quadratic programme of one sample; its large arrays are filled anew each time."""

    def __init__(self, contacts: tuple[Contact, Contact]) -> None:
        self.left, self.right = contacts[0].facets, contacts[1].facets
        count, self.first = len(self.left) + len(self.right), len(self.left)
        self.normals, self.bounds = np.empty((count, 6)), np.zeros(count)
        self.lower, self.sense = np.full(count, -1e30), np.zeros(count, dtype=np.int32)

    def solve(
        self,
        matrix: np.ndarray,
        target: np.ndarray,
        left_map: np.ndarray,
        right_map: np.ndarray,
        all_on_right: np.ndarray,
    ) -> np.ndarray | None:
        """The scaled w with least |target − matrix w|² and both feet in their cones, or None."""
        np.matmul(self.left, left_map, out=self.normals[: self.first])
        np.matmul(self.right, -right_map, out=self.normals[self.first :])
        np.matmul(self.right, -all_on_right, out=self.bounds[self.first :])
        self.sense[:] = 0
        solution, _, flag, _ = daqp.solve(
            matrix.T @ matrix, -matrix.T @ target, self.normals, self.bounds, self.lower, self.sense
        )
        return solution if flag > 0 else None


def _missing(total: np.ndarray, maps: list[np.ndarray], contacts: tuple[Contact, ...]) -> float:
    """Size of the least wrench [N·m, forces scaled] two feet can't supply together."""
    from scipy.optimize import nnls

    reference = maps[0]  # distances are measured about the left sole
    rays = [contacts[0].rays, contacts[1].rays @ np.linalg.inv(maps[1]).T @ reference.T]
    return float(nnls(np.concatenate(rays).T, reference @ total)[1])
