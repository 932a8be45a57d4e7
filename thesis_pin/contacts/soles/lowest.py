"""What of a link's shapes is lowest: the face, edge or point that meets the floor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.contacts.soles.outlines import area, hull, simplified
from thesis_pin.contacts.stability import signed_margin
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_ROUND = 16  # points of a circle
_BALL = 0.005  # how much of a mesh above its lowest point a ball is fitted to [m]
_ROUNDNESS = 0.02  # error of that ball, relative to its radius
_TILTS = 12  # faces that are tried where a pose doesn't hold the sole quite level
_LEAN = np.cos(np.radians(30.0))  # how far these may lean
_LARGER = 1.5  # by how much the area of one must be larger than that of what is lowest


@dataclass(frozen=True, eq=False)
class Lowest:
    """What of some shapes is lowest.

    Attributes:
        height: Of the lowest point, against up [m].
        up: Unit vector out of the face, shape ``(3,)``.
        corners: Of the face within ``sole_face`` of it, its hull; or the ends of an edge; or
            one point, of a ball its centre; in the world [m], shape ``(k, 3)``.
        radius: Of that ball [m]; 0 if there is none.
        lost: Share of the face's area that is left out for few corners.
    """

    height: float
    up: Array
    corners: Array
    radius: float = 0.0
    lost: float = 0.0


def surface(shape: pin.GeometryObject, placement: pin.SE3, up: Array) -> tuple[Array, Array]:
    """Points of a shape of which some are its lowest, in the world.

    Args:
        shape: The shape.
        placement: Of its joint in the world.
        up: Unit vector, shape ``(3,)``.

    Returns:
        Points [m] ``(k, 3)``, and the radius of the ball that each is the lowest point of: 0 for
        corners, NaN for those of a mesh, which may be a ball's.
    """
    geometry, place = shape.geometry, placement * shape.placement
    kind = type(geometry).__name__
    radius, mesh = 0.0, False
    if kind == "Box":
        half = np.array(geometry.halfSide)
        local = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
    elif kind == "Sphere":
        local, radius = np.zeros((1, 3)), float(geometry.radius)
    elif kind == "Capsule":
        radius = float(geometry.radius)
        local = np.array([[0.0, 0.0, side * geometry.halfLength] for side in (-1, 1)])
    elif kind in ("Cylinder", "Cone"):
        local = _rims(geometry, place, up, kind == "Cone")
    elif kind == "Ellipsoid":
        radii = np.array(geometry.radii)
        down = -place.rotation.T @ up
        local = (radii**2 * down / np.linalg.norm(radii * down))[None]
    elif hasattr(geometry, "vertices"):
        local, mesh = np.asarray(geometry.vertices(), dtype=float), True
    else:  # planes and the like have no lowest point
        local = np.zeros((0, 3))
    points = local @ place.rotation.T + place.translation
    return points - radius * up, np.full(len(points), np.nan if mesh else radius)


def lowest(shapes: Sequence[pin.GeometryObject], placement: pin.SE3, up: Array) -> Lowest | None:
    """What of shapes on one joint is lowest; None if nothing has a lowest point.

    Args:
        shapes: They.
        placement: Of the joint in the world.
        up: Unit vector out of the floor, shape ``(3,)``.
    """
    found = _seen(shapes, placement, up)
    if found is None:
        return None
    points, radii = found
    heights = points @ up
    low = float(heights.min())
    near = heights <= low + TOLERANCES.sole_face
    axes = _level(up)
    flat = points[near] @ axes
    outline = hull(flat)
    main = _principal(flat)
    size = np.ptp(flat @ main, axis=0)
    if size.min() >= TOLERANCES.sole_width and len(outline) > 2:
        outline, lost = simplified(outline)
        return Lowest(low, up, outline @ axes.T + low * up, lost=lost)
    if size.max() >= TOLERANCES.sole_width:
        along = flat @ main[:, int(size.argmax())]
        return Lowest(low, up, points[near][[int(along.argmin()), int(along.argmax())]])
    first = int(heights.argmin())
    if radii[first] > 0:
        return Lowest(low, up, (points[first] + radii[first] * up)[None], float(radii[first]))
    mesh = np.isnan(radii)
    ball = _ball(points[mesh], heights[mesh], up) if np.isnan(radii[first]) else None
    if ball is not None:
        return Lowest(low, up, ball[0][None], ball[1])
    return Lowest(low, up, points[near].mean(axis=0)[None])


def sole(shapes: Sequence[pin.GeometryObject], placement: pin.SE3, up: Array) -> Lowest | None:
    """As :func:`lowest`; but if a pose holds a foot tilted, the face that is meant to be lowest.

    That is a face which leans by less than 30° and is half as large again as what is lowest.
    """
    best = lowest(shapes, placement, up)
    found = _seen(shapes, placement, up)
    if best is None or found is None:
        return best
    for other in _faces(found[0], up):
        one = lowest(shapes, placement, other)
        if one is not None and _size(one) > _LARGER * _size(best):
            best = one
    return best


def covers(face: Lowest, other: Lowest) -> bool:
    """Whether a face has all of another's corners in it, but for ``sole_face`` above or below."""
    if len(face.corners) < 3:
        return False
    points = other.corners - other.radius * face.up
    flat = _level(face.up)
    apart = np.abs((points - face.corners[0]) @ face.up).max()
    inside = signed_margin(hull(face.corners @ flat), points @ flat).min()
    return bool(apart <= TOLERANCES.sole_face and inside >= 0)


def _seen(
    shapes: Sequence[pin.GeometryObject], placement: pin.SE3, up: Array
) -> tuple[Array, Array] | None:
    found = [surface(shape, placement, up) for shape in shapes]
    points = np.concatenate([np.zeros((0, 3)), *(one for one, _ in found)])
    return (points, np.concatenate([one for _, one in found])) if len(points) else None


def _faces(points: Array, up: Array) -> list[Array]:
    """Directions out of the largest faces of a hull that lean little, the largest first."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        around = ConvexHull(points)
    except (QhullError, ValueError):  # flat, or too few points
        return []
    corners = points[around.simplices]
    areas = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    normals = -around.equations[:, :3]
    order = [k for k in np.argsort(-areas) if normals[k] @ up > _LEAN][:_TILTS]
    return [normals[k] for k in order]


def _size(found: Lowest) -> float:
    """Area of a face [m²]; none of an edge or a point."""
    if len(found.corners) < 3:
        return 0.0
    return area(found.corners @ _level(found.up))


def _rims(geometry: pin.GeometryObject, place: pin.SE3, up: Array, cone: bool) -> Array:
    """Points around the ends of a cylinder or cone, its lowest ones among them."""
    radius, half = float(geometry.radius), float(geometry.halfLength)
    down = -(place.rotation.T @ up)[:2]
    start = np.arctan2(down[1], down[0]) if np.linalg.norm(down) > TOLERANCES.near_singular else 0.0
    angle = start + 2 * np.pi * np.arange(_ROUND) / _ROUND
    rim = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    bottom = np.column_stack([rim, np.full(_ROUND, -half)])
    top = np.array([[0.0, 0.0, half]]) if cone else bottom * (1.0, 1.0, -1.0)
    return np.concatenate([bottom, top])


def _level(up: Array) -> Array:
    """Two axes across a direction, as columns, shape ``(3, 2)``."""
    other = np.eye(3)[int(np.abs(up).argmin())]
    first = np.cross(up, other)
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(up, first)])


def _principal(flat: Array) -> Array:
    """Axes along and across a cloud of points in a plane, shape ``(2, 2)``."""
    around = flat - flat.mean(axis=0)
    return np.asarray(np.linalg.eigh(around.T @ around)[1])


def _ball(points: Array, heights: Array, up: Array) -> tuple[Array, float] | None:
    """Centre and radius of the ball that the lowest points of a mesh lie on, if they do."""
    near = points[heights <= heights.min() + _BALL]
    if len(near) < 8:
        return None
    middle = near.mean(axis=0)
    around = near - middle
    matrix = np.column_stack([2 * around, np.ones(len(near))])
    found, _, rank, _ = np.linalg.lstsq(matrix, (around**2).sum(axis=1), rcond=None)
    square = float(found[3] + found[:3] @ found[:3])
    if rank < 4 or square <= 0:
        return None
    radius = float(np.sqrt(square))
    error = np.abs(np.linalg.norm(around - found[:3], axis=1) - radius).max()
    hollow = found[:3] @ up < 0  # a ball's centre is above its lowest points
    if hollow or error > _ROUNDNESS * radius:
        return None
    return middle + found[:3], radius
