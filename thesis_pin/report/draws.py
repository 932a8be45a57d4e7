"""How robots with drawn errors do, in a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from thesis_pin.report.tables import Table


def draws_table(
    spread: Mapping[str, Sequence[float]], units: Mapping[str, tuple[str, float]]
) -> Table:
    """What draws differ in, in quantiles.

    Args:
        spread: Name → value of each draw, in SI units.
        units: Name → the unit it is written in, and that unit's number in one of SI.
    """
    rows, draws = [], 0
    for name, values in spread.items():
        unit, factor = units[name]
        levels, draws = np.quantile(values, (0, 0.25, 0.5, 0.75, 1)) * factor, len(values)
        rows.append((f"{name.replace('_', ' ')} [{unit}]", *(f"{v:z.3f}" for v in levels)))
    heads = ("of the draws", "least", "quarter", "half", "three quarters", "largest")
    return Table(f"{draws} robots with drawn errors", heads, rows)
