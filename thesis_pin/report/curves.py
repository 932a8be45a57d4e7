"""What a report draws, as data: figures and pages draw the same plots from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import ascending

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Colours that a colour-blind reader can tell apart (Okabe and Ito, 2008)."""
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = PALETTE
BLACK = "#000000"

Dash = Literal[
    "solid",
    "longdash",
    "dash",
    "shortdash",
    "dashdot",
    "dashdotdot",
    "dot",
    "farther dot",
    "dot pair",
    "dot triple",
    "farther pair",
    "far dot",
]
Marks = Literal["dot", "cross"] | None

STROKES: Mapping[Dash, tuple[float, ...]] = {
    "solid": (),
    "longdash": (6.5, 1.8),
    "dash": (3.7, 1.6),
    "shortdash": (2.0, 1.1),
    "dashdot": (4.2, 1.5, 1.0, 1.5),
    "dashdotdot": (4.2, 1.4, 1.0, 1.4, 1.0, 1.4),
    "dot": (1.0, 1.65),
    "farther dot": (1.0, 2.9),
    "dot pair": (1.0, 1.2, 1.0, 3.2),
    "dot triple": (1.0, 1.2, 1.0, 1.2, 1.0, 3.2),
    "farther pair": (1.0, 1.65, 1.0, 5.0),
    "far dot": (1.0, 5.0),
}
"""Lengths of strokes and gaps, in widths of the line."""

LINES: tuple[Dash, ...] = tuple(STROKES)[:6]
DOTS: tuple[Dash, ...] = tuple(STROKES)[6:]
"""Six ways to break a line, and six that all look dotted: one for each colour of the palette."""


def apart(k: int) -> tuple[str, Dash]:
    """Colour and dash of a plot's curve number ``k``: the first six differ in both.

    Where curves lie on each other, those below show through the gaps of those above.
    """
    return PALETTE[k % 6], LINES[(k + k // 6) % 6]


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
        weight: How thick the line is, others of the kind being 1.
    """

    name: str
    y: NDArray[np.float64]
    colour: str
    dash: Dash = "solid"
    marks: Marks = None
    x: NDArray[np.float64] | None = None
    weight: float = 1.0


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
        text: What is to be seen in it, in a sentence.
        label: Quantity and unit of the y axis.
        curves: What is drawn.
        time: Sample times [s], shape ``(n,)``; None for a plane.
        across: Quantity and unit of the x axis.
        limits: Values the curves are held against.
        bands: Stretches of time.
        areas: Polygons, below the curves.
        dashes: What the ways its lines are broken mean, in a sentence, where they mean something.
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
    dashes: str = ""

    @property
    def caption(self) -> str:
        """All that is said of it, also as its alternative text."""
        return f"{self.text} {self.dashes}".rstrip()

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


def condensed(plot: Plot, stretches: int) -> Plot:
    """A plot with as many samples of its curves as show, each peak among them.

    Args:
        plot: With every sample there is.
        stretches: Of the x axis, as many as it has columns of pixels; a plane's curves are
            divided by their samples instead. Curves of so many samples stay whole.
    """
    curves = []
    for curve in plot.curves:
        x = plot.places(curve)
        if len(x) > stretches:
            over_time = curve.x is None
            values = (curve.y,) if over_time else (curve.y, x)
            keep = telling(x if over_time else np.arange(len(x)), values, stretches)
            curve = replace(curve, x=x[keep], y=curve.y[keep])
        curves.append(curve)
    return replace(plot, curves=curves)


def telling(
    places: NDArray[np.floating | np.integer],
    values: Sequence[NDArray[np.float64]],
    stretches: int,
) -> NDArray[np.intp]:
    """Samples by which curves look as they do with all of them.

    Args:
        places: Where the samples stand, ascending, shape ``(n,)``, n ≥ 2.
        values: Arrays of shape ``(n,)``; NaN is a gap.
        stretches: Number of equal parts of the places' range.

    Returns:
        Indices, ascending: the first sample of each stretch and the last of all; those of the
        least and the greatest of a stretch's values that lie beyond its first and the next
        one's; both sides of the first beginning and the first end of a gap in it. Without gaps
        at most ``1 + (1 + 2 len(values)) (stretches + 1)``.
    """
    share = (places - places[0]) / (places[-1] - places[0])
    starts = np.flatnonzero(np.diff(np.floor(share * stretches), prepend=-1.0))
    last = len(places) - 1
    ends = np.append(starts[1:], last)

    def first(chosen: NDArray[np.bool_]) -> NDArray[np.intp]:
        """The first chosen sample of each stretch that has one."""
        where = np.flatnonzero(chosen)
        after = np.searchsorted(where, starts)
        return where[after[after < len(where)]]

    keep = [starts, np.array([last])]
    for one in values:
        for low in (one, -one):
            least = np.fmin.reduceat(low, starts)
            # Along a rising or falling stretch nothing is added: neighbours share the ends.
            least[least >= np.fmin(low[starts], low[ends])] = np.nan
            keep.append(first(low == np.repeat(least, np.diff(starts, append=last + 1))))
        gap = np.isnan(one)
        for before in (gap[:-1], ~gap[:-1]):
            edge = first(before & (gap[:-1] != gap[1:]))
            keep += [edge, edge + 1]
    return np.asarray(ascending(*keep), dtype=np.intp)
