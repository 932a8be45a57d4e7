"""What samples of finite resolution leave open, as JSON-ready data and as tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.tables import Table
from thesis_pin.report.uncertainty.reason import fine
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.resolution import Resolution, Sampled

Array = NDArray[np.float64]


def open_document(
    numbers: Mapping[str, Interval | Sequence[Interval] | None],
    samples: Sampled,
    draws: tuple[int, int],
    time: Array,
    bands: Mapping[str, Array],
) -> dict[str, object]:
    """Intervals of a report's numbers and what they were made from, JSON-ready.

    Args:
        numbers: Key → interval, or one a joint.
        samples: What the samples resolve.
        draws: How many could be worked out, and how many couldn't.
        time: At which they were judged [s], shape ``(k,)``.
        bands: What has a band at these times → from and to, ``(2, k, …)``.
    """
    return {
        **{name: _ends(held) for name, held in numbers.items()},
        "columns": [
            {"name": one.name, "resolution": one.quantum, "noise": one.noise, "moves": one.moves}
            for one in samples.columns
        ],
        "rate": samples.rate,
        "draws": draws[0],
        "lost_draws": draws[1],
        "seed": samples.seed,
        "time": time,
        **{
            f"{name}_{end}": values
            for name, both in bands.items()
            for end, values in zip(("low", "high"), both, strict=True)
        },
    }


def _ends(held: Interval | Sequence[Interval] | None) -> object:
    if held is None:
        return None
    if isinstance(held, Interval):
        return {"value": held.value, "low": held.low, "high": held.high}
    return [_ends(one) for one in held]


def open_table(
    whose: tuple[str, Sequence[str]],
    peaks: tuple[str, Sequence[Interval], str],
    uses: tuple[str, Sequence[Interval]],
    *,
    unlimited: bool = False,
) -> Table:
    """Between which values each joint's peak torque and its share of a limit lie.

    Args:
        whose: Heading and names of the joints or motors.
        peaks: Heading, peak torques, and how to write a number.
        uses: Heading and shares of the limits.
        unlimited: Whether a share of nothing means that there is no limit.
    """

    def share(one: Interval, value: float) -> str:
        return "–" if unlimited and not one.high else f"{value:.0%}"

    (name, torques, digits), (of, shares) = peaks, uses
    columns = {
        whose[0]: list(whose[1]),
        name: [format(one.value, digits) for one in torques],
        "from": [format(one.low, digits) for one in torques],
        "to": [format(one.high, digits) for one in torques],
        of: [share(one, one.value) for one in shares],
        "from ": [share(one, one.low) for one in shares],
        "to ": [share(one, one.high) for one in shares],
    }
    return Table.of("What the samples' resolution leaves open", columns)


def columns_table(columns: Sequence[Resolution], rate: float) -> Table:
    """What each column of the samples resolves."""
    moving = [one for one in columns if one.moves]
    told = {
        "column": [one.name for one in moving],
        "samples": [fine(one, rate) for one in moving],
    }
    rows = list(zip(*told.values(), strict=True))
    return Table("What the samples resolve", list(told), rows, prose=True)
