"""How robots with drawn errors do, in a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from thesis_pin.report.tables import Table

_UNITS = {
    **dict.fromkeys(("deviation", "distance", "sideways", "slip"), ("mm", 1e3)),
    **dict.fromkeys(("heading", "tilt", "turn"), ("°", np.degrees(1.0))),
    "peak_torque": ("N·m", 1.0),
    "saturated": ("%", 1e2),
}
"""What draws differ in: the unit it is written in, and that unit's number in one of SI."""


def draws_tables(spread: Mapping[str, Sequence[float]]) -> list[Table]:
    """What draws differ in, in quantiles; no table where there is one draw.

    Args:
        spread: Name → value of each draw, in SI units.
    """
    rows, draws = [], 0
    for name, values in spread.items():
        unit, factor = _UNITS[name]
        levels, draws = np.quantile(values, (0, 0.25, 0.5, 0.75, 1)) * factor, len(values)
        rows.append((f"{name.replace('_', ' ')} [{unit}]", *(f"{v:z.3f}" for v in levels)))
    heads = ("of the draws", "least", "quarter", "half", "three quarters", "largest")
    return [Table(f"{draws} robots with drawn errors", heads, rows)] if draws > 1 else []
