"""What a report draws, as data: figures and pages draw the same plots from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import WrongShape

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Colours that a colour-blind reader can tell apart (Okabe and Ito, 2008)."""
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = PALETTE
BLACK = "#000000"

Dash = Literal["solid", "dash", "dot"]


@dataclass(frozen=True)
class Curve:
    """A line, or points one by one.

    Attributes:
        name: Text of the legend.
        y: Values in the plot's unit, shape ``(n,)``; NaN leaves a gap.
        colour: ``#rrggbb``.
        dash: How the line is broken.
        marks: Points instead of a line: what stands at each.
        x: Where, shape ``(n,)``; None for the plot's time.
    """

    name: str
    y: NDArray[np.float64]
    colour: str
    dash: Dash = "solid"
    marks: Literal["dot", "cross"] | None = None
    x: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class Area:
    """A polygon.

    Attributes:
        name: Text of the legend; areas of one name share a line of it.
        corners: In order, shape ``(k, 2)``.
        colour: ``#rrggbb``.
        filled: Whether its inside is tinted too.
        edged: Whether its edge is drawn.
    """

    name: str
    corners: NDArray[np.float64]
    colour: str
    filled: bool = True
    edged: bool = True


@dataclass(frozen=True)
class Band:
    """A stretch of time, tinted.

    Attributes:
        name: What it stands for; bands of one name share a line of the legend.
        start: When it begins [s].
        end: When it ends [s].
        colour: ``#rrggbb``.
    """

    name: str
    start: float
    end: float
    colour: str


@dataclass(frozen=True)
class Limit:
    """A value that the curves are held against.

    Attributes:
        name: Text of the legend; limits of one name share a line of it.
        value: In the plot's unit.
    """

    name: str
    value: float


@dataclass(frozen=True)
class Plot:
    """Curves over time, or over a plane whose two axes share one scale.

    Attributes:
        title: Heading.
        text: What is to be seen in it, in a sentence; also its alternative text.
        label: Quantity and unit of the y axis.
        curves: What is drawn.
        time: Sample times [s], shape ``(n,)``; None for a plane.
        across: Quantity and unit of the x axis.
        limits: Values the curves are held against.
        bands: Stretches of time.
        areas: Polygons, below the curves.
    """

    title: str
    text: str
    label: str
    curves: Sequence[Curve]
    time: NDArray[np.float64] | None = None
    across: str = "time [s]"
    limits: Sequence[Limit] = ()
    bands: Sequence[Band] = ()
    areas: Sequence[Area] = ()

    def __post_init__(self) -> None:
        """Refuse curves that have no place.

        Raises:
            WrongShape: A curve's values aren't as many as its places.
        """
        for curve in self.curves:
            x, name = self.places(curve), f"curve {curve.name!r} of plot {self.title!r}"
            if np.ndim(x) != 1 or np.shape(curve.y) != np.shape(x):
                raise WrongShape(name, np.shape(curve.y), f"{np.shape(x)}, as its places")

    def places(self, curve: Curve) -> NDArray[np.float64]:
        """Where a curve's values stand along the x axis, shape ``(n,)``."""
        if curve.x is not None:
            return curve.x
        return np.empty(0) if self.time is None else self.time


def spread(name: str, time: NDArray[np.float64], bounds: NDArray[np.float64], colour: str) -> Area:
    """What lies between two curves over time, tinted.

    Args:
        name: Text of the legend.
        time: Where [s], shape ``(n,)``.
        bounds: From and to, in the plot's unit, ``(2, n)``.
        colour: ``#rrggbb``.
    """
    there, back = (np.stack([time, bound], axis=1) for bound in bounds)
    return Area(name, np.concatenate([there, back[::-1]]), colour, edged=False)


def both_signs(name: str, values: NDArray[np.float64]) -> list[Limit]:
    """Limits of size: each different value with either sign."""
    return [Limit(name, sign * float(value)) for value in np.unique(values) for sign in (1, -1)]


def evenly(count: int, most: int) -> NDArray[np.intp]:
    """Indices of at most ``most`` of ``count`` samples, evenly spread, both ends included."""
    return np.linspace(0, count - 1, min(count, most)).round().astype(np.intp)
