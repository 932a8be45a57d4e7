"""How two feet share a load: a small quadratic programme over their wrench cones."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.polar import beyond_cone
from thesis_pin.contacts.programme import ConeProgramme, Held
from thesis_pin.display.brief import Brief
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
    return LoadSharing.of(contacts, jacobians, maps, torques, total).solve()


@dataclass(frozen=True)
class LoadSharing(Brief):
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

    def plus(self, other: LoadSharing, share: float, rows: np.ndarray) -> LoadSharing:
        """Some samples with a share of another load of the same poses added to their own."""
        return LoadSharing(
            self.contacts,
            self.matrix[rows],
            self.target[rows] + share * other.target[rows],
            (self.maps[0][rows], self.maps[1][rows]),
            self.total[rows] + share * other.total[rows],
        )

    def torques(self, w: np.ndarray) -> np.ndarray:
        """Joint torques for given w, ``(n, 6)`` → ``(n, joints)``."""
        return np.asarray(self.target - np.einsum("nij,nj->ni", self.matrix, w))

    @cached_property
    def programme(self) -> ConeProgramme:
        """The same problem by its normal equations."""
        turned = np.swapaxes(self.matrix, 1, 2)
        one, other = self.contacts
        whole = np.matmul(self.maps[1], self.total[:, :, None])[:, :, 0]
        return ConeProgramme(
            turned @ self.matrix,
            np.matmul(turned, self.target[:, :, None])[:, :, 0],
            (
                Held(one.facets, self.maps[0], np.zeros_like(whole)),
                Held(other.facets, -self.maps[1], whole),
            ),
        )

    def without_limits(self) -> np.ndarray:
        """The w with the least torques if the floor could do anything, ``(n, 6)``."""
        try:
            found = np.linalg.solve(self.programme.hessian, self.programme.gradient[:, :, None])
        except np.linalg.LinAlgError:  # legs that are stretched alike
            found = np.linalg.pinv(self.matrix) @ self.target[:, :, None]
        return np.asarray(found[:, :, 0])

    def beyond_limits(self, w: np.ndarray, part: slice) -> np.ndarray:
        """By what given w passes each facet of both cones; linear in w and the load.

        Args:
            w: Shape ``(n, 6)``.
            part: Some of the samples.

        Returns:
            Shape ``(m, facets)``, at most zero inside.
        """
        cones = self.programme.cones
        return np.concatenate([cone.beyond(w[part], part) for cone in cones], axis=1)

    def solve(self) -> tuple[np.ndarray, np.ndarray]:
        """What :func:`share_load` returns."""
        unit, violation = _unit(self.contacts), np.zeros(len(self.total))
        first, possible = self.programme.least(self.without_limits())
        for row in np.flatnonzero(~possible):
            violation[row] = _missing(
                self.total[row], (self.maps[0][row], self.maps[1][row]), self.contacts
            )
        return np.stack([first, self.total - first], axis=1) / unit, violation

    def least_torques(self) -> tuple[np.ndarray, np.ndarray]:
        """Torques ``(n, joints)``, and whether any pair of wrenches is admissible ``(n,)``.

        Torques are NaN where none is.
        """
        found, possible = self.programme.solve(np.arange(len(self.total)))
        return self.torques(found), possible


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


def _unit(contacts: tuple[Contact, Contact]) -> np.ndarray:
    """Scales of a wrench's components, ``(6,)``."""
    return np.repeat([contacts[0].length, 1.0], 3)


def _missing(total: np.ndarray, maps: Pair, contacts: tuple[Contact, Contact]) -> float:
    """Size of the least wrench [N·m, forces scaled] two feet can't supply together."""
    reference = maps[0]  # distances are measured about the first sole
    rays = [contacts[0].rays, contacts[1].rays @ np.linalg.inv(maps[1]).T @ reference.T]
    rest, _ = beyond_cone(np.concatenate(rays).T, reference @ total)
    return float(np.linalg.norm(rest))
