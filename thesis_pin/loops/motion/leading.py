"""Columns of a tool's frame that leads a robot: where it is, how it is turned, or a part of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.loops.motion.base import Flight
from thesis_pin.loops.motion.sampled import unwound
from thesis_pin.loops.motion.told import Tool
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.tables.orientations import FORMS, check_order, from_euler, oriented
from thesis_pin.tables.table import Column, Table
from thesis_pin.tables.units import LENGTH, PLAIN, Units

Array = NDArray[np.float64]

PLACE = ("x", "y", "z")
ANGLES = ("roll", "pitch", "yaw")
QUATERNION = ("qx", "qy", "qz", "qw")
VECTOR = ("rx", "ry", "rz")


@dataclass(frozen=True)
class Names:
    """What a frame's columns are called.

    Attributes:
        frame: The frame.
        prefix: What stands before each name: nothing, or the frame's own where joints are called
            like that.
    """

    frame: str
    prefix: str

    @classmethod
    def of(cls, frame: str, joints: Mapping[str, object]) -> Names:
        """Those of a frame of a robot with such joints."""
        taken = any(name in joints for form in (PLACE, *FORMS) for name in form)
        return cls(frame, f"{frame}_" if taken else "")

    def __call__(self, *names: str) -> tuple[str, ...]:
        """Some of them."""
        return tuple(self.prefix + name for name in names)

    def headings(self) -> Iterator[tuple[str, str, Units]]:
        """Every column there may be, what it may be called, and its units."""
        for form, units in {PLACE: LENGTH, **FORMS}.items():
            for prefix in dict.fromkeys((self.prefix, f"{self.frame}_")):
                yield from ((self.prefix + name, prefix + name, units) for name in form)

    def turning(self) -> tuple[str, ...]:
        """The columns that are angles."""
        return self(*(name for form, units in FORMS.items() if units != PLAIN for name in form))


def without_turns(values: dict[tuple[str, int], Column], names: Names) -> None:
    """Take jumps by a turn out of angles; a rotation vector's aren't such."""
    for name in names.turning():
        if (name, 0) in values and name not in names(*VECTOR):
            found, _ = unwound(name, values[name, 0].values)
            values[name, 0] = replace(values[name, 0], values=found)


def read_lead(
    values: Mapping[tuple[str, int], Column], table: Table, names: Names, euler: str | None
) -> tuple[Flight, tuple[str, ...], list[str]]:
    """The frame's placement over time.

    Args:
        values: Columns by what they hold and which derivative it is.
        table: Where they stand, for messages.
        names: What they are called.
        euler: Order of the angles in columns a, b, c or rx, ry, rz.

    Returns:
        Its placement, with 0 and no turn where no column says them; which of x, y, z, roll,
        pitch and yaw are told; what was chosen, in plain words.

    Raises:
        BadInput: There are none, or they don't go together; a quaternion isn't of unit length.
    """
    if euler is not None:
        check_order(euler)
    place = tuple(name for name in PLACE if (names.prefix + name, 0) in values)
    form = _form(values, table, names)
    if not (place or form):
        raise BadInput(
            f"no column is of frame {names.frame!r}",
            where=table.file,
            allowed=", ".join(names(*PLACE, *ANGLES)),
        )
    base = np.zeros((len(table), 7))
    base[:, 6] = 1.0
    for name in place:
        base[:, PLACE.index(name)] = values[names.prefix + name, 0].values
    columns = [values[name, 0].values for name in names(*form)]
    notes: list[str] = []
    if len(form) == 1 or not form:
        if euler is not None:
            raise BadInput(
                f"an order of angles is given ({euler}), and no three columns hold angles",
                where=table.file,
                remedy="Leave the order out",
            )
        if form:
            angles = np.zeros((len(table), 3))
            angles[:, ANGLES.index(form[0])] = columns[0]
            base[:, 3:] = quaternions(from_euler("xyz", angles))
    else:
        turned, notes = oriented(table, form, np.column_stack(columns), euler)
        base[:, 3:] = quaternions(turned)
        if form == QUATERNION:  # whose components are samples themselves
            given = np.column_stack(columns)
            base[:, 3:] = given / np.linalg.norm(given, axis=1)[:, None]
    told = (*place, *(form if len(form) == 1 else ANGLES if form else ()))
    return Flight(names(*form), base, place=names(*place)), told, notes


def left_to_the_robot(
    flight: Flight,
    told: tuple[str, ...],
    values: Mapping[tuple[str, int], Column],
    names: Names,
    freedoms: int,
) -> tuple[Flight, Tool, list[str]]:
    """A frame's orientation without what never moves and the robot holds by itself.

    A delta's tool and a SCARA's don't tilt: tables of whole poses tell them so all the same, and
    rounding of what can't move would ask for what the robot can't do.

    Args:
        flight: Its placement.
        told: Which coordinates are told.
        values: Columns by what they hold and which derivative it is.
        names: What they are called.
        freedoms: How many motors the robot has for it.

    Returns:
        The rest of it, what is told then, and what is to be said.
    """
    whole = Tool(names.frame, told)
    place = tuple(name for name in told if name in PLACE)
    if not set(ANGLES) <= set(told) or len(told) <= freedoms:
        return flight, whole, []
    moves = [bool(np.ptp(values[name, 0].values) > 0) for name in flight.turns]
    kept = tuple(flight.base[0, 3:].tolist())
    if not any(moves) and len(place) >= freedoms:
        base = flight.base.copy()
        base[:, 3:] = 0.0, 0.0, 0.0, 1.0
        said = f"frame {names.frame} doesn't turn in the table, and the robot keeps it so by itself"
        return replace(flight, turns=(), base=base), Tool(names.frame, place, kept), [said]
    yaws = flight.turns == names(*ANGLES) and not (moves[0] or moves[1])
    if yaws and len(place) + 1 >= freedoms:
        angles = np.zeros((len(flight.base), 3))
        angles[:, 2] = values[names("yaw")[0], 0].values
        base = flight.base.copy()
        base[:, 3:] = quaternions(from_euler("xyz", angles))
        said = f"frame {names.frame} only yaws in the table; roll and pitch the robot keeps itself"
        some = replace(flight, turns=names("yaw"), base=base)
        angles[:, :2] = [values[name, 0].values[0] for name in names("roll", "pitch")]
        level = quaternions(from_euler("xyz", angles[:1] * [1.0, 1.0, 0.0]))[0]
        return some, Tool(names.frame, (*place, "yaw"), tuple(level.tolist())), [said]
    return flight, whole, []


def _form(values: Mapping[tuple[str, int], Column], table: Table, names: Names) -> tuple[str, ...]:
    """Which columns hold the orientation: all of one way to write it, one angle, or none."""
    given = {name for form in FORMS for name in form if (names.prefix + name, 0) in values}
    whole = [form for form in FORMS if given == set(form)]
    if whole:
        return whole[0]
    if not given or (len(given) == 1 and given <= set(ANGLES)):
        return tuple(given)
    raise BadInput(
        f"frame {names.frame!r} has the columns {', '.join(sorted(names(*given)))}",
        where=table.file,
        allowed="one of roll, pitch, yaw, or all of " + ", or of ".join(map(" ".join, FORMS)),
    )
