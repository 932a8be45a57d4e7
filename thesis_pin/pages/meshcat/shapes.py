"""Surfaces and lines as meshcat's objects; all that is drawn in meshcat is one of these."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import cast

import numpy as np
import umsgpack
from meshcat import geometry as meshcat
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

UPRIGHT = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
"""Turns three.js's cylinders and cones, which lie along y, to z."""

_ROUND, _CAP = 24, 8
_FADING, _ROUNDING = 1 / 64, 1e-4  # too little to be seen, and enough for 32 bits


class Placed(meshcat.Mesh):  # type: ignore[misc] # meshcat has no types
    """A mesh with a place of its own within the node that moves it.

    Args:
        geometry: The surface.
        material: Its look.
        place: Where it is within the node, shape ``(4, 4)``.
    """

    def __init__(
        self, geometry: meshcat.Geometry, material: meshcat.Material, place: ArrayLike | None = None
    ) -> None:
        super().__init__(geometry, material)
        self.place = np.eye(4) if place is None else np.asarray(place, dtype=float)

    def lower(self) -> dict[str, object]:
        """What the page is sent; matrices by columns, as three.js reads them."""
        data = cast(dict[str, dict[str, object]], super().lower())
        data["object"]["matrix"] = self.place.T.ravel().tolist()
        return cast(dict[str, object], data)


def paint(colour: str, opacity: float = 1.0, **more: object) -> meshcat.Material:
    """A lit surface of a colour, as ``#rrggbb``."""
    kind = meshcat.MeshPhongMaterial if more.get("flatShading") else meshcat.MeshLambertMaterial
    if opacity < 1.0:
        more["depthWrite"] = False
    return kind(color=number(colour), opacity=opacity, **more)


def flat_paint(colour: str, opacity: float = 1.0, **more: object) -> meshcat.Material:
    """A surface that no light changes."""
    if opacity < 1.0:
        more["depthWrite"] = False
    return meshcat.MeshBasicMaterial(color=number(colour), opacity=opacity, **more)


def number(colour: str) -> int:
    """``#rrggbb`` as meshcat counts colours."""
    return int(colour.removeprefix("#"), 16)


def shares(colour: str) -> tuple[float, float, float]:
    """Red, green and blue of ``#rrggbb``, each from 0 to 1."""
    value = number(colour)
    return (value >> 16) / 255, (value >> 8 & 255) / 255, (value & 255) / 255


def surface(geometry: Mapping[str, object], material: meshcat.Material, place: ArrayLike) -> Placed:
    """A :class:`thesis_pin.pages.scene.Shape`'s geometry as an object.

    Args:
        geometry: See :class:`thesis_pin.pages.scene.Shape`.
        material: Its look.
        place: Its placement in the moving frame, shape ``(4, 4)``.
    """
    kind, place = geometry["type"], np.asarray(place, dtype=float)
    if kind == "box":
        return Placed(meshcat.Box(_floats(geometry["size"])), material, place)
    if kind == "ellipsoid":
        swollen = np.diag([*_floats(geometry["radii"]), 1.0])
        return Placed(meshcat.Sphere(1.0), material, place @ swollen)
    if kind == "mesh":
        points, faces = geometry["vertices"], geometry["faces"]
        return Placed(meshcat.TriangularMeshGeometry(points, faces), material, place)
    radius, length = (float(cast(float, geometry[name])) for name in ("radius", "length"))
    if kind == "capsule":
        return Placed(_capsule(radius, length), material, place)
    top = 0.0 if kind == "cone" else radius
    cylinder = meshcat.Cylinder(length, radiusTop=top, radiusBottom=radius)
    return Placed(cylinder, material, place @ UPRIGHT)


def _floats(values: object) -> list[float]:
    return [float(value) for value in cast(Sequence[float], values)]


def _capsule(radius: float, length: float) -> meshcat.Geometry:
    """A cylinder along z with half balls upon its ends."""
    bend = np.pi * (np.arange(2 * _CAP + 1) / (2 * _CAP) - 0.5)
    bend = np.insert(bend, _CAP, 0.0)  # the equator twice: below and above the cylinder
    ends = np.where(np.arange(len(bend)) <= _CAP, -length / 2, length / 2)
    rings = np.column_stack([radius * np.cos(bend), ends + radius * np.sin(bend)])
    turn = 2 * np.pi * np.arange(_ROUND) / _ROUND
    points = np.stack(
        [
            np.outer(rings[:, 0], np.cos(turn)),
            np.outer(rings[:, 0], np.sin(turn)),
            np.tile(rings[:, 1:], _ROUND),
        ],
        axis=-1,
    )
    return meshcat.TriangularMeshGeometry(points.reshape(-1, 3), _skin(len(rings), _ROUND))


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
    return meshcat.TriangularMeshGeometry(rings.reshape(-1, 3), _skin(len(rings), sides))


def _skin(rings: int, sides: int) -> NDArray[np.int64]:
    """Faces between rings of points, ring after ring, shape ``(2 · (rings - 1) · sides, 3)``."""
    ring, side = np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij")
    here, there = ring * sides + side, ring * sides + (side + 1) % sides
    quads = [[here, there, here + sides], [there, there + sides, here + sides]]
    return np.moveaxis(np.array(quads), (2, 3), (0, 1)).reshape(-1, 3)


def moving(points: ArrayLike, radius: float) -> tuple[Array, NDArray[np.intp]]:
    """A line without points at rest, and how many of its pieces lie before each sample.

    Args:
        points: The line, shape ``(n, 3)``, finite.
        radius: Of its tube [m]; steps below a tenth of it are none.
    """
    line = np.asarray(points, dtype=float)
    kept, done = [0], np.zeros(len(line), dtype=np.intp)
    for k in range(1, len(line)):
        if np.linalg.norm(line[k] - line[kept[-1]]) > 0.1 * radius:
            kept.append(k)
        done[k] = len(kept) - 1
    return line[kept], done


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


def look(shape: meshcat.Object) -> bytes:
    """What an object looks like: equal for two that nobody could tell apart."""
    names = ("uuid", "geometry", "material")  # numbers that are new for each object

    def plain(value: object) -> object:
        if isinstance(value, dict):
            return {key: plain(entry) for key, entry in value.items() if key not in names}
        return [plain(entry) for entry in value] if isinstance(value, list) else value

    packed: bytes = umsgpack.packb(plain(shape.lower()))
    return packed


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
