"""Columns as text, in units of choice, so that reading them gives the same numbers.

Powers of ten are moved in the text, as :mod:`thesis_pin.tables.units` does when it reads: what
is written in millimetres reads back to the bit, what is in degrees to a rounding.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from decimal import Decimal

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.tables.units import ANGLE, LENGTH, TIME, Unit, Units

_KINDS: dict[str, Units] = {"length": LENGTH, "angle": ANGLE, "time": TIME}
_NAMES = {
    unit.ending[1:]: (kind, unit) for kind, units in _KINDS.items() for unit in units if unit.ending
}


@dataclass(frozen=True)
class WrittenUnits:
    """The units that columns are written in.

    Attributes:
        length, angle, time: A unit each; by default SI, which names don't say.
    """

    length: Unit = LENGTH[0]
    angle: Unit = ANGLE[0]
    time: Unit = TIME[0]

    @classmethod
    def parse(cls, text: str) -> WrittenUnits:
        """Units from words, as ``"mm,deg,ms"``.

        Raises:
            UnknownName: A word is no unit of ours.
            BadInput: Two are of one kind.
        """
        found: dict[str, Unit] = {}
        for word in map(str.strip, text.split(",")):
            if word not in _NAMES:
                raise UnknownName("unit", word, tuple(_NAMES))
            kind, unit = _NAMES[word]
            if kind in found:
                raise BadInput(f"two units of {kind} in {text!r}", allowed="one of each kind")
            found[kind] = unit
        return replace(cls(), **found)


def heading(name: str, unit: Unit) -> str:
    """What a column is called."""
    return name + unit.ending


def texts(values: NDArray[np.float64] | Iterable[float], unit: Unit) -> list[str]:
    """Numbers in SI as text in a unit, with all their digits."""
    numbers = (np.asarray(values, dtype=float) + 0.0) / unit.factor  # no negative zeros
    written = map(repr, numbers.tolist())
    if not unit.tens:
        return list(written)
    return [f"{Decimal(one).scaleb(-unit.tens).normalize():f}" for one in written]
