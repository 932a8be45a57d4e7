"""Pinocchio models as items of a scene: bodies, joint frames, loop closures.

For any model; poses come from Pinocchio's forward kinematics alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.errors import BadInput, NotFinite, WrongShape
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.pages.scene import Arrow, Ball, Item, Shape

if TYPE_CHECKING:
    import pinocchio as pin

OPEN, CLOSED = "#D55E00", "#CC79A7"
"""Colours of a loop's opening and of its joint."""


def placements(se3: ArrayLike) -> np.ndarray:
    """Positions and quaternions (x, y, z, w) of transforms: ``(..., 4, 4)`` → ``(..., 7)``."""
    matrices = np.asarray(se3, dtype=float)
    turned = quaternions(matrices[..., :3, :3])
    return np.concatenate([matrices[..., :3, 3], turned], axis=-1)


def joint_placements(model: pin.Model, q: np.ndarray) -> np.ndarray:
    """Placement of every joint at every sample, by Pinocchio: ``(n, nq)`` → ``(n, joints, 7)``.

    Raises:
        WrongShape: ``q`` doesn't fit the model.
        NotFinite: ``q`` holds NaN or infinity.
    """
    import pinocchio as pin

    q = _configurations(model, q)
    data = model.createData()
    matrices = np.empty((len(q), model.njoints, 4, 4))
    for k in range(len(q)):
        pin.forwardKinematics(model, data, q[k])
        for joint in range(model.njoints):
            matrices[k, joint] = data.oMi[joint].homogeneous
    return placements(matrices)


def frame_placements(model: pin.Model, name: str, q: np.ndarray) -> np.ndarray:
    """Placement of a frame at every sample: ``(n, nq)`` → ``(n, 7)``.

    Raises:
        UnknownName: The model has no such frame.
        WrongShape, NotFinite: ``q`` doesn't fit.
    """
    import pinocchio as pin

    from thesis_pin.model.loading import frame_id

    number, q = frame_id(model, name), _configurations(model, q)
    data = model.createData()
    matrices = np.empty((len(q), 4, 4))
    for k in range(len(q)):
        pin.forwardKinematics(model, data, q[k])
        matrices[k] = pin.updateFramePlacement(model, data, number).homogeneous
    return placements(matrices)


def axis_placements(model: pin.Model, joint: str, moves: np.ndarray) -> np.ndarray:
    """Frames at a revolute joint whose z axis is the joint's axis, for an :class:`Arc`.

    Args:
        model: Pinocchio model.
        joint: Name of the joint.
        moves: What :func:`joint_placements` gives, shape ``(n, joints, 7)``.

    Returns:
        Shape ``(n, 7)``.

    Raises:
        UnknownName: The model has no such joint.
        BadInput: The joint doesn't turn about one axis.
    """
    from scipy.spatial.transform import Rotation

    from thesis_pin.model.loading import joint_id

    number = joint_id(model, joint)
    axis = _axis(model.joints[number], joint)
    turn, _ = Rotation.align_vectors([axis], [[0.0, 0.0, 1.0]])
    turned = (Rotation.from_quat(moves[:, number, 3:]) * turn).as_quat()
    return np.column_stack([moves[:, number, :3], turned])


def closure_items(
    model: pin.Model, pairs: Iterable[tuple[str, str]], q: np.ndarray, group: str, radius: float
) -> list[Item]:
    """Loop closures: one ball where a loop is closed, two and a bar between them where not.

    Args:
        model: Pinocchio model of the tree.
        pairs: Names of the frames that ought to coincide.
        q: Configurations, shape ``(n, nq)``.
        group: Group of the items.
        radius: Radius of the ball [m].
    """
    items: list[Item] = []
    for first, second in pairs:
        a, b = (frame_placements(model, name, q)[:, :3] for name in (first, second))
        items += [
            Ball(first, group, a, radius, (CLOSED,)),
            Ball(second, group, b, 0.8 * radius, (OPEN,)),
            Arrow(f"{first} to {second}", group, a, b - a, 1.0, radius / 3, OPEN, head=False),
        ]
    return items


def robot_items(
    model: pin.Model,
    geometry: pin.GeometryModel,
    q: np.ndarray,
    *,
    group: str | Callable[[str], str] = "robot",
    colour: Callable[[str], str | None] | None = None,
) -> list[Shape]:
    """The visual geometry of any Pinocchio model along a motion.

    Args:
        model: Pinocchio model.
        geometry: Its visual (or collision) geometry.
        q: Configurations, shape ``(n, nq)``.
        group: Group of all shapes, or of a shape by its name.
        colour: Colour of a shape by its name; None takes the model's own.

    Raises:
        WrongShape, NotFinite: ``q`` doesn't fit.
        BadInput: A shape of a kind that can't be drawn.
    """
    moves = joint_placements(model, q)
    items = []
    for shape in geometry.geometryObjects:
        red, green, blue, alpha = np.clip(shape.meshColor, 0.0, 1.0)
        own = "#" + "".join(f"{round(255 * part):02x}" for part in (red, green, blue))
        items.append(
            Shape(
                name=shape.name,
                group=group if isinstance(group, str) else group(shape.name),
                geometry=_geometry(shape.geometry, shape.name),
                placement=moves[:, shape.parentJoint],
                local=shape.placement.homogeneous,
                colour=(colour(shape.name) if colour else None) or own,
                opacity=float(alpha),
            )
        )
    return items


def _geometry(shape: Any, name: str) -> dict[str, object]:
    """A collision library's shape as plain data; its cylinders and the like lie along z."""
    kind = type(shape).__name__
    if kind == "Sphere":
        return {"type": "ellipsoid", "radii": [shape.radius] * 3}
    if kind == "Ellipsoid":
        return {"type": "ellipsoid", "radii": np.asarray(shape.radii).tolist()}
    if kind == "Box":
        return {"type": "box", "size": (2 * np.asarray(shape.halfSide)).tolist()}
    if kind in ("Cylinder", "Capsule", "Cone"):
        return {"type": kind.lower(), "radius": shape.radius, "length": 2 * shape.halfLength}
    if hasattr(shape, "tri_indices"):
        corners = map(shape.tri_indices, range(shape.num_tris))
        faces = [(corner[0], corner[1], corner[2]) for corner in corners]
        return {"type": "mesh", "vertices": np.array(shape.vertices()), "faces": np.array(faces)}
    if kind.startswith("Convex"):
        points = np.array([shape.point(k) for k in range(shape.num_points)])
        corners = map(shape.polygons, range(shape.num_polygons))
        faces = [(corner[0], corner[1], corner[2]) for corner in corners]
        return {"type": "mesh", "vertices": points, "faces": np.array(faces)}
    raise BadInput(
        f"can't draw a {kind}",
        where=f"geometry {name!r}",
        allowed="sphere, ellipsoid, box, cylinder, capsule, cone, mesh",
    )


def _configurations(model: pin.Model, q: np.ndarray) -> np.ndarray:
    q = np.asarray(q, dtype=float)
    if q.ndim != 2 or q.shape[1] != model.nq:
        raise WrongShape("q", q.shape, f"(n, {model.nq})")
    if not np.isfinite(q).all():
        raise NotFinite("q", tuple(np.argwhere(~np.isfinite(q))[0].tolist()))
    return q


def _axis(joint: Any, name: str) -> np.ndarray:
    kind = joint.shortname()
    for letter, axis in zip("XYZ", np.eye(3), strict=True):
        if kind in (f"JointModelR{letter}", f"JointModelRUB{letter}"):
            return axis
    if "RevoluteUnaligned" in kind or "RevoluteUnboundedUnaligned" in kind:
        return np.asarray(joint.extract().axis if hasattr(joint, "extract") else joint.axis)
    raise BadInput(f"it is a {kind}", where=f"joint {name!r}", allowed="a revolute joint")
