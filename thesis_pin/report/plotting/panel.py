"""One plot on a sheet: its curves, its axes and what stands around them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.curves import BLACK, Curve, Plot
from thesis_pin.report.plotting.legend import Entry, Legend, fitting
from thesis_pin.report.plotting.scales import Ticks, shown, ticks
from thesis_pin.report.plotting.sheet import (
    Box,
    Look,
    Mark,
    Points,
    Shape,
    Text,
    colour,
    size_within,
    text_width,
)

TITLE, LABEL = 12.0, 10.0
"""Of fonts [pt]."""

_TICK, _GAP, _SPACE = 3.5, 3.5, 4.0
_ASCENT, _DESCENT = 0.76, 0.24  # of a font's size
_TIGHT = {"x": 30.0, "y": 20.0}
"""Lengths of an axis [pt] for each of its labels."""

_GRID = Look(colour("#b0b0b0", 0.3), 0.8)
_FRAME = Look(colour(BLACK), 0.8)


@dataclass(frozen=True, eq=False)
class Panel:
    """A plot with what its axes show.

    Attributes:
        plot: What is drawn.
        x: Range of the x axis.
        y: Range of the y axis.
        entries: Lines of its legend; none if there is a single thing to name.
        marked: Which of the two axes bear ticks, labels and a name.
    """

    plot: Plot
    x: tuple[float, float]
    y: tuple[float, float]
    entries: tuple[Entry, ...] = ()
    marked: tuple[bool, bool] = (True, True)

    @property
    def plane(self) -> bool:
        """Whether both axes have one scale."""
        return self.plot.time is None

    def above(self) -> float:
        """Room above the axes [pt]."""
        return 6.0 + TITLE if self.plot.title else 6.0

    def below(self) -> float:
        """Room below the axes [pt]."""
        labels = _TICK + _GAP + LABEL + _SPACE + LABEL + 2.0 if self.marked[0] else 0.0
        return labels + (2 * _SPACE + self._under().height if self.plane and self.entries else 0.0)

    def least(self) -> float:
        """Width that a legend below the axes takes [pt]; 0 without one."""
        return self._under().width if self.plane and self.entries else 0.0

    def left(self, height: float) -> float:
        """Room to the left of axes of that height [pt]."""
        if not self.marked[1]:
            return 0.0
        found = self.y_ticks(height)
        labels = _TICK + _GAP + _widest(found) + _SPACE + LABEL + 2.0
        return max(labels, _TICK + text_width(found.factor, LABEL))

    def right(self, height: float) -> float:
        """Room to the right of axes of that height [pt]."""
        if self.entries and not self.plane:
            return _SPACE + fitting(self.entries, height).width
        return 2 * _SPACE if self.marked[0] else 0.0  # its last label sticks out

    def y_ticks(self, height: float) -> Ticks:
        """Marked values of axes of that height [pt]."""
        return ticks(*self.y, int(height / _TIGHT["y"]))

    def x_ticks(self, width: float) -> Ticks:
        """Marked values of axes of that width [pt]: as many as their labels leave room for."""
        most = int(width / _TIGHT["x"])
        found = ticks(*self.x, most)
        fit = int(width / (_widest(found) + _SPACE))
        return ticks(*self.x, fit) if fit < min(most, len(found.values)) else found

    def _under(self) -> Legend:
        return Legend(self.entries, 2)

    def marks(self, cell: Box) -> Iterator[Mark]:
        """Draw it, its axes as large as the cell, or as one scale lets them be."""
        box = self._scaled(cell) if self.plane else cell
        yield from _things(self, box)
        yield from _axes(self, box)
        if self.plot.title:
            middle = (box.left + box.right) / 2
            size = size_within(self.plot.title, TITLE, cell.width)
            yield Text(middle, box.top + 6.0, self.plot.title, size, 0.5)
        if self.entries and self.plane:
            legend = self._under()
            left = (box.left + box.right - legend.width) / 2
            bottom = box.bottom - _TICK - _GAP - 2 * LABEL - 2 * _SPACE - 2.0
            yield from legend.marks(left, bottom - _SPACE)
        elif self.entries:
            legend = fitting(self.entries, cell.height)
            yield from legend.marks(box.right + _SPACE, (box.bottom + box.top + legend.height) / 2)

    def _scaled(self, cell: Box) -> Box:
        """The largest box in a cell whose sides are as the ranges of its axes."""
        x, y = self.x[1] - self.x[0], self.y[1] - self.y[0]
        unit = min(cell.width / x, cell.height / y)
        half, tall = unit * x / 2, unit * y / 2
        middle, centre = (cell.left + cell.right) / 2, (cell.bottom + cell.top) / 2
        return Box(middle - half, centre - tall, middle + half, centre + tall)

    def at(self, box: Box, x: Points, y: Points) -> Points:
        """Where values stand on the sheet [pt]: two arrays ``(n,)`` → ``(n, 2)``."""
        right = (np.asarray(x) - self.x[0]) * (box.width / (self.x[1] - self.x[0]))
        up = (np.asarray(y) - self.y[0]) * (box.height / (self.y[1] - self.y[0]))
        return np.stack([box.left + right, box.bottom + up], axis=-1)


def panel(plot: Plot) -> Panel:
    """A plot with axes that show all of it, and a legend that names each thing once."""
    corners = [area.corners for area in plot.areas]
    x = shown(
        [
            *(plot.places(curve) for curve in plot.curves),
            *(corner[:, 0] for corner in corners),
            *(end for band in plot.bands for end in (band.start, band.end)),
        ]
    )
    y = shown(
        [
            *(curve.y for curve in plot.curves),
            *(corner[:, 1] for corner in corners),
            *(limit.value for limit in plot.limits),
        ]
    )
    named: dict[str, Entry] = {}
    for entry in _entries(plot):
        named.setdefault(entry.name, entry)
    return Panel(plot, x, y, tuple(named.values()) if len(named) > 1 else ())


def _entries(plot: Plot) -> Iterator[Entry]:
    for area in plot.areas:
        fill = colour(area.colour, 0.3) if area.filled else None
        stroke = colour(area.colour) if area.edged else None
        yield Entry(area.name, Look(stroke, dash="dot", fill=fill), area=True)
    for band in plot.bands:
        yield Entry(band.name, Look(fill=colour(band.colour, 0.16)), area=True)
    for curve in plot.curves:
        yield Entry(curve.name, _line(plot, curve))
    for limit in plot.limits:
        yield Entry(limit.name, Look(colour(BLACK), dash="dash"))


def _line(plot: Plot, curve: Curve) -> Look:
    width = 1.0 if plot.time is None or curve.marks else 1.5
    return Look(colour(curve.colour), curve.weight * width, curve.dash, marks=curve.marks)


def _things(panel: Panel, box: Box) -> Iterator[Shape]:
    """Areas and stretches of time, the grid over them, then curves and limits."""
    plot, looks = panel.plot, iter([entry.look for entry in _entries(panel.plot)])
    for area in plot.areas:
        corners = panel.at(box, *area.corners.T)
        yield Shape(corners, next(looks), closed=True, clip=box, kind="area")
    for band in plot.bands:
        left, right = panel.at(box, np.array([band.start, band.end]), np.zeros(2))[:, 0]
        stretch = Box(left, box.bottom, right, box.top)
        yield Shape(stretch.corners(), next(looks), closed=True, clip=box, kind="band")
    if all(panel.marked):
        yield from _grid(panel, box)
    for curve in plot.curves:
        points, look = panel.at(box, plot.places(curve), curve.y), next(looks)
        yield Shape(points, look, clip=box, kind="curve")
        alone = points[_alone(points)]
        if len(alone) and not curve.marks:  # no line goes through them
            yield Shape(alone, replace(look, marks="dot", dash="solid"), clip=box, kind="samples")
    for limit in plot.limits:
        ends = panel.at(box, np.array(panel.x), np.full(2, limit.value))
        yield Shape(ends, next(looks), clip=box, snap=True, kind="limit")


def _alone(points: Points) -> NDArray[np.bool_]:
    """Which points have no neighbour that a line could join them to."""
    there = np.pad(np.isfinite(points).all(axis=1), 1)
    return np.asarray(there[1:-1] & ~there[:-2] & ~there[2:])


def _marked(panel: Panel, box: Box) -> tuple[Ticks, Points, Ticks, Points]:
    """Marked values of both axes and where on the axes they stand."""
    none = Ticks((), ())
    x = panel.x_ticks(box.width) if panel.marked[0] else none
    y = panel.y_ticks(box.height) if panel.marked[1] else none
    along = panel.at(box, np.array(x.values), np.full(len(x.values), panel.y[0]))
    up = panel.at(box, np.full(len(y.values), panel.x[0]), np.array(y.values))
    return x, along, y, up


def _grid(panel: Panel, box: Box) -> Iterator[Shape]:
    _, along, _, up = _marked(panel, box)
    yield _strokes(along, (0.0, box.height), _GRID)
    yield _strokes(up, (box.width, 0.0), _GRID)


def _strokes(starts: Points, way: tuple[float, float], look: Look, kind: str = "") -> Shape:
    """Equal strokes from points, as one line with gaps."""
    ends, gaps = starts + np.array(way), np.full_like(starts, np.nan)
    points = np.stack([starts, ends, gaps], axis=1).reshape(-1, 2)
    return Shape(points, look, snap=True, kind=kind)


def _axes(panel: Panel, box: Box) -> Iterator[Mark]:
    """The frame, marked values with their labels, and names of the axes."""
    x, along, y, up = _marked(panel, box)
    middle, centre = (box.left + box.right) / 2, (box.bottom + box.top) / 2
    yield Shape(box.corners(), _FRAME, closed=True, snap=True, kind="frame")
    if panel.marked[0]:
        yield _strokes(along, (0.0, -_TICK), _FRAME, "x_ticks")
        base = box.bottom - _TICK - _GAP - _ASCENT * LABEL
        for (at, _), label in zip(along, x.labels, strict=True):
            yield Text(float(at), base, label, LABEL, 0.5)
        name = base - LABEL - _SPACE
        yield Text(box.right, name, x.factor, LABEL, 1.0)
        yield Text(middle, name, panel.plot.across, LABEL, 0.5)
    if panel.marked[1]:
        yield _strokes(up, (-_TICK, 0.0), _FRAME, "y_ticks")
        beside = box.left - _TICK - _GAP
        for (_, at), label in zip(up, y.labels, strict=True):
            yield Text(beside, float(at) - _ASCENT / 2 * LABEL, label, LABEL, 1.0)
        yield Text(box.left - _TICK, box.top + 6.0, y.factor, LABEL, 1.0)
        name = beside - _widest(y) - _SPACE - _DESCENT * LABEL
        size = size_within(panel.plot.label, LABEL, box.height + panel.above())
        yield Text(name, centre, panel.plot.label, size, 0.5, upright=True)


def _widest(marked: Ticks) -> float:
    return max((text_width(label, LABEL) for label in marked.labels), default=0.0)
