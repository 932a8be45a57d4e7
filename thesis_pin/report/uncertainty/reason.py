"""Why samples of finite resolution carry no verdict, in words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.resolution import fault, how_fine, percent, size
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.resolution import Resolution

Array = NDArray[np.float64]

DRAWS = 8
"""Draws of each column by which the one that makes most of what is open is found."""

FEW = (
    "The samples can't carry a verdict: most motions that they leave open can't be "
    "worked out. Finer samples are needed."
)
"""Why there is no verdict where most draws are lost."""


def culprit(columns: Sequence[Resolution], found: Array) -> tuple[Resolution, float] | None:
    """The column that makes most of what is open, and its share; None if it can't be told.

    Args:
        columns: What each column resolves.
        found: The number with one column after the other drawn, shape ``(columns, draws)``.
    """
    variance = found.var(axis=1)
    if not variance.sum() > 0:
        return None
    k = int(np.argmax(variance))
    return columns[k], float(variance[k] / variance.sum())


def why(found: tuple[Resolution, float] | None, rate: float, held: Interval, limit: float) -> str:
    """Whose fault it is that an interval holds a limit, and what would help.

    Args:
        found: Of :func:`culprit`.
        rate: Samples a second.
        held: The interval.
        limit: The limit.
    """
    if found is None:
        return "finer samples are needed"
    column, share = found
    needed = size(column.needed(held, limit), column.turns)
    return fault(column.name, fine(column, rate), share, needed)


def no_verdict(said: str, most: str) -> str:
    """Why there is no verdict: what straddles its limit, and :func:`why`."""
    return f"The samples can't carry a verdict: {said}; {most}."


def undecided(
    uses: Mapping[str, Sequence[Interval]],
    whose: Sequence[str],
    rate: float,
    blamed: Callable[[str, int], tuple[Resolution, float] | None],
) -> str:
    """Why shares of limits carry no verdict, by the one that may be largest.

    Args:
        uses: What has limits → the share of it that each motor uses, of which one is open.
        whose: What the motors are called.
        rate: Samples a second.
        blamed: The :func:`culprit` of what it is and the motor's number.
    """
    one, k, name = max(
        (
            (one, k, name)
            for name, some in uses.items()
            for k, one in enumerate(some)
            if one.side(1.0) == 0
        ),
        key=lambda found: found[0].high,
    )
    most = why(blamed(name, k), rate, one, 1.0)
    return no_verdict(f"{whose[k]} uses {percent(one)} of its {name}", most)


def with_left_open(said: Sequence[str], reason: str | None, left_open: Sequence[str]) -> list[str]:
    """A verdict's sentences with what the samples leave open.

    Args:
        said: The verdict, most important first.
        reason: Why there is none; then it comes first.
        left_open: What is left open, in sentences.
    """
    if reason is None:
        return [*said[:1], *left_open, *said[1:]]
    return [reason, *left_open, *said]


def fine(column: Resolution, rate: float) -> str:
    """How fine a column is, see :func:`thesis_pin.report.resolution.how_fine`."""
    return how_fine(column.quantum, column.noise, column.turns, rate)
