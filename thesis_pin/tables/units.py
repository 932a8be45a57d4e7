"""Units in the names of columns: ``x_mm``, ``left_knee_pitch_deg``, ``t_ms``.

A name without an ending is in SI. Powers of ten go into the text before it becomes a number,
so that 450.1 mm and 0.4501 m are the same to the bit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Unit:
    """A unit that the end of a column's name says.

    Attributes:
        ending: The end, with its underscore; empty for SI.
        tens: Power of ten that takes it to SI.
        factor: What remains of the way to SI, after the power of ten.
    """

    ending: str
    tens: int = 0
    factor: float = 1.0

    @property
    def size(self) -> float:
        """One of it in SI."""
        return float(f"1e{self.tens}") * self.factor


Units = tuple[Unit, ...]

SI = Unit("")
"""What a name without a unit is in."""

LENGTH: Units = (Unit(""), Unit("_m"), Unit("_mm", -3), Unit("_cm", -2))
ANGLE: Units = (Unit(""), Unit("_rad"), Unit("_deg", factor=math.pi / 180))
TIME: Units = (Unit(""), Unit("_s"), Unit("_ms", -3), Unit("_us", -6))
PLAIN: Units = (Unit(""),)
"""What has no unit."""

TIME_NAMES = ("t", "time")
"""What a column of time is called, before its unit."""


def headings(name: str, units: Units, per: str = "") -> dict[str, Unit]:
    """What a column may be called, and the unit each says.

    Args:
        name: Its name without a unit.
        units: The units it may have.
        per: What follows each unit of a rate: ``"_s"`` or ``"_s2"``.
    """
    return {name + (unit.ending + per if unit.ending else ""): unit for unit in units}
