"""Designs that no other one beats in everything at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.display.counted import counted
from thesis_pin.errors import BadInput
from thesis_pin.sweep.result import Sweep
from thesis_pin.sweep.study import Column

FEWEST, MOST = 2, 3
"""Aims that are held against each other at once."""

_DIGITS = 10
"""Of numbers that designs are compared by."""

_SIGNS = {"min": 1.0, "max": -1.0, "less": 1.0, "more": -1.0}


@dataclass(frozen=True)
class Aim(Brief):
    """A column and which way it is better.

    Attributes:
        column: The column.
        sign: 1 where less is better, −1 where more is.
    """

    column: Column
    sign: float

    @property
    def said(self) -> str:
        """What is wanted, in words."""
        return f"{'least' if self.sign > 0 else 'most'} {self.column.name}"


def read_aims(sweep: Sweep, text: str) -> tuple[Aim, ...]:
    """Aims from text: names of columns with commas, ``min:`` or ``max:`` before them.

    Args:
        sweep: Whose columns.
        text: As ``speed,min:servos.*.stall_torque``.

    Raises:
        UnknownName: There is no such column.
        BadInput: They aren't two or three numbers, or nobody knows which way one is better.
    """
    aims = tuple(read_aim(sweep, one) for one in text.split(","))
    names = [aim.column.name for aim in aims]
    if not FEWEST <= len(aims) <= MOST or len(set(names)) < len(names):
        raise BadInput(
            f"{text!r} names {counted(len(set(names)), 'column')}",
            where="pareto",
            allowed="two or three different columns",
        )
    return aims


def read_aim(sweep: Sweep, text: str) -> Aim:
    """One aim from text; see :func:`read_aims`."""
    word, colon, name = text.strip().partition(":")
    if not colon or word not in ("min", "max"):
        word, name = "", text.strip()
    column = sweep.column(name)
    if column.kind == "text":
        raise BadInput(f"{name} holds texts, and none is better than another", where="aims")
    better = word or column.better
    if not better:
        raise BadInput(
            f"nobody knows which way {name} is better",
            where="aims",
            allowed=f"min:{name} or max:{name}",
        )
    return Aim(column, _SIGNS[better])


def usual_aims(sweep: Sweep) -> tuple[Aim, ...]:
    """The study's own."""
    return tuple(read_aim(sweep, name) for name in sweep.study.aims)


def front(sweep: Sweep, aims: tuple[Aim, ...]) -> NDArray[np.intp]:
    """Designs that no other considered one equals in all aims and beats in one, ascending.

    Args:
        sweep: The sweep.
        aims: By what.
    """
    values = np.stack([compared(sweep, aim) for aim in aims], axis=1)
    numbers = np.flatnonzero(sweep.considered & np.isfinite(values).all(axis=1))
    return numbers[undominated(values[numbers])]


def compared(sweep: Sweep, aim: Aim) -> NDArray[np.float64]:
    """What designs are compared by, less being better: without digits that are but rounding."""
    numbers = aim.sign * sweep.numbers(aim.column.name)
    return np.array([float(f"{one:.{_DIGITS}g}") for one in numbers])


def undominated(values: NDArray[np.float64]) -> NDArray[np.intp]:
    """Rows that no other row is as small as everywhere and smaller than somewhere, ascending.

    Args:
        values: Shape ``(n, aims)``.
    """
    order = np.lexsort(values.T[::-1])  # who dominates a row stands before it
    kept: list[int] = []
    best = np.empty((0, values.shape[1]))
    for k in order:
        one = values[k]
        no_worse = (best <= one).all(axis=1)
        if not (no_worse & (best < one).any(axis=1)).any():
            kept.append(int(k))
            best = np.vstack([best, one])
    return np.sort(np.array(kept, dtype=np.intp))
