"""What a scene can hold: shapes, balls, arrows, traces, areas, arcs and frames, over its time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from thesis_pin.display.brief import Brief

GREY = "#9AA0A6"

AXES = ("#D55E00", "#009E73", "#0072B2")
"""Colours of a frame's axes x, y, z; colour-blind readers can tell them apart."""

Shapes = Mapping[str, tuple[int, ...]]
"""Names of arrays and their shapes."""


@dataclass(frozen=True)
class Item(Brief):
    """Common to everything that is drawn.

    Attributes:
        name: Unique name.
        group: Name of its :class:`Group`.
    """

    name: str
    group: str

    sampled: ClassVar[Shapes] = {}
    """Attributes that change over time, and their shapes; -1 stands for the scene's samples."""

    def arrays(self) -> dict[str, np.ndarray]:
        """What changes over time: the attributes in :attr:`sampled` that aren't None."""
        given = {name: getattr(self, name) for name in self.sampled}
        return {name: np.asarray(array) for name, array in given.items() if array is not None}

    def constants(self) -> dict[str, object]:
        """What doesn't change: JSON-ready or arrays."""
        own = (name for name in vars(self) if name not in ("name", "group", *self.sampled))
        return {name: getattr(self, name) for name in own}

    def document(self) -> dict[str, object]:
        """Its kind and all of it, as the player takes it."""
        kind = type(self).__name__.lower()
        words = {"kind": kind, "name": self.name, "group": self.group}
        return {**words, **self.constants(), "samples": self.arrays()}


@dataclass(frozen=True)
class Shape(Item):
    """A rigid shape.

    Attributes:
        geometry: ``{"type": "box", "size": …}``, ``cylinder`` and ``capsule`` and ``cone``
            (``radius``, ``length``, along z), ``ellipsoid`` (``radii``) or ``mesh``
            (``vertices`` ``(v, 3)``, ``faces`` ``(f, 3)``).
        placement: Position and quaternion (x, y, z, w) over time, shape ``(n, 7)``.
        local: The shape's placement in the moving frame, shape ``(4, 4)``.
        colour: ``#rrggbb``.
        opacity: 0 to 1.
        ghost: Whether it gives way to what it coincides with and throws no shadow.
    """

    sampled: ClassVar[Shapes] = {"placement": (-1, 7)}

    geometry: Mapping[str, object]
    placement: np.ndarray
    local: np.ndarray
    colour: str = GREY
    opacity: float = 1.0
    ghost: bool = False

    def corners(self) -> np.ndarray:
        """Corners of a box about it in the moving frame [m], shape ``(8, 3)``."""
        shape = self.geometry
        if "vertices" in shape:
            vertices = np.asarray(shape["vertices"], dtype=float)
            low, high = vertices.min(axis=0), vertices.max(axis=0)
        else:
            half = np.asarray(
                shape.get("radii", np.asarray(shape.get("size", 0.0)) / 2), dtype=float
            )
            if "radius" in shape:
                radius, length = np.asarray([shape["radius"], shape["length"]], dtype=float)
                half = np.array([radius, radius, length / 2 + radius])
            low, high = -half, half
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
        local = np.asarray(self.local)
        return np.asarray((low + corners * (high - low)) @ local[:3, :3].T + local[:3, 3])


@dataclass(frozen=True)
class Ball(Item):
    """A point, drawn as a ball.

    Attributes:
        position: Centre, shape ``(n, 3)``.
        radius: Its radius [m].
        colours: One colour, or several that ``level`` chooses from.
        level: Index into ``colours`` over time, shape ``(n,)``; None for the first.
    """

    sampled: ClassVar[Shapes] = {"position": (-1, 3), "level": (-1,)}

    position: np.ndarray
    radius: float
    colours: tuple[str, ...]
    level: np.ndarray | None = None


@dataclass(frozen=True)
class Arrow(Item):
    """A vector: its tip is at ``origin + scale · vector``.

    Attributes:
        origin: Where it starts, shape ``(n, 3)``.
        vector: What it shows, in its own unit, shape ``(n, 3)``.
        scale: Metres drawn for one unit.
        radius: Radius of the shaft [m].
        colour: ``#rrggbb``.
        head: False draws a bar without a tip.
    """

    sampled: ClassVar[Shapes] = {"origin": (-1, 3), "vector": (-1, 3)}

    origin: np.ndarray
    vector: np.ndarray
    scale: float
    radius: float
    colour: str
    head: bool = True


@dataclass(frozen=True)
class Bars(Item):
    """Bars that stand still, drawn as one body: many of them cost as much as a few.

    Attributes:
        ends: Of each bar, shape ``(k, 2, 3)``, finite.
        radius: Their radius [m].
        colour: ``#rrggbb``.
    """

    ends: np.ndarray
    radius: float
    colour: str


@dataclass(frozen=True)
class Trace(Item):
    """The way of a point: the whole of it faint, what has been covered bold.

    Attributes:
        points: Shape ``(n, 3)``.
        radius: Radius of the line [m].
        colour: ``#rrggbb``.
    """

    sampled: ClassVar[Shapes] = {"points": (-1, 3)}

    points: np.ndarray
    radius: float
    colour: str


@dataclass(frozen=True)
class Polygon(Item):
    """A flat, convex area that changes from sample to sample among a few outlines.

    Attributes:
        outlines: Corners in order, each ``(k, 3)``.
        which: Index of the outline over time, -1 for none, shape ``(n,)``.
        colour: ``#rrggbb``.
        width: Width of its border [m].
    """

    sampled: ClassVar[Shapes] = {"which": (-1,)}

    outlines: tuple[np.ndarray, ...]
    which: np.ndarray
    colour: str
    width: float


@dataclass(frozen=True)
class Arc(Item):
    """A turning arrow about the z axis of a moving frame, such as a torque.

    Attributes:
        placement: Position and quaternion (x, y, z, w) of the frame, shape ``(n, 7)``.
        angle: Signed length of the arc [rad], at most 2π, shape ``(n,)``.
        radius: Its radius [m].
        colours: One colour, or several that ``level`` chooses from.
        level: Index into ``colours`` over time, shape ``(n,)``; None for the first.
    """

    sampled: ClassVar[Shapes] = {"placement": (-1, 7), "angle": (-1,), "level": (-1,)}

    placement: np.ndarray
    angle: np.ndarray
    radius: float
    colours: tuple[str, ...]
    level: np.ndarray | None = None


@dataclass(frozen=True)
class Triad(Item):
    """A frame: its axes x, y, z in vermillion, green, blue, with its name beside it.

    Attributes:
        placement: Position and quaternion (x, y, z, w) over time, shape ``(n, 7)``.
        local: The frame's placement in the moving frame, shape ``(4, 4)``.
        length: Of an axis [m].
        label: Its name; empty for none.
    """

    sampled: ClassVar[Shapes] = {"placement": (-1, 7)}

    placement: np.ndarray
    local: np.ndarray
    length: float
    label: str = ""
