"""How two feet share a load: a small quadratic programme over their wrench cones."""

from __future__ import annotations

import daqp
import numpy as np

from thesis_pin.contacts.cones import Contact
from thesis_pin.numeric.arrays import skew

Pair = tuple[np.ndarray, np.ndarray]
"""The same quantity of both feet."""


def share_load(
    contacts: tuple[Contact, Contact],
    jacobians: Pair,
    maps: Pair,
    torques: Pair,
    total: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Both feet's wrenches with the least sum of squared joint torques, each in its cone.

    Where no admissible pair exists the same rule holds without the cones.

    Args:
        contacts: What the floor can do to each foot.
        jacobians: Torques [N·m] that a unit wrench on a foot, about the base's origin,
            takes off its leg's joints (transposed Jacobians), each ``(n, joints, 6)``.
        maps: From such wrenches to scaled wrenches of the sole, each ``(n, 6, 6)``; see
            :func:`scaled_sole_maps`.
        torques: Torques of each leg's joints without a floor [N·m], each ``(n, joints)``.
        total: Wrench that both feet supply together, about the base's origin, ``(n, 6)``.

    Returns:
        Wrenches about the base's origin, ``(n, 2, 6)``, and the least wrench that is
        missing [N·m, forces scaled], ``(n,)``, zero where the floor can supply it.
    """
    # First foot's wrench w with least |τ|², the second one carrying the rest:
    # τ_1 = τ − J_1ᵀ w and τ_2 = τ − J_2ᵀ (W − w). Columns are scaled like the
    # wrench, so that the programme works in N·m throughout.
    unit = np.repeat([contacts[0].length, 1.0], 3)
    matrix = np.concatenate([jacobians[0], -jacobians[1]], axis=1) / unit
    carried = np.einsum("nij,nj->ni", jacobians[1], total)
    target = np.concatenate([torques[0], torques[1] - carried], axis=1)
    all_on_second = np.einsum("nij,nj->ni", maps[1], total)
    count = len(total)
    violation, first = np.zeros(count), np.empty((count, 6))
    programme = _Programme(contacts)
    for row in range(count):
        found = programme.solve(
            matrix[row], target[row], maps[0][row] / unit, maps[1][row] / unit, all_on_second[row]
        )
        if found is None:
            found = np.linalg.lstsq(matrix[row], target[row], rcond=None)[0]
            violation[row] = _missing(total[row], (maps[0][row], maps[1][row]), contacts)
        first[row] = found / unit
    return np.stack([first, total - first], axis=1), violation


def scaled_sole_maps(rotation: np.ndarray, sole: np.ndarray, length: float) -> np.ndarray:
    """Maps from wrenches about the base's origin to scaled wrenches of a sole.

    Args:
        rotation: From the base's axes to the sole's, shape ``(n, 3, 3)``.
        sole: Origin of the sole in the base's frame [m], shape ``(n, 3)``.
        length: That of its :class:`Contact` [m].

    Returns:
        Shape ``(n, 6, 6)``.
    """
    result = np.zeros((len(sole), 6, 6))
    result[:, :3, :3] = length * rotation
    result[:, 3:, :3], result[:, 3:, 3:] = -rotation @ skew(sole), rotation
    return result


class _Programme:
    """The quadratic programme of one sample; its large arrays are filled anew each time."""

    def __init__(self, contacts: tuple[Contact, Contact]) -> None:
        self.one, self.other = contacts[0].facets, contacts[1].facets
        count, self.first = len(self.one) + len(self.other), len(self.one)
        self.normals, self.bounds = np.empty((count, 6)), np.zeros(count)
        self.lower, self.sense = np.full(count, -1e30), np.zeros(count, dtype=np.int32)

    def solve(
        self,
        matrix: np.ndarray,
        target: np.ndarray,
        first_map: np.ndarray,
        second_map: np.ndarray,
        all_on_second: np.ndarray,
    ) -> np.ndarray | None:
        """The scaled w with least |target − matrix w|² and both feet in their cones, or None."""
        np.matmul(self.one, first_map, out=self.normals[: self.first])
        np.matmul(self.other, -second_map, out=self.normals[self.first :])
        np.matmul(self.other, -all_on_second, out=self.bounds[self.first :])
        self.sense[:] = 0
        solution, _, flag, _ = daqp.solve(
            matrix.T @ matrix, -matrix.T @ target, self.normals, self.bounds, self.lower, self.sense
        )
        return solution if flag > 0 else None


def _missing(total: np.ndarray, maps: Pair, contacts: tuple[Contact, Contact]) -> float:
    """Size of the least wrench [N·m, forces scaled] two feet can't supply together."""
    from scipy.optimize import nnls

    reference = maps[0]  # distances are measured about the first sole
    rays = [contacts[0].rays, contacts[1].rays @ np.linalg.inv(maps[1]).T @ reference.T]
    return float(nnls(np.concatenate(rays).T, reference @ total)[1])
