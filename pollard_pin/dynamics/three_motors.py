"""The thesis's form of the torques: three motors for six generalized forces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.specification import ACTUATORS
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import real


@dataclass(frozen=True)
class ThreeTorques:
    """The thesis's form: three base torques for six generalized forces.

    Attributes:
        torque: Least-squares base torques [N·m], shape ``(..., 3)``.
        generalized_force: Q in (x, y, z, ψ, θ, φ) [N], [N·m], shape ``(..., 6)``.
        missing: Q − J_τᵀ τ, which three motors can't supply, shape ``(..., 6)``.
        share: |missing| / |Q|, lengths in ``length``, shape ``(...)``.
    """

    torque: np.ndarray
    generalized_force: np.ndarray
    missing: np.ndarray
    share: np.ndarray


def three_torques(jacobian: ArrayLike, joint_force: ArrayLike, length: float = 1.0) -> ThreeTorques:
    """Best three base torques, and what they leave unexplained.

    (3.152) is Q = J_τᵀ τ with a 6×3 matrix; (3.154) writes its inverse, which doesn't
    exist. The least-squares solution is the nearest thing, with forces weighed
    against moments by a length.

    Args:
        jacobian: Joint rates over (ẋ, ẏ, ż, ψ̇, θ̇, φ̇), ``Pollard.rate_jacobian(q)``,
            shape ``(..., 12, 6)``.
        joint_force: RNEA's torques of the open tree [N·m], shape ``(..., 12)``.
        length: Length that turns forces into moments [m]; 1 takes the SI numbers as they are.

    Source: Pollard thesis, (3.151)–(3.154).
    """
    matrix = finite_array("jacobian", jacobian, 12, 6)
    length = real("length", length, low=1e-6, unit="m")
    force = np.einsum("...ji,...j->...i", matrix, finite_array("joint_force", joint_force, 12))
    rows = np.swapaxes(matrix[..., list(ACTUATORS[:3]), :], -1, -2)
    scale = np.array([length] * 3 + [1.0] * 3)
    weighed = rows * scale[:, None]
    torque = np.einsum("...ij,...j->...i", np.linalg.pinv(weighed), force * scale)
    missing = force - np.einsum("...ij,...j->...i", rows, torque)
    size = np.linalg.norm(force * scale, axis=-1)
    share = np.linalg.norm(missing * scale, axis=-1) / np.where(size > 0, size, 1.0)
    return ThreeTorques(torque, force, missing, share)
