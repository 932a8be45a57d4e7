"""Lines as meshcat's objects: tubes, of which only the beginning may be drawn, and grids."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from meshcat import geometry as meshcat
from numpy.typing import ArrayLike, NDArray

from thesis_pin.pages.meshcat.shapes import Placed, skin

Array = NDArray[np.float64]

_FADING, _ROUNDING = 1 / 64, 1e-4  # too little to be seen, and enough for 32 bits


def tube(points: ArrayLike, radius: float, sides: int, *, closed: bool = False) -> meshcat.Geometry:
    """A tube along a line.

    Args:
        points: The line, shape ``(m, 3)`` with m at least 2, without points at rest.
        radius: Of the tube [m].
        sides: Of its cross-section.
        closed: Whether the last point leads to the first.
    """
    line = np.asarray(points, dtype=float)
    around = np.concatenate([line[-1:], line, line[:1]]) if closed else line
    along = np.gradient(around, axis=0)[1:-1] if closed else np.gradient(line, axis=0)
    back = np.flatnonzero(~along.any(axis=1))  # where a line turns back on itself
    along[back] = line[back] - line[back - 1]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.empty_like(line)
    last = np.eye(3)[np.argmin(np.abs(along[0]))]
    for k, way in enumerate(along):  # turned as little as the line asks for
        last = last - (last @ way) * way
        size = float(np.linalg.norm(last))
        last = last / size if size else np.eye(3)[np.argmin(np.abs(way))]
        across[k] = last
    other = np.cross(along, across)
    turn = (2 * np.pi * np.arange(sides) / sides)[:, None]
    rings = line[:, None] + radius * (
        np.cos(turn) * across[:, None] + np.sin(turn) * other[:, None]
    )
    if closed:
        rings = np.concatenate([rings, rings[:1]])
    return meshcat.TriangularMeshGeometry(rings.reshape(-1, 3), skin(len(rings), sides))


def bundle(ends: ArrayLike, radius: float, sides: int) -> meshcat.Geometry:
    """Several straight tubes as one body.

    Args:
        ends: Of each, shape ``(k, 2, 3)``.
        radius: Of the tubes [m].
        sides: Of their cross-section.
    """
    parts = [tube(one, radius, sides) for one in np.asarray(ends, dtype=float)]
    points = np.concatenate([one.vertices for one in parts])
    faces = np.concatenate([one.faces + 2 * sides * k for k, one in enumerate(parts)])
    return meshcat.TriangularMeshGeometry(points, faces)


_STRAIGHT, _REST = 0.25, 0.1  # of the radius: what bends less is straight, what moves less rests
_PIECES = 200  # of which none is longer, so that the way so far grows steadily


def moving(points: ArrayLike, radius: float) -> tuple[Array, Array]:
    """A line by the points that show, and how many of its pieces lie before each sample.

    Args:
        points: The line, shape ``(n, 3)``, finite.
        radius: Of its tube [m].

    Returns:
        Points between which the line is straight to a quarter of the radius, shape ``(m, 3)``,
        one if it rests; and the way done at each sample, in pieces, shape ``(n,)``.
    """
    line = np.asarray(points, dtype=float)
    longest = np.linalg.norm(np.diff(line, axis=0), axis=1).sum() / _PIECES
    kept = [0]
    for k in range(1, len(line)):
        last = kept[-1]
        if np.linalg.norm(line[k - 1] - line[last]) > _REST * radius and (
            np.linalg.norm(line[k] - line[last]) > longest
            or _bend(line[last : k + 1]) > _STRAIGHT * radius
        ):
            kept.append(k - 1)
    if np.linalg.norm(line[-1] - line[kept[-1]]) > _REST * radius:
        kept.append(len(line) - 1)
    if len(kept) == 1:
        return line[kept], np.zeros(len(line))
    piece = np.clip(np.searchsorted(kept, np.arange(len(line)), side="right") - 1, 0, len(kept) - 2)
    begin, end = line[kept][piece], line[kept][piece + 1]
    share = np.linalg.norm(line - begin, axis=1) / np.linalg.norm(end - begin, axis=1)
    return line[kept], piece + np.minimum(share, 1.0)


def _bend(line: Array) -> float:
    """How far points lie from the straight piece between the first and the last [m]."""
    way = line[-1] - line[0]
    square = float(way @ way)
    share = np.clip((line - line[0]) @ way / square, 0.0, 1.0) if square else np.zeros(len(line))
    return float(np.linalg.norm(line - line[0] - share[:, None] * way, axis=1).max())


class Begun(Placed):
    """A tube of which only the beginning is drawn: an arc, or the way so far.

    Its corners grow a little more transparent towards its end, and what is more transparent
    than a threshold isn't drawn: one number that an animation can change.

    Args:
        whole: The tube, of :func:`tube`.
        sides: Of its cross-section.
        material: Makes its look, with the words it is given.
        share: How much of it is drawn, 0 to 1.
    """

    def __init__(
        self,
        whole: meshcat.Geometry,
        sides: int,
        material: Callable[..., meshcat.Material],
        share: float = 1.0,
    ) -> None:
        done = np.repeat(np.linspace(0.0, 1.0, len(whole.vertices) // sides), sides)
        fading = 1.0 - _FADING * done
        whole.color = np.column_stack([np.ones((len(done), 3)), fading]).astype(np.float32)
        super().__init__(whole, material(vertexColors=True, alphaTest=float(threshold(share))))
        self._makers = sides, material

    def at(self, share: float) -> Begun:
        """The same tube, drawn so far."""
        return Begun(self.geometry, *self._makers, share)


def threshold(share: ArrayLike) -> Array:
    """Opacity below which a :class:`Begun` tube isn't drawn."""
    return np.asarray(1.0 - _FADING * (np.asarray(share, dtype=float) - _ROUNDING))


def grid(width: float, spacing: float, middle: ArrayLike, height: float) -> meshcat.LineSegments:
    """Lines on a horizontal floor.

    Args:
        width: Of the floor [m].
        spacing: Between lines [m].
        middle: About where its middle is, shape ``(2,)``; lines stay at multiples of the spacing.
        height: Of the floor [m].
    """
    x0, y0 = np.round(np.asarray(middle, dtype=float) / spacing) * spacing
    half = np.ceil(width / spacing / 2) * spacing
    steps = np.arange(-half, half + spacing / 2, spacing)
    ends = [
        *((x0 + step, y0 + side, height) for step in steps for side in (-half, half)),
        *((x0 + side, y0 + step, height) for step in steps for side in (-half, half)),
    ]
    lines = meshcat.PointsGeometry(np.array(ends, dtype=np.float32).T)
    return meshcat.LineSegments(lines, meshcat.LineBasicMaterial(color=0xA9B1B9))
