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
            said.append(
                f"{file}: {', '.join(one.heading for one in large)} reach "
                f"{max(large.values()):.6g} {unit}: if these are {likely}, call the "
                f"column{'s' if len(large) > 1 else ''} "
                f"{', '.join(one.name + ending for one in large)}"
            )
    for one in said:
        warnings.warn(one, ModelWarning, stacklevel=3)
    return tuple(said)
