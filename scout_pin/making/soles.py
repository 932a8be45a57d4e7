"""Where a foot stands: the lowest face of its shapes, or what is said of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from scout_pin.making.chains import Turn
from thesis_pin.errors import ModelError
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.model.mechanism.description import Description
from thesis_pin.numeric.checks import shown
from thesis_pin.tolerances import TOLERANCES

_ROUND = 32
"""Corners a disc is given."""


@dataclass(frozen=True, eq=False)
class Sole:
    """A flat sole.

    Attributes:
        frame: x to the right, y to the toes, z up, in the root body's frame, ``(4, 4)``.
        outline: Corners in it [m].
        source: Where the outline is from.
    """

    frame: np.ndarray
    outline: tuple[tuple[float, float], ...]
    source: str


def find_sole(
    robot: LoadedRobot,
    foot: Turn,
    torso: np.ndarray,
    ankle: np.ndarray,
    given: Sequence[float] | None,
) -> Sole:
    """The sole of a foot at zero angles.

    A link that is fixed to the foot and has ``sole`` in its name gives the frame; without
    one, or if its axes don't lie in a face, it is level with the torso, its origin below the ankle.

    Args:
        robot: With its shapes.
        foot: The last joint of the leg.
        torso: Placement of the torso's frame in the root body.
        ankle: Centre of joint 5 in the root body [m].
        given: Half width to the left, to the right, length to the heel, to the toes, and
            height of the ankle above the sole [m]; None takes the shapes.

    Raises:
        ModelError: There is no shape, or its lowest face is none.
    """
    named = _named(robot.description, foot)
    level, frames = np.eye(4), []
    level[:3, :3], level[:3, 3] = torso[:3, :3], ankle
    if named is not None:
        own = level.copy()
        own[:3, :3], own[:3, 3] = _nearest_axes(named[1][:3, :3], torso[:3, :3]), named[1][:3, 3]
        frames.append(own)
    frames.append(level)
    if given is not None:
        left, right, heel, toes, height = given
        frame = frames[0]
        frame[:3, 3] = ankle - height * frame[:3, 2]
        corners = ((-left, -heel), (right, -heel), (right, toes), (-left, toes))
        return Sole(frame, corners, "as given")
    faces, source = _faces(robot, foot, named[0] if named else "")
    if not faces:
        raise ModelError(
            f"joint {shown(foot.joint.name)} carries no shape that says where the sole is",
            where=robot.description.where,
            remedy="Say it: --sole LEFT RIGHT HEEL TOES HEIGHT [m], from the point below the ankle",
        )
    for frame in frames:
        inside = [(face - frame[:3, 3]) @ frame[:3, :3] for face in faces]
        lowest = min(float(face[:, 2].min()) for face in inside)
        if (outline := _outline(inside, lowest)) is not None:
            frame[:3, 3] = frame[:3, 3] + lowest * frame[:3, 2]
            return Sole(frame, outline, source)
    raise ModelError(
        f"the lowest shape of joint {shown(foot.joint.name)} is no level face at zero angles",
        where=robot.description.where,
        remedy="Say where the sole is: --sole LEFT RIGHT HEEL TOES HEIGHT [m], or fix a link "
        "with 'sole' in its name to the foot, x and y in the sole",
    )


def _named(description: Description, foot: Turn) -> tuple[str, np.ndarray] | None:
    """Name and frame of the link fixed to a foot that is called its sole."""
    waiting = [(foot.joint.child, foot.frame)]
    while waiting:
        name, frame = waiting.pop()
        if "sole" in name.lower():
            return name, frame
        waiting += [
            (joint.child, frame @ joint.placement)
            for joint in description.joints.values()
            if joint.parent == name and joint.kind == "fixed"
        ]
    return None


def _nearest_axes(own: np.ndarray, torso: np.ndarray) -> np.ndarray:
    """Axes of a frame, renamed and turned round to be nearest to right, forward, up."""
    up = max(
        (s * own[:, k] for k in range(3) for s in (1, -1)), key=lambda v: float(v @ torso[:, 2])
    )
    flat = [s * own[:, k] for k in range(3) for s in (1, -1) if abs(own[:, k] @ up) < 0.5]
    toes = max(flat, key=lambda v: float(v @ torso[:, 1]))
    return np.column_stack([np.cross(toes, up), toes, up])


def _faces(robot: LoadedRobot, foot: Turn, named: str) -> tuple[list[np.ndarray], str]:
    """Faces of the foot's shapes in the root body's frame, ``(corners, 3)`` each."""
    joint = robot.model.getJointId(foot.joint.name)
    for kind in ("collision_model", "visual_model"):
        shapes = [one for one in getattr(robot, kind).geometryObjects if one.parentJoint == joint]
        own = [one for one in shapes if named and one.name.startswith(f"{named}_")]
        faces = [face for one in own or shapes for face in _of_shape(one)]
        if faces:
            turn, place = foot.frame[:3, :3], foot.frame[:3, 3]
            return [face @ turn.T + place for face in faces], f"{kind.split('_')[0]} shapes"
    return [], ""


def _of_shape(shape: pin.GeometryObject) -> list[np.ndarray]:
    """Faces of a box, a cylinder or a mesh in the joint's frame; nothing else has any."""
    geometry, scale = shape.geometry, np.asarray(shape.meshScale)
    name = type(geometry).__name__
    if name == "Box":
        half = np.asarray(geometry.halfSide)
        faces = []
        for axis in range(3):
            for end in (1.0, -1.0):
                flat = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)], dtype=float)
                faces.append(np.insert(flat, axis, end, axis=1) * half)
    elif name == "Cylinder":
        turn = 2 * np.pi * np.arange(_ROUND) / _ROUND
        ring = np.column_stack([np.cos(turn), np.sin(turn)]) * geometry.radius
        faces = [np.insert(ring, 2, end * geometry.halfLength, axis=1) for end in (1.0, -1.0)]
    elif hasattr(geometry, "num_tris"):
        points = np.asarray(geometry.vertices()) * (scale if name == "Convex" else 1.0)
        corners = [geometry.tri_indices(k) for k in range(geometry.num_tris)]
        faces = [points[[t[0], t[1], t[2]]] for t in corners]
    else:
        return []
    place = shape.placement
    return [face @ place.rotation.T + place.translation for face in faces]


def _outline(faces: Sequence[np.ndarray], lowest: float) -> tuple[tuple[float, float], ...] | None:
    """What of the faces lies level at the lowest height, as one polygon; None if nothing does."""
    from shapely import MultiPoint, Polygon, union_all

    size = max(float(np.ptp(np.concatenate(faces), axis=0).max()), 1e-6)
    near = TOLERANCES.kind_gap * size
    level = [face[:, :2] for face in faces if (face[:, 2] <= lowest + near).all()]
    found = union_all([Polygon(face) for face in level]) if level else Polygon()
    if found.geom_type != "Polygon":  # several pads: what stands on them stands on their hull
        found = MultiPoint(np.concatenate(level)).convex_hull
    corners = np.array(found.exterior.coords)[:-1] if found.area > 0.0 else np.empty((0, 2))
    if len(corners) < 3:
        return None
    # Meshes are held in single precision.
    return tuple((round(float(x), 7), round(float(y), 7)) for x, y in corners)
