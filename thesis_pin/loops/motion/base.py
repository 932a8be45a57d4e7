"""Columns of a free root: where it is, and how it is turned."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.tables.table import Column, Table

Array = NDArray[np.float64]

BASE_PLACE = ("base_x", "base_y", "base_z")
BASE_ANGLES = ("base_roll", "base_pitch", "base_yaw")
BASE_QUATERNION = ("base_qx", "base_qy", "base_qz", "base_qw")


@dataclass(frozen=True, eq=False)
class Flight:
    """A free root over time.

    Attributes:
        turns: The columns of its orientation: three angles, or a quaternion.
        base: Places and quaternions x, y, z, w, shape ``(n, 7)``.
    """

    turns: tuple[str, ...]
    base: Array


def read_flight(values: Mapping[tuple[str, int], Column], table: Table) -> Flight | None:
    """The root's placement over time; None if no column says it.

    Args:
        values: Columns by what they hold and which derivative it is.
        table: Where they stand, for messages.

    Raises:
        BadInput: Columns are missing, or a quaternion isn't of unit length.
    """
    from scipy.spatial.transform import Rotation

    parts = [of for of, _ in values if of in (*BASE_PLACE, *BASE_ANGLES, *BASE_QUATERNION)]
    if not parts:
        return None
    angles = [part for part in parts if part in BASE_ANGLES]
    wanted = {*BASE_PLACE, *(BASE_ANGLES if angles else BASE_QUATERNION)}
    if set(parts) != wanted:
        raise BadInput(
            f"the base has the columns {', '.join(parts)}",
            where=table.file,
            allowed=f"{', '.join(BASE_PLACE)} and {', '.join(BASE_ANGLES)}, or these and "
            f"{', '.join(BASE_QUATERNION)} instead of angles",
        )
    place = np.empty((len(table), 7))
    place[:, :3] = np.column_stack([values[part, 0].values for part in BASE_PLACE])
    if angles:
        turns = np.column_stack([values[part, 0].values for part in BASE_ANGLES])
        place[:, 3:] = Rotation.from_euler("xyz", turns).as_quat()
        return Flight(BASE_ANGLES, place)
    quaternion = np.column_stack([values[part, 0].values for part in BASE_QUATERNION])
    length = np.linalg.norm(quaternion, axis=1)
    if (np.abs(length - 1) > 1e-3).any():
        k = int(np.argmax(np.abs(length - 1)))
        raise BadInput(
            f"the quaternion of the base has length {length[k]:.6g}",
            where=table.where(k),
            allowed="1",
        )
    place[:, 3:] = quaternion / length[:, None]
    return Flight(BASE_QUATERNION, place)
