"""Columns whose numbers can hardly be in the unit that their names say."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np

from thesis_pin.errors import ModelWarning
from thesis_pin.tables.table import Column
from thesis_pin.tolerances import TOLERANCES


def doubted(
    file: str, lengths: Sequence[Column] = (), angles: Sequence[Column] = ()
) -> tuple[str, ...]:
    """Warn of places in metres and angles in radians that are as large as millimetres and degrees.

    Args:
        file: Their file, for messages.
        lengths: Columns of lengths.
        angles: Columns of angles.

    Returns:
        What was said as :class:`~thesis_pin.errors.ModelWarning`, without full stops.
    """
    said = []
    for columns, most, unit, likely, ending in (
        (lengths, TOLERANCES.far_away, "m", "millimetres", "_mm"),
        (angles, TOLERANCES.far_turned, "rad", "degrees", "_deg"),
    ):
        large = {
            one: size
            for one in columns
            if one.unit.size == 1.0 and (size := np.abs(one.values).max(initial=0.0)) > most
        }
        if large:
            named = [one.heading for one in large]
            more = f" and {len(named) - 3} more" if named[3:] else ""
            said.append(
                f"{file}: {', '.join(named[:3])}{more} reach {max(large.values()):.6g} {unit}: if "
                f"these are {likely}, call {'them' if named[1:] else 'it'} so, as in "
                f"{next(iter(large)).name}{ending}"
            )
    for one in said:
        warnings.warn(one, ModelWarning, stacklevel=3)
    return tuple(said)
