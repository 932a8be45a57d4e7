"""Items of a scene as nodes of meshcat's tree: what each shows, and how it moves and changes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial, singledispatch

import numpy as np
from meshcat import geometry as meshcat
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.pages.meshcat.lines import Begun, bundle, moving, tube
from thesis_pin.pages.meshcat.shapes import (
    UPRIGHT,
    Globe,
    Placed,
    cylinder,
    flat_paint,
    paint,
    rod,
    shares,
    solid,
    surface,
)
from thesis_pin.pages.scene import AXES, Arc, Arrow, Ball, Bars, Item, Polygon, Shape, Trace, Triad

Array = NDArray[np.float64]

SHORTEST = 1e-9
"""Length of an arrow [m] from which on it has a direction."""
SMALLEST_ARC = 1e-3
"""Angle of an arc [rad] from which on it is drawn."""

_PIECES, _SIDES = 48, 5


@dataclass(frozen=True)
class Node:
    """One node of meshcat's tree.

    Attributes:
        path: Below the item, empty for the item's own.
        shape: What it draws; None for a node that only moves others.
        position: In the node above [m], shape ``(n, 3)``; None at its origin.
        quaternion: Likewise, (x, y, z, w), shape ``(n, 4)``.
        scale: Along its own axes, shape ``(n, 3)``.
        visible: Whether it shows, from a sample to the next, shape ``(n,)``.
        colour: Red, green and blue at the nearest sample, shape ``(n, 3)``.
        share: How much is drawn of a :class:`Begun` shape, 0 to 1, shape ``(n,)``.
    """

    path: str
    shape: meshcat.Object | None = None
    position: Array | None = None
    quaternion: Array | None = None
    scale: Array | None = None
    visible: NDArray[np.bool_] | None = None
    colour: Array | None = None
    share: Array | None = None

    def part(self, keep: NDArray[np.intp]) -> Node:
        """The same node at some of its samples."""
        return replace(
            self,
            position=_some(self.position, keep),
            quaternion=_some(self.quaternion, keep),
            scale=_some(self.scale, keep),
            visible=None if self.visible is None else self.visible[keep],
            colour=_some(self.colour, keep),
            share=_some(self.share, keep),
        )


def _some(values: Array | None, keep: NDArray[np.intp]) -> Array | None:
    return None if values is None else values[keep]


@singledispatch
def nodes(item: Item) -> Iterator[Node]:
    """The nodes of an item; a node stands before those below it.

    Args:
        item: Any item of a scene.

    Raises:
        BadInput: An item of another kind.
    """
    raise BadInput(
        f"can't draw a {type(item).__name__} in meshcat",
        where=f"item {item.name!r}",
        allowed="Shape, Ball, Arrow, Bars, Trace, Polygon, Arc and Triad",
    )


@nodes.register
def _shape(item: Shape) -> Iterator[Node]:
    mesh = item.geometry["type"] == "mesh"
    more: dict[str, object] = {"flatShading": True, "shininess": 5} if mesh else {}
    if item.ghost:  # it lies behind what it coincides with, or the two would flicker
        more |= {"polygonOffset": True, "polygonOffsetFactor": 1, "polygonOffsetUnits": 4}
    look = (paint if mesh else solid)(item.colour, item.opacity, **more)
    body = surface(item.geometry, look, item.local)
    position, quaternion, visible = _placed(item.placement)
    yield Node("", body, position, quaternion, visible=visible)


@nodes.register
def _triad(item: Triad) -> Iterator[Node]:
    """Three bars; meshcat has no text, so the name is the path's alone."""
    position, quaternion, visible = _placed(item.placement)
    yield Node("", None, position, quaternion, visible=visible)
    length = float(item.length)
    for axis, colour in enumerate(AXES):
        bar = np.eye(4)
        bar[:3, :3] = np.roll(np.eye(3), 1 - axis, axis=1)  # meshcat's cylinders lie along y
        bar[axis, 3] = length / 2
        bar[:3, :3] *= (1.0, length, 1.0)
        yield Node("xyz"[axis], Placed(rod(0.035 * length, 6), solid(colour), item.local @ bar))


@nodes.register
def _ball(item: Ball) -> Iterator[Node]:
    ball = Placed(Globe(item.radius, 18), solid(item.colours[0]))
    position, visible = held(item.position)
    yield Node("", ball, position, visible=visible, colour=_levels(item.colours, item.level))


@nodes.register
def _arrow(item: Arrow) -> Iterator[Node]:
    position, here = held(item.origin)
    vector, there = held(item.scale * np.asarray(item.vector, dtype=float))
    length = np.linalg.norm(vector, axis=1)
    way, _ = held(np.where(length[:, None] > SHORTEST, vector, np.nan))
    turn = _from_z(way)
    shown = here & there & (np.maximum(length, np.append(length[1:], 0.0)) > SHORTEST)
    length = np.maximum(length, SHORTEST)
    room = np.minimum(7 * item.radius, 0.5 * length) if item.head else np.zeros(len(length))
    shaft = rod(item.radius, 14 if item.head else 6)
    raised = UPRIGHT.copy()
    raised[2, 3] = 0.5
    body = Placed(shaft, solid(item.colour), raised)
    stretch = np.column_stack([np.ones((len(length), 2)), length - room])
    if not item.head:
        yield Node("", body, position, turn, stretch, shown)
        return
    yield Node("", None, position, turn, visible=shown)
    yield Node("shaft", body, scale=stretch)
    high = float(7 * item.radius)
    cone = cylinder(high, 2.6 * item.radius, 0.0)
    lowered = UPRIGHT.copy()
    lowered[2, 3] = -high / 2
    ahead = np.column_stack([np.zeros((len(length), 2)), length])
    size = np.repeat(room[:, None] / high, 3, axis=1)
    yield Node("head", Placed(cone, solid(item.colour), lowered), ahead, scale=size)


@nodes.register
def _bars(item: Bars) -> Iterator[Node]:
    if len(item.ends):
        yield Node("", Placed(bundle(item.ends, item.radius, 6), solid(item.colour)))


@nodes.register
def _trace(item: Trace) -> Iterator[Node]:
    given, _ = held(item.points)
    line, done = moving(given, item.radius)
    if len(line) < 2:
        return
    whole = tube(line, 0.45 * item.radius, 3)
    yield Node("", Placed(whole, flat_paint(item.colour, 0.3)))
    bold = tube(line, item.radius, _SIDES)
    way = Begun(bold, _SIDES, partial(flat_paint, item.colour, side=0))
    yield Node("done", way, share=done / (len(line) - 1))


@nodes.register
def _polygon(item: Polygon) -> Iterator[Node]:
    which = np.asarray(item.which)
    for k, outline in enumerate(item.outlines):
        corners = np.asarray(outline, dtype=float)
        fan = [[0, i, i + 1] for i in range(1, len(corners) - 1)]
        if fan:
            area = Placed(
                meshcat.TriangularMeshGeometry(corners, fan), flat_paint(item.colour, 0.22)
            )
        yield Node(f"outline {k}", area if fan else None, visible=which == k)
        if len(corners) > 1:
            border = tube(corners, item.width / 2, 6, closed=len(corners) > 2)
            yield Node(f"outline {k}/border", Placed(border, flat_paint(item.colour)))


@nodes.register
def _arc(item: Arc) -> Iterator[Node]:
    angle, known = held(np.asarray(item.angle, dtype=float)[:, None])
    size = np.minimum(np.abs(angle[:, 0]), 2 * np.pi)
    position, quaternion, shown = _placed(item.placement)
    shown &= known & (size > SMALLEST_ARC)
    flip = np.where(angle < 0, [[1.0, 0.0, 0.0, 0.0]], [[0.0, 0.0, 0.0, 1.0]])
    turned = _product(quaternion, flip)  # a negative one is seen from the other side
    colour, radius = _levels(item.colours, item.level), float(item.radius)
    yield Node("", None, position, turned, visible=shown)
    around = 2 * np.pi * np.arange(_PIECES + 1) / _PIECES
    circle = radius * np.column_stack([np.cos(around), np.sin(around), np.zeros_like(around)])
    whole = tube(circle, 0.07 * radius, _SIDES)
    ring = Begun(whole, _SIDES, partial(solid, item.colours[0]))
    yield Node("ring", ring, colour=colour, share=size / (2 * np.pi))
    tip = cylinder(0.5 * radius, 0.2 * radius, 0.0)
    out = np.eye(4)
    out[0, 3] = radius  # a cone along y: forwards on the circle
    half, none = size / 2, np.zeros(len(size))
    spin = np.column_stack([none, none, np.sin(half), np.cos(half)])
    yield Node("head", Placed(tip, solid(item.colours[0]), out), quaternion=spin, colour=colour)


def held(values: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Samples with the last known one where one isn't known, and from where to where they are.

    Args:
        values: NaN where nothing is known, shape ``(n, d)``.

    Returns:
        The samples; and whether one and the next are known, shape ``(n,)``.
    """
    values = np.array(values, dtype=float)
    known: NDArray[np.bool_] = np.asarray(np.isfinite(values).all(axis=1))
    if not known.any():
        return np.zeros_like(values), known
    last = np.maximum.accumulate(np.where(known, np.arange(len(values)), -1))
    last = np.where(last < 0, np.argmax(known), last)
    shown = known.copy()
    shown[:-1] &= known[1:]
    return values[last], shown


def _placed(placement: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Positions, unit quaternions, and from where to where both are known."""
    values, shown = held(placement)
    turn = values[:, 3:]
    size = np.linalg.norm(turn, axis=1, keepdims=True)
    turn = np.where(size > 0, turn / np.where(size > 0, size, 1.0), (0.0, 0.0, 0.0, 1.0))
    return values[:, :3], turn, shown


def _levels(colours: tuple[str, ...], level: Array | None) -> Array | None:
    if level is None or len(colours) == 1:
        return None
    known = np.nan_to_num(np.asarray(level, dtype=float)).astype(int)
    return np.asarray(np.array([shares(colour) for colour in colours])[known])


def _from_z(way: Array) -> Array:
    """Rotations that bring z to vectors the short way, ``(n, 3)`` → ``(n, 4)``."""
    size = np.linalg.norm(way, axis=1)
    x, y, z = (way / np.where(size > 0, size, 1.0)[:, None]).T
    turn = np.column_stack([-y, x, np.zeros_like(z), 1 + z])
    turn[np.abs(turn).max(axis=1) == 0] = (1.0, 0.0, 0.0, 0.0)
    return np.asarray(turn / np.linalg.norm(turn, axis=1, keepdims=True))


def _product(first: Array, second: Array) -> Array:
    """Products of quaternions (x, y, z, w)."""
    a, b = first[:, :3], second[:, :3]
    vector = first[:, 3:] * b + second[:, 3:] * a + np.cross(a, b)
    real = first[:, 3] * second[:, 3] - np.einsum("ni,ni->n", a, b)
    return np.column_stack([vector, real])
