"""Orientations as CAM, robots and converters write them.

Ours is Rx(θ) Ry(ψ) Rz(φ), which SciPy and others call the order XYZ of the angles θ, ψ, φ.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from pollard_pin.coordinates import pose_rotation
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown
from thesis_pin.tolerances import TOLERANCES

OURS = "Rx(θ) Ry(ψ) Rz(φ)"
"""How ψ, θ and φ make an orientation."""

_ORDER = re.compile(r"([XYZ])(?!\1)([XYZ])(?!\2)([XYZ])")


def check_order(order: object) -> str:
    """An order of Euler angles: three axes, capitals about the turned axes, small about fixed ones.

    Raises:
        BadInput: It is none.
    """
    text = order if isinstance(order, str) else ""
    if not _ORDER.fullmatch(text.upper()) or text not in (text.upper(), text.lower()):
        raise BadInput(
            f"the order of the angles is {shown(order)}",
            allowed="three axes, no two neighbours alike, as ZYX (about the turned axes, one after "
            "the other) or xyz (about the fixed axes)",
            remedy=f"psi, theta and phi are ours: {OURS}",
        )
    return text


def said_order(order: str, names: Sequence[str]) -> str:
    """An order of Euler angles as a product: ``"ZYX"`` and a, b, c → ``"Rz(a) Ry(b) Rx(c)"``."""
    turns = [f"R{axis}({name})" for axis, name in zip(order.lower(), names, strict=True)]
    return " ".join(turns if order.isupper() else turns[::-1])


def from_euler(order: str, angles: np.ndarray) -> np.ndarray:
    """Orientations of Euler angles in the order of their letters [rad], ``(n, 3)``."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_euler(check_order(order), angles).as_matrix())


def from_rotation_vectors(vectors: np.ndarray) -> np.ndarray:
    """Orientations of rotation vectors, axis times angle [rad], ``(n, 3)``."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_rotvec(vectors).as_matrix())


def from_angles(angles: np.ndarray) -> np.ndarray:
    """Orientations of ψ, θ, φ [rad], ``(n, 3)``."""
    return pose_rotation(np.pad(angles, ((0, 0), (3, 0))))


def not_unit(quaternions: np.ndarray) -> int | None:
    """Number of the first quaternion that isn't of unit length within rounding, if any is."""
    length = np.linalg.norm(quaternions, axis=-1)
    off = ~(np.abs(length - 1.0) <= TOLERANCES.quaternion_length)
    return int(np.argmax(off)) if off.any() else None


def from_quaternions(quaternions: np.ndarray) -> np.ndarray:
    """Orientations of quaternions x, y, z, w of nearly unit length, ``(n, 4)``; any sign."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_quat(quaternions).as_matrix())
