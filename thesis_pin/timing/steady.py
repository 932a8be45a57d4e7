"""Laws on a grid whose tool speed is constant, or as constant as the limits allow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from thesis_pin.errors import Infeasible, TrajectoryError
from thesis_pin.timing.fastest import fastest
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.rows import Array, Rows
from thesis_pin.timing.track import Grid, Values
from thesis_pin.tolerances import TOLERANCES

_HALVINGS = 24
_EVEN = 1e-3  # how far the tool's speed may be off between places, as a share


def steady(grid: Grid, limits: Limits) -> Law:
    """The largest constant tool speed, from beginning to end.

    Args:
        grid: Places on a track without corners, along which the tool moves.
        limits: Kept at all of them.

    Raises:
        TrajectoryError: The path has a corner, or the tool turns on the spot.
        Infeasible: At rest a limit is exceeded somewhere.
    """
    if grid.track.stops[1:-1].any():
        corner = int(np.flatnonzero(grid.track.stops[1:-1])[0]) + 1
        raise TrajectoryError(
            "the path has a corner, where a constant tool speed can't be kept",
            where=f"end of piece {corner}",
            remedy="Round it off, or ask for another law",
        )
    sides, every = grid.sides(), grid.every
    speed = min(
        _fastest_speed(limits.rows(one), one, at)
        for one, at in zip(sides, (every[:-1], every[1:]), strict=True)
    )
    size = np.append(_size(sides[0]), _size(sides[1])[-1])
    return Law(every, speed / size)


def even(grid: Grid) -> Grid:
    """A grid on which the speed of the tool is a constant's between places too."""
    for _ in range(_HALVINGS):
        finer = grid.finer([np.full(len(one) - 1, 2) for one in grid.places])
        bad = []
        for known in finer.values:
            slow = 1.0 / _size(known) ** 2
            middle = (slow[:-1:2] + slow[2::2]) / 2
            bad.append(np.abs(middle / slow[1::2] - 1.0) > 2 * _EVEN)
        if not any(one.any() for one in bad):
            break
        grid = grid.finer([1 + one.astype(int) for one in bad])
    return grid


def _size(values: Values) -> Array:
    size = np.linalg.norm(values.velocity, axis=1)
    if (size <= TOLERANCES.step).any():
        raise TrajectoryError(
            "the tool turns on the spot, where a tool speed gives no time",
            remedy="Ask for another law",
        )
    return np.asarray(size)


def _fastest_speed(rows: Rows, values: Values, at: Array) -> float:
    """The largest tool speed up to which each keeps the limits at all places.

    At a tool speed w, ṡ = w / |x′| and s̈ = −w² x′·x″ / |x′|⁴: each row is a parabola of w.
    """
    if (rows.rest > 1.0).any():
        place, row = np.unravel_index(int(rows.rest.argmax()), rows.rest.shape)
        raise Infeasible(rows.names[row], float(rows.rest[place, row]), float(at[place]))
    size = _size(values)[:, None]
    bend = -(values.velocity * values.curvature).sum(axis=1, keepdims=True) / size**4
    second = rows.acceleration * bend + rows.square / size**2
    first, left = rows.rate / size, 1.0 - rows.rest
    # The first w > 0 at which second w² + first w = left; in this form nothing cancels.
    inside = first**2 + 4 * second * left
    with np.errstate(divide="ignore", invalid="ignore"):
        root = 2 * left / (first + np.sqrt(inside))
    root = np.where((inside < 0) | (first + np.sqrt(np.maximum(inside, 0)) <= 0), np.inf, root)
    found = float(root.min(initial=np.inf))
    if rows.speed.shape[1]:
        with np.errstate(divide="ignore"):
            found = min(found, float((size / rows.speed.max(axis=1, keepdims=True)).min()))
    return found


def kept(grid: Grid, law: Law, speed: float, share: float) -> float:
    """On which share of the way the tool moves at a speed, up to a share of it.

    Args:
        grid: The law's.
        law: A law.
        speed: Of the tool [m/s].
        share: How much slower still counts.
    """
    left, right = (np.linalg.norm(one.velocity, axis=1) for one in grid.sides())
    width = np.diff(law.place)
    slow = np.minimum(left * law.rate[:-1], right * law.rate[1:])
    way = width * (left + right) / 2
    return float(way[slow >= speed * (1.0 - share)].sum() / way.sum())


def windowed(grid: Grid, limits: Limits, window: float, share: float) -> tuple[Law, float]:
    """The largest tool speed that is kept within a window on a share of the way.

    The tool never moves faster; it is slower where another limit binds, and near rests.

    Args:
        grid: Places on a track.
        limits: Kept at all of them.
        window: How much slower still counts, as a share of the speed.
        share: Of the way on which the speed has to be kept.

    Returns:
        The law, and the speed [m/s].

    Raises:
        TrajectoryError: So much of the way lies near rests that no speed is kept.
    """
    top = limits.tool_speed
    if top is None:
        law = fastest(grid, limits)
        sides = grid.sides()
        top = max(
            float((np.linalg.norm(one.velocity, axis=1) * rate).max())
            for one, rate in zip(sides, (law.rate[:-1], law.rate[1:]), strict=True)
        )

    if not top > 0:
        raise TrajectoryError(
            "the tool turns on the spot, where a tool speed gives no time",
            remedy="Ask for another law",
        )

    def at(speed: float) -> tuple[Law, bool]:
        law = fastest(grid, replace(limits, tool_speed=speed))
        return law, kept(grid, law, speed, window) >= share

    law, yes = at(top)
    if yes:
        return law, top
    low, high, best = np.log(top) - 12.0, np.log(top), None
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        law, yes = at(float(np.exp(middle)))
        if yes:
            low, best = middle, law
        else:
            high = middle
        if best is not None and high - low < _NEAR:
            break
    if best is None:
        raise TrajectoryError(
            f"no tool speed is kept within {window:.3g} of itself on {share:.3g} of the way",
            remedy="Ask for less of the way, or a wider window",
        )
    return best, float(np.exp(low))


_NEAR = 1e-4  # relative difference of two speeds that ends the search
