"""Orientations as CAM, robots and converters write them, by the names of their columns.

Ours is Rx(θ) Ry(ψ) Rz(φ), which SciPy and others call the order XYZ of the angles θ, ψ, φ.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown
from thesis_pin.tables.table import Table
from thesis_pin.tables.units import ANGLE, PLAIN
from thesis_pin.tolerances import TOLERANCES

FORMS = {
    ("psi", "theta", "phi"): ANGLE,
    ("qx", "qy", "qz", "qw"): PLAIN,
    ("rx", "ry", "rz"): ANGLE,
    ("roll", "pitch", "yaw"): ANGLE,
    ("a", "b", "c"): ANGLE,
}
"""Columns that hold an orientation: one of these sets, and the units of its columns."""

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
    return from_euler("XYZ", angles[:, [1, 0, 2]])


def not_unit(quaternions: np.ndarray) -> int | None:
    """Number of the first quaternion that isn't of unit length within rounding, if any is."""
    length = np.linalg.norm(quaternions, axis=-1)
    off = ~(np.abs(length - 1.0) <= TOLERANCES.quaternion_length)
    return int(np.argmax(off)) if off.any() else None


def from_quaternions(quaternions: np.ndarray) -> np.ndarray:
    """Orientations of quaternions x, y, z, w of nearly unit length, ``(n, 4)``; any sign."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_quat(quaternions).as_matrix())


def oriented(
    table: Table, form: tuple[str, ...], values: np.ndarray, euler: str | None
) -> tuple[np.ndarray, list[str]]:
    """Orientations of the columns of a form, and what has to be said of them.

    Args:
        table: Where they stand, for messages.
        form: One of :data:`FORMS`.
        values: Of its columns, in SI, shape ``(n, 3)`` or ``(n, 4)``.
        euler: Order of the angles in columns a, b, c or rx, ry, rz; see :func:`check_order`.

    Returns:
        Shape ``(n, 3, 3)``, and whole sentences.

    Raises:
        BadInput: An order is missing, or means nothing here; a quaternion isn't of unit length.
    """
    names = ", ".join(form)
    kind = form[0]
    if kind in ("rx", "a") and euler is not None:
        if kind == "a":
            return from_euler(euler, values), [f"{names} are read as {said_order(euler, form)}"]
        places = ["xyz".index(letter) for letter in euler.lower()]
        if len({*places}) < 3:
            raise BadInput(
                f"{names} are angles about three axes, and the order {euler} takes one twice",
                where=table.file,
                remedy="Call the columns a, b and c, in the order of its letters",
            )
        said = said_order(euler, [form[place] for place in places])
        return from_euler(euler, values[:, places]), [f"{names} are read as {said}"]
    if euler is not None:
        reason = f"are ours: {OURS}" if kind == "psi" else "have no order to choose"
        raise BadInput(
            f"an order of angles is given ({euler}), and {names} {reason}",
            where=table.file,
            remedy="Leave the order out, or call the angles a, b and c in the order of its letters",
        )
    if kind == "psi":
        return from_angles(values), []
    if kind == "qx":
        off = not_unit(values)
        if off is not None:
            raise BadInput(
                f"the quaternion's length is {np.linalg.norm(values[off]):.6g}",
                where=table.where(off),
                allowed="unit quaternions, 1 up to rounding",
                remedy="Columns qx, qy, qz, qw hold one, qw its real part",
            )
        return from_quaternions(values), []
    if kind == "roll":
        return from_euler("xyz", values), [f"{names} are read as Rz(yaw) Ry(pitch) Rx(roll)"]
    if kind == "rx":
        return from_rotation_vectors(values), [
            f"{names} are read as a rotation vector, its axis times its angle; "
            "an order of angles (euler) reads them otherwise"
        ]
    raise BadInput(
        f"nothing says in which order the angles {names} turn",
        where=table.file,
        allowed="an order as ZYX (euler), the first letter's angle in a",
        remedy=f"psi, theta and phi are ours: {OURS}",
    )
