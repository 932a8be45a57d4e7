"""Columns of what moves freely, a root or a tool's frame: where it is, and how it is turned."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.tables.orientations import FORMS, check_order, oriented
from thesis_pin.tables.table import Column, Table
from thesis_pin.tables.units import ANGLE, LENGTH, PLAIN, Units

Array = NDArray[np.float64]

PLACE = ("x", "y", "z")
ANGLES = ("roll", "pitch", "yaw")
QUATERNION = ("qx", "qy", "qz", "qw")


@dataclass(frozen=True)
class Names:
    """What the columns of a placement are called.

    Attributes:
        what: Whose placement it is, for messages.
        prefix: What stands before each name.
        forms: Columns that together hold an orientation, one of these.
        partly: Whether some coordinates may be left out: any of the place, any two of the
            three angles.
        also: What may stand before each name instead.
    """

    what: str
    prefix: str
    forms: tuple[tuple[str, ...], ...]
    partly: bool = False
    also: str = ""

    def __iter__(self) -> Iterator[str]:
        """Every column there may be."""
        return (self.prefix + name for part in (PLACE, *self.forms) for name in part)

    def units(self) -> Iterator[tuple[str, str, Units]]:
        """Every column there may be, what it may be called, and its units."""
        for form in (PLACE, *self.forms):
            units = LENGTH if form == PLACE else PLAIN if form == QUATERNION else ANGLE
            for prefix in dict.fromkeys((self.prefix, self.also or self.prefix)):
                yield from ((self.prefix + name, prefix + name, units) for name in form)

    @property
    def angles(self) -> tuple[str, ...]:
        """The columns of angles that may count turns; those of a rotation vector may not."""
        forms = [form for form in self.forms if form not in (QUATERNION, ("rx", "ry", "rz"))]
        return tuple(self.prefix + name for form in forms for name in form)

    @property
    def lengths(self) -> tuple[str, ...]:
        """The columns in metres."""
        return tuple(self.prefix + name for name in PLACE)


BASE = Names("the base", "base_", (ANGLES, QUATERNION))
"""Of a free root."""


def tool_names(frame: str, joints: Mapping[str, object]) -> Names:
    """Of a tool's frame: x, y, z and the like; with its name before, where joints are called so."""
    forms = tuple(FORMS)
    names = Names(f"frame {frame!r}", "", forms, partly=True, also=f"{frame}_")
    if any(name in joints for name in names):
        return Names(names.what, f"{frame}_", forms, partly=True)
    return names


@dataclass(frozen=True, eq=False)
class Flight:
    """A free root, or a tool's frame, over time.

    Attributes:
        place: The columns of its place.
        turns: The columns of its orientation: angles, a quaternion, or none.
        base: Places and quaternions x, y, z, w, shape ``(n, 7)``; 0, 0, 0 and no turn where no
            column says them.
        told: Which of x, y, z, roll, pitch and yaw are told.
        notes: What was chosen, in plain words.
    """

    place: tuple[str, ...]
    turns: tuple[str, ...]
    base: Array
    told: tuple[str, ...]
    notes: tuple[str, ...] = ()


def read_flight(
    values: Mapping[tuple[str, int], Column], table: Table, names: Names, euler: str | None = None
) -> Flight | None:
    """The placement over time; None if no column says it.

    Args:
        values: Columns by what they hold and which derivative it is.
        table: Where they stand, for messages.
        names: What its columns are called.
        euler: Order of the angles in columns a, b, c or rx, ry, rz.

    Raises:
        BadInput: Columns are missing, or a quaternion isn't of unit length.
    """
    if euler is not None:
        check_order(euler)
    given = [of for of, _ in values if of in {*names}]
    if not given:
        return None
    place = tuple(name for name in names.lengths if name in given)
    turns = tuple(of for of in given if of not in place)
    form = _form(table, names, turns, given)
    base = np.zeros((len(table), 7))
    base[:, 6] = 1.0
    for k, name in enumerate(names.lengths):
        if name in place:
            base[:, k] = values[name, 0].values
    notes: list[str] = []
    columns = [values[names.prefix + name, 0].values for name in form]
    if euler is not None and (form == QUATERNION or len(form) < len(ANGLES)):
        raise BadInput(
            f"an order of angles is given ({euler}), and no three columns hold angles",
            where=table.file,
            remedy="Leave the order out",
        )
    if form == QUATERNION:
        base[:, 3:] = _unit(np.column_stack(columns), table, names)
    elif form and names.partly and len(form) == len(ANGLES):
        turned, notes = oriented(table, form, np.column_stack(columns), euler)
        base[:, 3:] = quaternions(turned)
    elif form:
        from scipy.spatial.transform import Rotation

        angles = np.zeros((len(table), 3))
        for name, column in zip(form, columns, strict=True):
            angles[:, ANGLES.index(name)] = column
        base[:, 3:] = Rotation.from_euler("xyz", angles).as_quat()
    turned_about = form if len(form) == 1 else ANGLES if form else ()
    told = (*(name.removeprefix(names.prefix) for name in place), *turned_about)
    return Flight(place, tuple(names.prefix + name for name in form), base, told, tuple(notes))


def _form(table: Table, names: Names, turns: tuple[str, ...], given: list[str]) -> tuple[str, ...]:
    """Which columns hold the orientation; none, or one angle, where a part is enough."""
    plain = {name.removeprefix(names.prefix) for name in turns}
    for form in names.forms:
        if plain == set(form) and (names.partly or len(given) == len(PLACE) + len(form)):
            return form
    if names.partly and (not plain or (len(plain) == 1 and plain <= set(ANGLES))):
        return tuple(plain)
    forms = [", ".join(names.prefix + name for name in form) for form in names.forms]
    allowed = (
        f"{', '.join(names.lengths)} and {forms[0]}, or these and {forms[1]} instead of angles"
    )
    if names.partly:
        allowed = f"some of {', '.join(names.lengths)} with one or all of {forms[-2]}, or with "
        allowed += " or ".join(form for k, form in enumerate(forms) if k != len(forms) - 2)
    raise BadInput(
        f"{names.what} has the columns {', '.join(given)}", where=table.file, allowed=allowed
    )


def _unit(quaternion: Array, table: Table, names: Names) -> Array:
    length = np.linalg.norm(quaternion, axis=1)
    if (np.abs(length - 1) > 1e-3).any():
        k = int(np.argmax(np.abs(length - 1)))
        raise BadInput(
            f"the quaternion of {names.what} has length {length[k]:.6g}",
            where=table.where(k),
            allowed="1",
        )
    return np.asarray(quaternion / length[:, None])
