"""Joint tables in coarse steps: one sample a step, whose errors are independent.

Poses made of twelve angles that each move in steps have errors that last as long as the steps
do, in no pattern that the poses show.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scout_pin.motion.tables import GaitSamples
from thesis_pin.smoothing.noise import run_lengths
from thesis_pin.tables.table import Column

_LEAST = 12  # rows that are kept at least


def thinned(samples: GaitSamples) -> GaitSamples:
    """Every so many rows, so that most angles have moved on from one to the next.

    Rows at both sides of a change of contact stay, as the first and the last do.

    Args:
        samples: The samples; those that aren't of joint angles stay as they are.
    """
    moving = [one.values for one in samples.angles if np.ptp(one.values) > 0]
    if not moving:
        return samples
    count = len(samples.table)
    every = int(np.median([np.median(run_lengths(values)) for values in moving]))
    every = min(every, count // _LEAST)
    if every < 2:
        return samples
    support = np.array(samples.support)
    change = np.flatnonzero(support[1:] != support[:-1])
    keep = np.unique([*range(0, count, every), *change, *(change + 1), count - 1])

    def part(column: Column) -> Column:
        return replace(column, values=column.values[keep])

    table = samples.table
    return replace(
        samples,
        table=replace(table, lines=table.lines[keep], rows=[table.rows[row] for row in keep]),
        time=part(samples.time),
        support=tuple(samples.support[row] for row in keep),
        poses={name: part(column) for name, column in samples.poses.items()},
        angles=tuple(part(column) for column in samples.angles),
        notes=(
            *samples.notes,
            f"the angles' steps last {every} rows: one row in so many is used, {len(keep)} in all",
        ),
    )
