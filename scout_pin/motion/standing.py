"""Which feet stand, where a table of joint angles doesn't say: by heights and rest of the soles.

A sole is below the other, level with it or above. A foot with nothing below it stands. Soles that
are level stand both, if they rest against each other; if one of them slides, nobody can tell
which, and it is asked for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from scout_pin.specification import SIDES
from thesis_pin.contacts.feet import sole_corners
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.rotations import invert
from thesis_pin.tables.table import Table
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_STILL = 1e-8
"""Displacement [m] that is rest in any case: what programs leave of a zero."""

_CALM = 6
"""How many standard deviations of the samples' noise a resting foot may stray."""

_REMEDY = "Add a column 'support' with left, right or double"


def level_within(slack: float) -> float:
    """How far apart soles may be that count as level [m]; ``slack`` is of the samples."""
    return max(TOLERANCES.stance_drift / 2, slack)


def standing_by_soles(
    table: Table, soles: Mapping[str, Array], outlines: tuple[Array, Array], slack: float
) -> NDArray[np.bool_]:
    """Which feet bear load, left then right, booleans ``(n, 2)``.

    Args:
        table: Where the samples come from, for messages.
        soles: Each sole in the torso's frame by side, ``(n, 4, 4)``.
        outlines: Corners of both soles in their frames [m], each ``(h, 2)``.
        slack: How far the samples' resolution may move a sole's corner [m].

    Raises:
        TrajectoryError: At some sample it can't be told.
    """
    limit = level_within(slack)
    between = invert(soles[SIDES[0]]) @ soles[SIDES[1]]
    above = sole_corners(outlines[1], between)[..., 2]  # the right sole over the left one's plane
    below = sole_corners(outlines[0], invert(between))[..., 2]
    level = (np.abs(above) <= limit).all(axis=1) & (np.abs(below) <= limit).all(axis=1)
    on_left = (above >= -limit).all(axis=1) & ~level
    on_right = (below >= -limit).all(axis=1) & ~level
    _refuse(
        table,
        ~level & (on_left == on_right),
        "neither sole is wholly above the other: which foot stands can't be told",
    )
    stands = np.column_stack([on_left | level, on_right | level])
    seen = np.column_stack([between[:, :2, 3], above])
    calm = max(_STILL, slack, _CALM * _noise(seen))
    for first, last in _runs(level):
        off = _displaced(seen[first:last], calm)
        # A foot that lifts off or lands creeps before it is seen to be in the air.
        rest = np.flatnonzero(off <= calm)
        ends = (slice(first, first + rest[0]), slice(first + rest[-1] + 1, last))
        for part, outside in zip(ends, (first - 1, last), strict=True):
            if 0 <= outside < len(level):
                stands[part] = stands[outside]
        slides = np.zeros(len(level), dtype=bool)
        slides[first:last] = (off > 2 * limit) & stands[first:last].all(axis=1)
        _refuse(
            table,
            slides,
            "both soles are on the floor and one slides: which foot stands can't be told",
        )
    return stands


def standing_on_floor(
    torso: Array, soles: Mapping[str, Array], outlines: tuple[Array, Array], slack: float
) -> NDArray[np.bool_]:
    """The same where the torso is known, ``(n, 4, 4)``: soles on the floor stand."""
    limit = level_within(slack)
    heights = [
        np.abs(sole_corners(outline, torso @ soles[side])[..., 2]).max(axis=1)
        for side, outline in zip(SIDES, outlines, strict=True)
    ]
    return np.column_stack([height <= limit for height in heights])


def _displaced(seen: Array, calm: float) -> Array:
    """How far a sole is from where it rests [m], from places and heights ``(n, k)``, ``(n,)``."""
    off = np.asarray(np.abs(seen - np.median(seen, axis=0)).max(axis=1))
    if (off <= calm).mean() >= 0.5:
        return off
    lowest = int(np.argmin(np.abs(seen[:, 2:]).max(axis=1)))  # it touches down and goes on
    return np.asarray(np.abs(seen - seen[lowest]).max(axis=1))


def _noise(seen: Array) -> float:
    """Standard deviation of samples about a smooth motion, the largest of the columns."""
    if len(seen) < 5:
        return 0.0
    fourth = np.abs(np.diff(seen, 4, axis=0))
    return float((1.4826 * np.median(fourth, axis=0) / np.sqrt(70)).max())


def _runs(yes: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """First sample and the one after the last of each run of samples that say yes."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], yes.astype(np.int8), [0]])))
    return zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)


def _refuse(table: Table, bad: NDArray[np.bool_], what: str) -> None:
    if bad.any():
        where = table.where(int(np.argmax(bad)))
        raise TrajectoryError(what, where=where, remedy=_REMEDY)
