"""Cells of a grid closed one from another, so that the robot stays in one assembly.

A wave goes out from the cell beside the pose: every cell is closed from a neighbour along the
tangent there. What comes out counts if the way is the tangent's as nearly as its curvature
explains; where it isn't, the way is gone again in smaller steps, and at last called a jump
into another assembly.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.joints import singles
from thesis_pin.loops.workspace.leading import Led
from thesis_pin.numeric.arrays import wrap

Array = NDArray[np.float64]
Places = NDArray[np.intp]
Cells = NDArray[np.bool_]

CUT_OFF, OPEN, OTHER, SINGULAR, CLOSED = range(5)
"""What became of a cell: nothing led there, loops stay open, only a jump leads there, closed
where what leads doesn't determine the joints, closed. The larger counts where ways differ."""

_CURVED = 0.5
"""Share of a step by which the tangent may miss it. Where two assemblies meet, joints move as
the root of the distance: on the same side of the fold the tangent misses less than half of the
step, and on the other side more, however far the step goes."""

_NEAR = 1e-3  # what it may miss it by in any case [rad], or relative to the robot's size
_FINER = (1, 4, 16)  # parts of the way between two cells, if need be
_SEAM = 0.1  # what neighbours' joints may differ by beyond that [rad], or relative to the size
_TRIED = 40  # cells that are looked for from the pose
_STRIDE = 0.05  # steps of that way [rad], or relative to the robot's size
_BLOCK = 2048  # cells at once, so that memory stays bounded


@dataclass(frozen=True, eq=False)
class Wave:
    """Where a wave came to.

    Attributes:
        q: Configurations of the view; NaN where none is, shape ``(cells, nq)``.
        state: One of the module's words, shape ``(cells,)``.
        seams: Pairs of neighbours that are closed and still not each other's continuation.
    """

    q: Array
    state: NDArray[np.int8]
    seams: int


def spread(led: Led, progress: Callable[[int, int], None]) -> Wave:
    """Close every cell of a grid that a way through the grid leads to from a pose.

    Args:
        led: The robot and its grid.
        progress: Told the cells that are decided and their total.
    """
    points = led.grid.points
    first = _first(led, points)
    if first is None:
        return Wave(
            np.full((len(points), led.view.model.nq), np.nan),
            np.full(len(points), OPEN, dtype=np.int8),
            0,
        )
    cells = _Cells(led, points)
    front = cells.begin(*first)
    waiting: list[tuple[Places, Places]] = []
    for parts in _FINER:
        # Ways that fail are gone again in smaller steps when no other way is left, all at once.
        failed = waiting
        waiting = []
        while front.size or failed:
            ways = _blocks(failed or _pairs(led.grid.shape, front, cells.state), cells.state)
            failed, new = [], list[Places]()
            for a, b in ways:
                became = cells.go(a, b, parts)
                new.append(b[became == CLOSED])
                waiting.append((b[became < SINGULAR], a[became < SINGULAR]))
                progress(int((cells.state != CUT_OFF).sum()), len(points))
            front = np.concatenate(new) if new else np.empty(0, dtype=np.intp)
        waiting = [_joined(waiting)] if waiting else []
    progress(len(points), len(points))
    return Wave(cells.q, cells.state, _seams(led, points, cells.q, cells.along, cells.state))


def _joined(ways: list[tuple[Places, Places]]) -> tuple[Places, Places]:
    """Several ways as one list."""
    ends, starts = zip(*ways, strict=True)
    return np.concatenate(ends), np.concatenate(starts)


class _Cells:
    """What is known of every cell of a grid.

    Args:
        led: The robot and its grid.
        points: Values of the axes in every cell, shape ``(cells, axes)``.
    """

    def __init__(self, led: Led, points: Array) -> None:
        count, model = len(points), led.view.model
        self.led, self.points = led, points
        self.q = np.full((count, model.nq), np.nan)
        self.along = np.zeros((count, model.nv, points.shape[1]))
        self.sign, self.state = np.zeros(count), np.full(count, CUT_OFF, dtype=np.int8)

    def begin(self, cell: int, q: Array) -> Places:
        """Take a first cell as closed; it is the front, unless it is singular."""
        tangent, good, signs = self.led.tangents(q[None], self.points[cell][None])
        self.q[cell], self.along[cell], self.sign[cell] = q, tangent[0], signs[0]
        self.state[cell] = CLOSED if good[0] else SINGULAR
        return np.array([cell] if good[0] else [], dtype=np.intp)

    def go(self, start: Places, end: Places, parts: int) -> NDArray[np.int8]:
        """Go from cells to their neighbours in some steps; says what became of these."""
        here = [self.q[start], self.along[start], self.sign[start]]
        alive, fate = np.arange(len(start)), np.full(len(start), CLOSED, dtype=np.int8)
        begin, way = self.points[start], (self.points[end] - self.points[start]) / parts
        for step in range(1, parts + 1):
            values = begin[alive] + step * way[alive]
            values = self.points[end[alive]] if step == parts else values
            some, result = _step(self.led, [part[alive] for part in here], way[alive], values)
            for part, new in zip(here, some, strict=True):
                part[alive] = new
            fate[alive] = result
            if step < parts:  # what isn't closed half-way says nothing of the cell itself
                fate[alive[result != CLOSED]] = OPEN
            alive = alive[result == CLOSED]
            if not alive.size:
                break
        better, done = fate > self.state[end], fate >= SINGULAR
        self.state[end[better]] = fate[better]
        self.q[end[done]], self.along[end[done]], self.sign[end[done]] = (
            part[done] for part in here
        )
        return fate


def _first(led: Led, points: Array) -> tuple[int, Array] | None:
    """The nearest cell that a straight way from the pose leads to, and the configuration there.

    A cell that is singular is taken only if no other is found.
    """
    view, spare = led.view, None
    size = np.array([view.scale.length if axis.unit == "m" else 1.0 for axis in led.grid.axes])
    far = np.abs((points - led.start) / size).max(axis=1)
    for cell in np.argsort(far, kind="stable")[:_TRIED]:
        q = led.q
        whole = 2 * np.abs(led.way(1, points[cell])[0] - led.way(2, points[cell])[0]).max()
        steps = max(int(np.ceil(whole / _STRIDE / min(1.0, size.min()))), 1)
        for values in led.way(min(steps, 1000), points[cell]):
            q, good = led.patiently(led.placed(q[None], values[None], held=False)[0])
            if not good:
                break
        else:
            if led.tangents(q[None], points[cell][None])[1][0]:
                return int(cell), q
            spare = spare or (int(cell), q)
    return spare


def _blocks(
    rounds: list[tuple[Places, Places]], state: NDArray[np.int8]
) -> Iterator[tuple[Places, Places]]:
    """Where from and where to, of cells that aren't closed yet when their turn has come."""
    for ends, starts in rounds:
        for begin in range(0, len(ends), _BLOCK):
            a, b = starts[begin : begin + _BLOCK], ends[begin : begin + _BLOCK]
            waiting = state[b] < SINGULAR
            if waiting.any():
                yield a[waiting], b[waiting]


def _pairs(
    shape: tuple[int, ...], front: Places, state: NDArray[np.int8]
) -> list[tuple[Places, Places]]:
    """Cells beside those of a front and where from: each cell once, then other ways to it."""
    places = np.array(np.unravel_index(front, shape))
    ends, starts = [], []
    for axis in range(len(shape)):
        for step in (-1, 1):
            moved = places.copy()
            moved[axis] += step
            inside = (moved[axis] >= 0) & (moved[axis] < shape[axis])
            ends.append(np.ravel_multi_index(tuple(moved[:, inside]), shape))
            starts.append(front[inside])
    end, start = np.concatenate(ends), np.concatenate(starts)
    order = np.argsort(end, kind="stable")
    end, start = end[order], start[order]
    wanted = state[end] < SINGULAR
    end, start = end[wanted], start[wanted]
    first = np.searchsorted(end, end)  # which of the ways to its cell each is
    turn = np.arange(len(end)) - first
    return [(end[turn == k], start[turn == k]) for k in range(int(turn.max(initial=-1)) + 1)]


def _step(
    led: Led, here: Sequence[Array], way: Array, values: Array
) -> tuple[tuple[Array, Array, Array], NDArray[np.int8]]:
    """One step along the tangents, closed and judged."""
    q, along, sign = here
    model, columns = led.view.model, led.view.scale.columns
    move = (along @ way[:, :, None])[:, :, 0]
    guess = np.array([pin.integrate(model, *both) for both in zip(q, move, strict=True)])
    found, closed = led.closed(led.placed(guess, values))
    went = np.array([pin.difference(model, *both) for both in zip(q, found, strict=True)])
    passive = led.view.passive
    missed = np.linalg.norm(((went - move) / columns)[:, passive], axis=1)
    size = np.linalg.norm((went / columns)[:, passive], axis=1)
    straight = missed <= _CURVED * size + _NEAR
    tangents, good, signs = led.tangents(found, values)
    same = (signs == 0) | (sign == 0) | (signs == sign)
    fate = np.where(good, CLOSED, SINGULAR)
    fate[~(straight & same)] = OTHER
    fate[~closed] = OPEN
    return (found, tangents, signs), fate.astype(np.int8)


def _seams(led: Led, points: Array, q: Array, along: Array, state: NDArray[np.int8]) -> int:
    """Neighbours that are closed in different ways: the map winds around something.

    Whole turns of a joint are no difference.
    """
    shape, columns, passive = led.grid.shape, led.view.scale.columns, led.view.passive
    turns = [one.v for one in singles(led.view.model).values() if one.turns]
    cells = np.arange(len(points)).reshape(shape)
    found = 0
    for axis in range(len(shape)):
        if shape[axis] < 2:
            continue
        a = np.take(cells, range(shape[axis] - 1), axis=axis).ravel()
        b = np.take(cells, range(1, shape[axis]), axis=axis).ravel()
        both = (state[a] == CLOSED) & (state[b] == CLOSED)
        for k, j in zip(a[both], b[both], strict=True):
            way = points[j] - points[k]
            went = pin.difference(led.view.model, q[k], q[j])
            went[turns] = wrap(went[turns])
            ahead, back = along[k] @ way, along[j] @ way
            missed = ((went - (ahead + back) / 2) / columns)[passive]
            size = max(np.linalg.norm((x / columns)[passive]) for x in (ahead, back))
            if np.linalg.norm(missed) > size + _SEAM:  # how far rods have spun says nothing
                found += bool(np.linalg.norm(led.without_idle(q[k], missed)) > size + _SEAM)
    return found
