"""How two feet share a load: a small quadratic programme over their wrench cones."""

from __future__ import annotations

from dataclasses import dataclass

import daqp
import numpy as np

from thesis_pin.contacts.cones import Contact
from thesis_pin.numeric.arrays import skew
from thesis_pin.numeric.elementwise import blocks

Pair = tuple[np.ndarray, np.ndarray]
"""The same quantity of both feet."""

_AT_ONCE = 128  # samples whose wrenches are held against some hundred facets


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
    return LoadSharing.of(contacts, jacobians, maps, torques, total).solve()


@dataclass(frozen=True)
class LoadSharing:
    """The problem of many samples: |target − matrix w|² as small as the two cones allow.

    w is the first foot's wrench, forces scaled to moments; the second foot carries the rest
    of the total W: τ_1 = τ − J_1ᵀ w and τ_2 = τ − J_2ᵀ (W − w).

    Attributes:
        contacts: What the floor can do to each foot.
        matrix: Shape ``(n, joints, 6)``.
        target: Torques if the second foot carried everything [N·m], ``(n, joints)``.
        maps: From wrenches scaled like w to scaled wrenches of each sole, ``(n, 6, 6)``.
        total: Wrench of both feet, scaled like w, ``(n, 6)``.
    """

    contacts: tuple[Contact, Contact]
    matrix: np.ndarray
    target: np.ndarray
    maps: Pair
    total: np.ndarray

    @classmethod
    def of(
        cls,
        contacts: tuple[Contact, Contact],
        jacobians: Pair,
        maps: Pair,
        torques: Pair,
        total: np.ndarray,
    ) -> LoadSharing:
        """From the arguments of :func:`share_load`."""
        # Columns are scaled like the wrench, so that all is in N·m throughout.
        unit = _unit(contacts)
        matrix = np.concatenate([jacobians[0], -jacobians[1]], axis=1) / unit
        carried = np.einsum("nij,nj->ni", jacobians[1], total)
        target = np.concatenate([torques[0], torques[1] - carried], axis=1)
        return cls(contacts, matrix, target, (maps[0] / unit, maps[1] / unit), total * unit)

    def with_load(self, torques: Pair, total: np.ndarray) -> LoadSharing:
        """The same poses with other torques and another total wrench; see :meth:`of`."""
        scaled, second = total * _unit(self.contacts), torques[0].shape[1]
        carried = -np.einsum("nij,nj->ni", self.matrix[:, second:], scaled)
        target = np.concatenate([torques[0], torques[1] - carried], axis=1)
        return LoadSharing(self.contacts, self.matrix, target, self.maps, scaled)

    def plus(self, other: LoadSharing, share: float, row: int) -> LoadSharing:
        """One sample with a share of another load of the same poses added to its own."""
        one = slice(row, row + 1)
        return LoadSharing(
            self.contacts,
            self.matrix[one],
            self.target[one] + share * other.target[one],
            (self.maps[0][one], self.maps[1][one]),
            self.total[one] + share * other.total[one],
        )

    def torques(self, w: np.ndarray) -> np.ndarray:
        """Joint torques for given w, ``(n, 6)`` → ``(n, joints)``."""
        return np.asarray(self.target - np.einsum("nij,nj->ni", self.matrix, w))

    def without_limits(self) -> np.ndarray:
        """The w with the least torques if the floor could do anything, ``(n, 6)``."""
        turned, target = np.swapaxes(self.matrix, 1, 2), self.target[:, :, None]
        try:
            found = np.linalg.solve(turned @ self.matrix, turned @ target)
        except np.linalg.LinAlgError:  # legs that are stretched alike
            found = np.linalg.pinv(self.matrix) @ target
        return np.asarray(found[:, :, 0])

    def beyond_limits(self, w: np.ndarray, part: slice) -> np.ndarray:
        """By what given w passes each facet of both cones; linear in w and the load.

        Args:
            w: Shape ``(n, 6)``.
            part: Some of the samples.

        Returns:
            Shape ``(m, facets)``, at most zero inside.
        """
        soles = [
            np.einsum("nij,nj->ni", maps[part], load[part])
            for maps, load in zip(self.maps, (w, self.total - w), strict=True)
        ]
        return np.concatenate(
            [sole @ c.facets.T for sole, c in zip(soles, self.contacts, strict=True)], axis=1
        )

    def solve(self) -> tuple[np.ndarray, np.ndarray]:
        """What :func:`share_load` returns."""
        count, unit = len(self.total), _unit(self.contacts)
        violation, first = np.zeros(count), np.empty((count, 6))
        if count:
            first = self.without_limits()
        programme = _Programme(self.contacts)
        for row in self._limited(first):
            found = programme.solve(self, row)
            if found is None:
                found = np.linalg.lstsq(self.matrix[row], self.target[row], rcond=None)[0]
                violation[row] = _missing(
                    self.total[row], (self.maps[0][row], self.maps[1][row]), self.contacts
                )
            first[row] = found
        return np.stack([first, self.total - first], axis=1) / unit, violation

    def least_torques(self) -> np.ndarray | None:
        """Torques of a single sample ``(joints,)``; None if no pair of wrenches is admissible."""
        found = _Programme(self.contacts).solve(self, 0)
        return None if found is None else self.torques(found[None])[0]

    def _limited(self, free: np.ndarray) -> list[int]:
        """Samples whose least torques without limits take a sole beyond its cone."""
        result: list[int] = []
        for part in blocks(len(free), _AT_ONCE):
            beyond = (self.beyond_limits(free, part) > 0).any(axis=1)
            result += (part.start + np.flatnonzero(beyond)).tolist()
        return result


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

    def solve(self, problem: LoadSharing, row: int) -> np.ndarray | None:
        """The w of one sample, or None if no pair of wrenches is admissible."""
        matrix, target = problem.matrix[row], problem.target[row]
        second_map, total = problem.maps[1][row], problem.total[row]
        np.matmul(self.one, problem.maps[0][row], out=self.normals[: self.first])
        np.matmul(self.other, -second_map, out=self.normals[self.first :])
        np.matmul(self.other, -(second_map @ total), out=self.bounds[self.first :])
        self.sense[:] = 0
        solution, _, flag, _ = daqp.solve(
            matrix.T @ matrix, -matrix.T @ target, self.normals, self.bounds, self.lower, self.sense
        )
        return solution if flag > 0 else None


def _unit(contacts: tuple[Contact, Contact]) -> np.ndarray:
    """Scales of a wrench's components, ``(6,)``."""
    return np.repeat([contacts[0].length, 1.0], 3)


def _missing(total: np.ndarray, maps: Pair, contacts: tuple[Contact, Contact]) -> float:
    """Size of the least wrench [N·m, forces scaled] two feet can't supply together."""
    from scipy.optimize import nnls

    reference = maps[0]  # distances are measured about the first sole
    rays = [contacts[0].rays, contacts[1].rays @ np.linalg.inv(maps[1]).T @ reference.T]
    return float(nnls(np.concatenate(rays).T, reference @ total)[1])
