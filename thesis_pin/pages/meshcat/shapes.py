"""Surfaces as meshcat's objects: solids, their looks, their places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
_OUTSIDE = 0  # three.js's word for surfaces that are drawn from outside alone


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


def cylinder(length: float, bottom: float, top: float | None = None) -> meshcat.Cylinder:
    """A cylinder or cone along y, round enough for its size: meshcat's has twice the faces.

    Args:
        length: Along y [m].
        bottom: Radius at its lower end [m].
        top: At its upper end; None for the same.
    """
    made = meshcat.Cylinder(
        float(length), radiusBottom=float(bottom), radiusTop=float(bottom if top is None else top)
    )
    made.radialSegments = _ROUND
    return made


def rod(radius: float, sides: int) -> meshcat.Cylinder:
    """A thin cylinder of length one along y."""
    made = cylinder(1.0, radius)
    made.radialSegments = sides
    return made


class Globe(meshcat.Sphere):  # type: ignore[misc] # meshcat has no types
    """A sphere of as many faces as its size asks for.

    Args:
        radius: Of the sphere [m].
        around: Faces around it; two thirds of them from pole to pole.
    """

    def __init__(self, radius: float, around: int) -> None:
        super().__init__(float(radius))
        self.around = around

    def lower(self, object_data: object) -> dict[str, object]:
        """What the page is sent."""
        sides = {"widthSegments": self.around, "heightSegments": 2 * self.around // 3}
        return {**super().lower(object_data), **sides}


def solid(colour: str, opacity: float = 1.0, **more: object) -> meshcat.Material:
    """A lit, closed surface: its inside, which nobody sees, isn't drawn."""
    return paint(colour, opacity, **({"side": _OUTSIDE} if opacity == 1.0 else {}), **more)


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
        return Placed(Globe(1.0, _ROUND), material, place @ swollen)
    if kind == "mesh":
        points, faces = geometry["vertices"], geometry["faces"]
        return Placed(meshcat.TriangularMeshGeometry(points, faces), material, place)
    radius, length = (float(cast(float, geometry[name])) for name in ("radius", "length"))
    if kind == "capsule":
        return Placed(_capsule(radius, length), material, place)
    top = 0.0 if kind == "cone" else radius
    return Placed(cylinder(length, radius, top), material, place @ UPRIGHT)


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
    return meshcat.TriangularMeshGeometry(points.reshape(-1, 3), skin(len(rings), _ROUND))


def skin(rings: int, sides: int) -> NDArray[np.int64]:
    """Faces between rings of points, ring after ring, shape ``(2 · (rings - 1) · sides, 3)``."""
    ring, side = np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij")
    here, there = ring * sides + side, ring * sides + (side + 1) % sides
    quads = [[here, there, here + sides], [there, there + sides, here + sides]]
    return np.moveaxis(np.array(quads), (2, 3), (0, 1)).reshape(-1, 3)


def look(shape: meshcat.Object) -> bytes:
    """What an object looks like: equal for two that nobody could tell apart."""
    names = ("uuid", "geometry", "material")  # numbers that are new for each object

    def plain(value: object) -> object:
        if isinstance(value, dict):
            return {key: plain(entry) for key, entry in value.items() if key not in names}
        return [plain(entry) for entry in value] if isinstance(value, list) else value

    packed: bytes = umsgpack.packb(plain(shape.lower()))
    return packed
