"""Poses of the tool from a table: which columns hold the orientation, time or speed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pollard_pin.coordinates import pose_rotation
from thesis_pin.display.counted import counted
from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.tables.doubts import doubted
from thesis_pin.tables.meaning import Chosen, chosen, known_names, reader, time_column, time_names
from thesis_pin.tables.orientations import FORMS, check_order, oriented
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.table import Column, Table
from thesis_pin.tables.units import LENGTH, TIME, Unit, headings

_PLACE = ("x", "y", "z")
_BARE = ("time_s", "x_m", "y_m", "z_m", "psi_rad", "theta_rad", "phi_rad")

SPEEDS = (
    Unit("_m_s"),
    Unit("_mm_s", -3),
    Unit("_m_min", factor=1 / 60),
    Unit("_mm_min", -3, 1 / 60),
)
"""Units of a tool speed; which one always has to be said."""

_UNITS = {
    "t": TIME,
    **dict.fromkeys(_PLACE, LENGTH),
    **{name: units for form, units in FORMS.items() for name in form},
}
_KNOWN = {
    **time_names(),
    **known_names((name, units) for name, units in _UNITS.items() if name != "t"),
    **known_names((name, SPEEDS) for name in ("feed", "speed")),
}


@dataclass(frozen=True)
class PoseTable:
    """Poses of the tool as a table holds them.

    Attributes:
        table: The table, for places in messages.
        time: [s]; None if there is none.
        speed: Of the spray tip [m/s]; None if there is none, or there is time.
        position: x, y, z [m].
        orientation: The columns it was read from, as :data:`FORMS` orders them.
        rotation: Orientations, shape ``(n, 3, 3)``.
        written: ψ, θ, φ [rad] if these were given, shape ``(n, 3)``.
        notes: What was chosen, in plain words.
    """

    table: Table
    time: Column | None
    speed: Column | None
    position: tuple[Column, ...]
    orientation: tuple[Column, ...]
    rotation: np.ndarray
    written: np.ndarray | None
    notes: tuple[str, ...]

    @property
    def quaternion(self) -> bool:
        """Whether the orientation's columns are a quaternion's."""
        return len(self.orientation) == len(FORMS["qx", "qy", "qz", "qw"])


def read_poses(file: str | Path, euler: str | None = None) -> PoseTable:
    """Poses of the tool from a table.

    Args:
        file: The table.
        euler: Order of the angles in columns a, b, c or rx, ry, rz, see
            :func:`thesis_pin.tables.orientations.check_order`.

    Raises:
        BadInput: It can't be read, columns are missing or don't go together, or a cell isn't a
            number.
        TrajectoryError: Time doesn't increase, or there are fewer than two rows.
    """
    if euler is not None:
        check_order(euler)
    table = read_table("path", file, bare=_BARE, means=reader(_KNOWN))
    columns, unused = chosen(table, _KNOWN, tuple(_UNITS), lenient=True)
    form = _form(table, columns)
    timed = "t" in columns
    speeds = [name for name in ("feed", "speed") if name in columns]
    if len(speeds) > 1 and not timed:
        raise BadInput("columns 'feed' and 'speed' say the same", where=table.file)
    left_out = {*columns} - {"t", *_PLACE, *form} - (set() if timed else {*speeds})
    unused += [table.header[columns[name][0]] for name in left_out]
    time = time_column(table, columns) if timed else None
    position = tuple(table.column(*columns[name], name) for name in _PLACE)
    orientation = tuple(table.column(*columns[name], name) for name in form)
    asked = doubted(table.file, position, orientation if form[0] != "qx" else ())
    if len(table) < 2:
        raise TrajectoryError(counted(len(table), "pose"), where=table.file, allowed="at least 2")
    values = np.stack([column.values for column in orientation], axis=-1)
    rotation, said = oriented(table, form, values, euler)
    if form[0] == "psi":
        rotation = pose_rotation(np.pad(values, ((0, 0), (3, 0))))
    notes = [*table.dialect.notes, *asked, *said]
    if unused:
        names = ", ".join(sorted(unused, key=table.header.index))
        notes.append(f"these columns mean nothing here and aren't used: {names}")
    return PoseTable(
        table,
        time,
        table.column(*columns[speeds[0]], "the speed") if speeds and not timed else None,
        position,
        orientation,
        rotation,
        values if form[0] == "psi" else None,
        tuple(notes),
    )


def _form(table: Table, columns: Mapping[object, object] | Chosen) -> tuple[str, ...]:
    """Which set of columns holds the orientation."""
    whole = [form for form in FORMS if all(name in columns for name in form)]
    if len(whole) > 1:  # a table may hold anything called a, b, c
        whole = [form for form in whole if form[0] != "a"]
    missing = [name for name in _PLACE if name not in columns]
    if not whole:
        nearest = max(FORMS, key=lambda form: sum(name in columns for name in form))
        missing += [name for name in nearest if name not in columns]
    if missing:
        names = (" or ".join(headings(name, _UNITS[name])) for name in missing)
        raise BadInput(
            f"{counted(len(table.header), 'column')} ({', '.join(table.header)}); "
            f"missing: {', '.join(names)}",
            where=table.file,
            allowed="one column each for time, x, y, z and the orientation: "
            + ", or ".join(" ".join(form) for form in FORMS),
        )
    if len(whole) > 1:
        both = " and as ".join(", ".join(form) for form in whole)
        raise BadInput(
            f"the orientation is given as {both}",
            where=table.file,
            remedy="Leave all but one of them out",
        )
    return whole[0]
