"""Cells of a grid closed one from another, so that the robot stays in one assembly.

A wave goes out from the cell beside the pose: every cell is closed from a neighbour along the
tangent there. What comes out counts if the way is the tangent's as nearly as its curvature
explains; where it isn't, the way is gone again in smaller steps, and at last called a jump
into another assembly.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
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
    count, nq, nv = len(points), led.view.model.nq, led.view.model.nv
    q = np.full((count, nq), np.nan)
    along = np.zeros((count, nv, points.shape[1]))
    sign, state = np.zeros(count), np.full(count, CUT_OFF, dtype=np.int8)
    first = _first(led, points)
    if first is None:
        return Wave(q, np.full(count, OPEN, dtype=np.int8), 0)
    cell, q[cell] = first
    tangent, good, signs = led.tangents(q[cell][None], points[cell][None])
    along[cell], sign[cell] = tangent[0], signs[0]
    state[cell] = CLOSED if good[0] else SINGULAR
    front = np.array([cell] if good[0] else [], dtype=np.intp)
    while front.size:
        new: list[Places] = []
        for a, b in _blocks(_pairs(led.grid.shape, front, state), state):
            found, tangents, signs, became = _gone(
                led, (q[a], along[a], sign[a]), points[a], points[b]
            )
            better = became > state[b]
            state[b[better]] = became[better]
            done = became >= SINGULAR
            q[b[done]] = found[done]
            along[b[done]], sign[b[done]] = tangents[done], signs[done]
            new.append(b[became == CLOSED])
            progress(int((state != CUT_OFF).sum()), count)
        front = np.concatenate(new) if new else np.empty(0, dtype=np.intp)
    progress(count, count)
    return Wave(q, state, _seams(led, points, q, along, state))


def _first(led: Led, points: Array) -> tuple[int, Array] | None:
    """The nearest cell that a straight way from the pose leads to, and the configuration there."""
    view = led.view
    size = np.array([view.scale.length if axis.unit == "m" else 1.0 for axis in led.grid.axes])
    far = np.abs((points - led.start) / size).max(axis=1)
    for cell in np.argsort(far, kind="stable")[:_TRIED]:
        q = led.q
        ends = led.way(1, points[cell])[0] - led.way(2, points[cell])[0]
        steps = max(int(np.ceil(2 * np.abs(ends).max() / _STRIDE / min(1.0, size.min()))), 1)
        for values in led.way(min(steps, 1000), points[cell]):
            q, good = led.patiently(led.placed(q[None], values[None], held=False)[0])
            if not good:
                break
        else:
            return int(cell), q
    return None


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


def _gone(
    led: Led, here: tuple[Array, Array, Array], start: Array, end: Array
) -> tuple[Array, Array, Array, NDArray[np.int8]]:
    """From cells to their neighbours: configurations, tangents, signs, and what became of them."""
    count = len(start)
    found = tuple(part.copy() for part in here)
    became = np.full(count, OPEN, dtype=np.int8)
    todo = np.arange(count)
    for parts in _FINER:
        now = tuple(part[todo].copy() for part in here)
        alive = np.arange(len(todo))
        fate = np.full(len(todo), CLOSED, dtype=np.int8)
        for step in range(1, parts + 1):
            values = start[todo] + (end[todo] - start[todo]) * step / parts
            way = (end[todo] - start[todo]) / parts
            some, result = _step(led, tuple(part[alive] for part in now), way[alive], values[alive])
            for part, new in zip(now, some, strict=True):
                part[alive] = new
            fate[alive] = result
            if step < parts:  # what isn't closed half-way says nothing of the cell itself
                fate[alive[result != CLOSED]] = OPEN
            alive = alive[result == CLOSED]
            if not alive.size:
                break
        better = fate > became[todo]
        for part, new in zip(found, now, strict=True):
            part[todo[better]] = new[better]
        became[todo[better]] = fate[better]
        todo = todo[fate < SINGULAR]
        if not todo.size:
            break
    q, tangents, signs = found
    return q, tangents, signs, became


def _step(
    led: Led, here: tuple[Array, ...], way: Array, values: Array
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
            found += bool(np.linalg.norm(missed) > size + 0.1)
    return found
