"""Columns of a free root: where it is, how it is turned, and how both change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.loops.motion.sampled import unlike, with_derivatives
from thesis_pin.numeric.quaternions import unbroken
from thesis_pin.tables.table import Column, Table

Array = NDArray[np.float64]

BASE_PLACE = ("base_x", "base_y", "base_z")
BASE_ANGLES = ("base_roll", "base_pitch", "base_yaw")
BASE_QUATERNION = ("base_qx", "base_qy", "base_qz", "base_qw")
BASE_PARTS = (*BASE_PLACE, *BASE_ANGLES, *BASE_QUATERNION)


@dataclass(frozen=True, eq=False)
class Flight:
    """A free root, or a frame, over time.

    Attributes:
        turns: The columns of its orientation: three angles, or a quaternion; of a frame also one
            angle, or none.
        base: Places and quaternions x, y, z, w, shape ``(n, 7)``.
        change: Their first and second derivatives, each ``(n, 7)``, as far as columns hold
            them; those of ``base``, whose quaternions then don't change sign.
        place: The columns of its place.
    """

    turns: tuple[str, ...]
    base: Array
    change: tuple[Array | None, Array | None] = (None, None)
    place: tuple[str, ...] = BASE_PLACE

    def derivatives(self, time: Array) -> tuple[Array, Array] | None:
        """Both derivatives, the second of a spline through the first if need be.

        Args:
            time: Sample times [s], shape ``(n,)``.

        Returns:
            None if no column holds any.
        """
        first, second = self.change
        if first is None:
            return None
        if second is None:
            made = [with_derivatives(time, column, column, None)[1] for column in first.T]
            second = np.column_stack(made)
        return first, second


def read_flight(values: Mapping[tuple[str, int], Column], table: Table) -> Flight | None:
    """The root's placement over time; None if no column says it.

    Args:
        values: Columns by what they hold and which derivative it is.
        table: Where they stand, for messages.

    Raises:
        BadInput: Columns are missing, or a quaternion isn't of unit length.
    """
    from scipy.spatial.transform import Rotation

    parts = [of for of, order in values if order == 0 and of in BASE_PARTS]
    if not parts:
        return None
    angles = any(part in BASE_ANGLES for part in parts)
    turns = BASE_ANGLES if angles else BASE_QUATERNION
    wanted = (*BASE_PLACE, *turns)
    if set(parts) != set(wanted):
        raise BadInput(
            f"the base has the columns {', '.join(parts)}",
            where=table.file,
            allowed=f"{', '.join(BASE_PLACE)} and {', '.join(BASE_ANGLES)}, or these and "
            f"{', '.join(BASE_QUATERNION)} instead of angles",
        )
    known = [np.column_stack([values[part, 0].values for part in wanted])]
    for order, word in ((1, "rate"), (2, "acceleration")):
        missing = [f"{part}_{word}" for part in wanted if (part, order) not in values]
        if len(missing) == len(wanted):
            break
        if missing:
            raise BadInput(
                f"columns of the base are missing: {', '.join(missing)}",
                where=table.file,
                allowed=f"the {word} of all of {', '.join(wanted)}, or of none",
            )
        known.append(np.column_stack([values[part, order].values for part in wanted]))
    base = known[0][:, :3]
    if angles:
        turned = Rotation.from_euler("xyz", known[0][:, 3:]).as_quat()
        moving = _turning(known)
    else:
        length = np.linalg.norm(known[0][:, 3:], axis=1)
        if (np.abs(length - 1) > 1e-3).any():
            k = int(np.argmax(np.abs(length - 1)))
            raise BadInput(
                f"the quaternion of the base has length {length[k]:.6g}",
                where=table.where(k),
                allowed="1",
            )
        turned = known[0][:, 3:] / length[:, None]
        moving = [one[:, 3:] / length[:, None] for one in known]
    change: list[Array | None] = [None, None]
    if len(known) > 1:
        turned = unbroken(turned)
        sign = np.sign((turned * moving[0]).sum(axis=1))[:, None]
        for order in range(1, len(known)):
            change[order - 1] = np.column_stack([known[order][:, :3], sign * moving[order]])
    return Flight(turns, np.column_stack([base, turned]), (change[0], change[1]))


def odd_rates(values: Mapping[tuple[str, int], Column], time: Array) -> list[str]:
    """Warnings where rates of the root aren't the derivatives of the columns before them.

    Args:
        values: Columns by what they hold and which derivative it is.
        time: Sample times [s], shape ``(n,)``.
    """
    sign = np.ones(len(time))
    if all((part, 0) in values for part in BASE_QUATERNION):  # q and -q are one rotation
        given = np.column_stack([values[part, 0].values for part in BASE_QUATERNION])
        sign = np.where((unbroken(given) * given).sum(axis=1) < 0, -1.0, 1.0)
    warnings = []
    for part in BASE_PARTS:
        columns = [values[part, order] for order in range(3) if (part, order) in values]
        if part in BASE_QUATERNION:
            columns = [replace(one, values=sign * one.values) for one in columns]
        elif part in BASE_ANGLES and columns:
            columns[0] = replace(columns[0], values=np.unwrap(columns[0].values))
        warnings += unlike(part, time, columns)
    return warnings


def _turning(known: Sequence[Array]) -> list[Array]:
    """The quaternion of turns about the world's x, then y, then z, and its derivatives.

    Args:
        known: Angles and as many of their derivatives as there are, in the last three columns.

    Returns:
        As many, each ``(n, 4)``.
    """
    found: list[Array] = []
    for axis in range(3):
        angle = known[0][:, 3 + axis]
        rates = [one[:, 3 + axis, None] for one in known[1:]]
        one = np.zeros((len(angle), 4))
        one[:, axis], one[:, 3] = np.sin(angle / 2), np.cos(angle / 2)
        along = np.zeros_like(one)  # its derivative by half the angle
        along[:, axis], along[:, 3] = np.cos(angle / 2), -np.sin(angle / 2)
        own = [one]
        if rates:
            own.append(rates[0] / 2 * along)
        if rates[1:]:
            own.append(rates[1] / 2 * along - rates[0] ** 2 / 4 * one)
        found = own if not found else _product(own, found)
    return found


def _product(left: Sequence[Array], right: Sequence[Array]) -> list[Array]:
    """A product of quaternions over time, and as many derivatives as both have."""
    result = [_times(left[0], right[0])]
    if left[1:]:
        result.append(_times(left[1], right[0]) + _times(left[0], right[1]))
    if left[2:]:
        both = 2 * _times(left[1], right[1])
        result.append(_times(left[2], right[0]) + both + _times(left[0], right[2]))
    return result


def _times(left: Array, right: Array) -> Array:
    """Products of quaternions x, y, z, w, ``(n, 4)`` each."""
    v, w = left[:, :3], left[:, 3:]
    u, s = right[:, :3], right[:, 3:]
    scalar = w * s - (v * u).sum(axis=1, keepdims=True)
    return np.column_stack([w * u + s * v + np.cross(v, u), scalar])
