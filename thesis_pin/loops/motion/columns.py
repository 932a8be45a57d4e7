"""Which columns of a table hold what of a robot's motion."""

from __future__ import annotations

from collections.abc import Sequence

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.base import BASE_ANGLES, BASE_PARTS, BASE_PLACE, BASE_QUATERNION
from thesis_pin.loops.motion.leading import ANGLES, PLACE, Names
from thesis_pin.tables.meaning import Chosen, Meaning, chosen, time_names
from thesis_pin.tables.table import Table
from thesis_pin.tables.units import ANGLE, LENGTH, PLAIN, headings

ORDERS = (("", ""), ("_rate", "_s"), ("_acceleration", "_s2"))
"""What follows a name for each derivative, and its unit for each."""


def _known(robot: ClosedRobot, lead: Names | None) -> dict[str, list[Meaning]]:
    """Every column a file may have, with all it could mean."""
    turning = {name: one.turns for name, one in singles(robot.model).items()}
    names = {name: name for name in turning}
    for motor in robot.motors:
        names.setdefault(motor.name, motor.joint)
    known = time_names()
    for name, joint in names.items():
        units = ANGLE if turning[joint] else LENGTH
        for order, (word, per) in enumerate(ORDERS):
            said = f"{word[1:] or 'position'} of {joint!r}"
            for heading, unit in headings(name + word, units, per).items():
                known.setdefault(heading, []).append(Meaning((joint, order), unit, said))
    if len(robot.base):
        for parts, units in (
            (BASE_PLACE, LENGTH),
            (BASE_ANGLES, ANGLE),
            (BASE_QUATERNION, PLAIN),
        ):
            for part in parts:
                for order, (word, per) in enumerate(ORDERS):
                    for heading, unit in headings(part + word, units, per).items():
                        meaning = Meaning((part, order), unit, part + word)
                        known.setdefault(heading, []).append(meaning)
    for part, called, units in lead.headings() if lead else ():
        for heading, unit in headings(called, units).items():
            known.setdefault(heading, []).append(Meaning((part, 0), unit, part))
    return known


def columns_of(
    robot: ClosedRobot, table: Table, lead: Names | None = None, beside: Sequence[str] = ()
) -> Chosen:
    """Which column holds which derivative of which joint, part of the base or of a frame.

    Args:
        robot: The robot.
        table: The table.
        lead: What columns of a frame that leads it are called.
        beside: Headings that may be there too, and mean something to somebody else.

    Raises:
        UnknownName: A column is none of the robot's.
        BadInput: One could mean two things, two mean the same, or one stands without what it
            is the derivative of.
    """
    known, base = _known(robot, lead), BASE_PARTS if len(robot.base) else ()
    for heading in beside:
        known.setdefault(heading, [Meaning(heading, PLAIN[0], heading)])
    placed = lead(*PLACE, *ANGLES) if lead else base
    allowed = ["t", *singles(robot.model), *placed, "NAME_rate", "NAME_acceleration", *beside]
    flies = [one for one in table.header if one.startswith(BASE_PARTS) and one not in known]
    if flies and not base:
        raise UnknownName(
            "column",
            flies[0],
            allowed,
            where=table.file,
            remedy="The base's columns are of a free root, and this robot's is fixed: "
            "--free-flyer lets it fly, in Python root_joint=pin.JointModelFreeFlyer()",
        )
    columns, _ = chosen(table, known, allowed)
    for key, (place, _) in columns.items():
        if not isinstance(key, tuple):
            continue
        of, order = key
        for lower in range(order):
            if (of, lower) not in columns:
                raise BadInput(
                    f"column {table.header[place]!r} stands without {of}{ORDERS[lower][0]}",
                    where=table.file,
                )
    return columns
