"""Names and rotations of MuJoCo's compiled model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.model.formats.cutting import fresh
from thesis_pin.model.mechanism.description import Array

if TYPE_CHECKING:
    import mujoco


def names_of(model: mujoco.MjModel, kind: str, count: int) -> list[str]:
    """A name for each body or joint, no two alike."""
    names: dict[str, None] = {}
    given = [name_at(model, getattr(model, f"name_{kind}adr")[k]) for k in range(count)]
    for k, name in enumerate(given):
        names[name or fresh(f"{'joint' if kind == 'jnt' else kind}{k}", {*names, *given})] = None
    return list(names)


def name_at(model: mujoco.MjModel, address: int) -> str:
    """The name that stands at an address; empty if there is none."""
    text: bytes = model.names
    return text[address : text.index(b"\0", address)].decode("utf-8", "replace")


def turned(quaternion: Array) -> Array:
    """Rotation of a quaternion w, x, y, z, shape ``(3, 3)``."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def about(axis: Array, angle: float) -> Array:
    """Rotation about an axis of length 1 [rad], shape ``(3, 3)``."""
    return turned(np.r_[np.cos(angle / 2), np.sin(angle / 2) * axis])
