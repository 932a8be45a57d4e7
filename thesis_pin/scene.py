"""What there is to see: a robot and its overlays over time, free of any robot's details.

A scene is data. :mod:`thesis_pin.viewer` turns it into a page; nothing here
knows of browsers. Every array's first axis is the scene's time; a NaN in an
item's sample hides the item there. Lengths in metres, world frame.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from thesis_pin.errors import BadInput, NotFinite, UnknownName, WrongShape

if TYPE_CHECKING:
    import pinocchio as pin

GREY = "#9AA0A6"


@dataclass(frozen=True)
class Group:
    """Items that are shown or hidden together, and their line in the legend.

    Attributes:
        name: What the items' ``group`` says.
        label: Text of the legend.
        colours: Colours of the legend with what each one means; a meaning may be empty.
        visible: Whether it is shown at first.
    """

    name: str
    label: str
    colours: tuple[tuple[str, str], ...] = ()
    visible: bool = True


@dataclass(frozen=True)
class Item:
    """Common to everything that is drawn.

    Attributes:
        name: Unique name.
        group: Name of its :class:`Group`.
    """

    name: str
    group: str

    def arrays(self) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
        """Sampled arrays: name → values and shape, in which -1 stands for the scene's samples."""
        raise NotImplementedError

    def constants(self) -> dict[str, Any]:
        """What doesn't change, JSON-ready or arrays."""
        raise NotImplementedError


@dataclass(frozen=True)
class Body(Item):
    """A rigid shape.

    Attributes:
        geometry: ``{"type": "box", "size": …}``, ``cylinder`` and ``capsule`` and ``cone``
            (``radius``, ``length``, along z), ``ellipsoid`` (``radii``) or ``mesh``
            (``vertices`` ``(v, 3)``, ``faces`` ``(f, 3)``).
        placement: Position and quaternion (x, y, z, w) over time, shape ``(n, 7)``.
        local: The shape's placement in the moving frame, shape ``(4, 4)``.
        colour: ``#rrggbb``.
        opacity: 0 to 1.
    """

    geometry: dict[str, Any]
    placement: np.ndarray
    local: np.ndarray
    colour: str = GREY
    opacity: float = 1.0

    def arrays(self) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
        return {"placement": (self.placement, (-1, 7))}

    def constants(self) -> dict[str, Any]:
        return {
            "geometry": self.geometry,
            "local": self.local,
            "colour": self.colour,
            "opacity": self.opacity,
        }


@dataclass(frozen=True)
class Ball(Item):
    """A point, drawn as a ball.

    Attributes:
        position: Centre, shape ``(n, 3)``.
        radius: Its radius [m].
        colours: One colour, or several that ``level`` chooses from.
        level: Index into ``colours`` over time, shape ``(n,)``; None for the first.
    """

    position: np.ndarray
    radius: float
    colours: tuple[str, ...]
    level: np.ndarray | None = None

    def arrays(self) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
        return {"position": (self.position, (-1, 3)), **_level(self.level)}

    def constants(self) -> dict[str, Any]:
        return {"radius": self.radius, "colours": list(self.colours)}


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

    origin: np.ndarray
    vector: np.ndarray
    scale: float
    radius: float
    colour: str
    head: bool = True

    def arrays(self) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
        return {"origin": (self.origin, (-1, 3)), "vector": (self.vector, (-1, 3))}

    def constants(self) -> dict[str, Any]:
        return {
            "scale": self.scale,
            "radius": self.radius,
            "colour": self.colour,
            "head": self.head,
        }


@dataclass(frozen=True)
class Trace(Item):
    """The way of a point: the whole of it faint, what has been covered bold.

    Attributes:
        points: Shape ``(n, 3)``.
        radius: Radius of the line [m].
        colour: ``#rrggbb``.
    """

    points: np.ndarray
    radius: float
    colour: str

    def arrays(self) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
        return {"points": (self.points, (-1, 3))}

    def constants(self) -> dict[str, Any]:
        return {"radius": self.radius, "colour": self.colour}


@dataclass(frozen=True)
class Polygon(Item):
    """A flat, convex area that changes from sample to sample among a few outlines.

    Attributes:
        outlines: Corners in order, each ``(k, 3)``.
        which: Index of the outline over time, -1 for none, shape ``(n,)``.
        colour: ``#rrggbb``.
        width: Width of its border [m].
    """

    outlines: tuple[np.ndarray, ...]
    which: np.ndarray
    colour: str
    width: float

    def arrays(self) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
        return {"which": (self.which, (-1,))}

    def constants(self) -> dict[str, Any]:
        return {
            "outlines": [np.asarray(outline, dtype=float) for outline in self.outlines],
            "colour": self.colour,
            "width": self.width,
        }


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

    placement: np.ndarray
    angle: np.ndarray
    radius: float
    colours: tuple[str, ...]
    level: np.ndarray | None = None

    def arrays(self) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
        return {
            "placement": (self.placement, (-1, 7)),
            "angle": (self.angle, (-1,)),
            **_level(self.level),
        }

    def constants(self) -> dict[str, Any]:
        return {"radius": self.radius, "colours": list(self.colours)}


@dataclass(frozen=True)
class Readout:
    """A value shown as text beside the picture.

    Attributes:
        label: What it is.
        values: Numbers ``(n,)``, or one of ``texts`` by index ``(n,)``.
        unit: Unit of the numbers.
        digits: Digits after the point.
        texts: What indices stand for; empty for numbers.
    """

    label: str
    values: np.ndarray
    unit: str = ""
    digits: int = 1
    texts: tuple[str, ...] = ()


@dataclass(frozen=True)
class Scene:
    """Everything a page has to know.

    Attributes:
        title: Headline.
        description: What a reader who can't see the picture should know of it.
        time: Sample times [s], strictly increasing, shape ``(n,)``.
        groups: Groups in the order of the legend.
        items: What is drawn.
        readouts: Values shown as text.
        floor: Height of the floor [m], None for no floor.
        camera: Camera position and the point it looks at, shape ``(2, 3)``; None
            looks at the items from the right, ahead and above.
    """

    title: str
    description: str
    time: np.ndarray
    groups: tuple[Group, ...]
    items: tuple[Item, ...]
    readouts: tuple[Readout, ...] = ()
    floor: float | None = 0.0
    camera: np.ndarray | None = None

    def __post_init__(self) -> None:
        """Refuse what no page could show.

        Raises:
            WrongShape, NotFinite, UnknownName, BadInput: Says which item and array.
        """
        time = np.asarray(self.time, dtype=float)
        if time.ndim != 1 or len(time) < 2:
            raise WrongShape("time", time.shape, "(n,) with n at least 2")
        if not np.isfinite(time).all() or (np.diff(time) <= 0).any():
            raise BadInput("time must be finite and increase strictly", where="scene")
        known = [group.name for group in self.groups]
        seen: set[str] = set()
        for item in self.items:
            if item.group not in known:
                raise UnknownName("group", item.group, known, where=f"item {item.name!r}")
            if item.name in seen:
                raise BadInput(f"two items are called {item.name!r}", where="scene")
            seen.add(item.name)
            for name, (values, shape) in item.arrays().items():
                wanted = tuple(len(time) if size == -1 else size for size in shape)
                if np.shape(values) != wanted:
                    raise WrongShape(f"{name} of item {item.name!r}", np.shape(values), str(wanted))
                if np.isinf(values).any():
                    where = np.argwhere(np.isinf(values))[0]
                    raise NotFinite(f"{name} of item {item.name!r}", tuple(where.tolist()))
        for readout in self.readouts:
            if np.shape(readout.values) != time.shape:
                raise WrongShape(
                    f"values of readout {readout.label!r}",
                    np.shape(readout.values),
                    str(time.shape),
                )


def placements(se3: Any) -> np.ndarray:
    """Positions and quaternions (x, y, z, w) of transforms: ``(..., 4, 4)`` → ``(..., 7)``."""
    from scipy.spatial.transform import Rotation

    matrices = np.asarray(se3, dtype=float)
    flat = Rotation.from_matrix(matrices[..., :3, :3].reshape(-1, 3, 3)).as_quat()
    turned = flat.reshape(*matrices.shape[:-2], 4)
    return np.concatenate([matrices[..., :3, 3], turned], axis=-1)


def joint_placements(model: pin.Model, q: np.ndarray) -> np.ndarray:
    """Placement of every joint at every sample, by Pinocchio: ``(n, nq)`` → ``(n, joints, 7)``.

    Raises:
        WrongShape: ``q`` doesn't fit the model.
        NotFinite: ``q`` holds NaN or infinity.
    """
    import pinocchio as pin

    q = np.asarray(q, dtype=float)
    if q.ndim != 2 or q.shape[1] != model.nq:
        raise WrongShape("q", q.shape, f"(n, {model.nq})")
    if not np.isfinite(q).all():
        raise NotFinite("q", tuple(np.argwhere(~np.isfinite(q))[0].tolist()))
    data = model.createData()
    matrices = np.empty((len(q), model.njoints, 4, 4))
    for k in range(len(q)):
        pin.forwardKinematics(model, data, q[k])
        for joint in range(model.njoints):
            matrices[k, joint] = data.oMi[joint].homogeneous
    return placements(matrices)


def robot_items(
    model: pin.Model,
    geometry: pin.GeometryModel,
    q: np.ndarray,
    *,
    group: str | Callable[[str], str] = "robot",
    colour: Callable[[str], str | None] | None = None,
) -> list[Body]:
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
            Body(
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


def _geometry(shape: Any, name: str) -> dict[str, Any]:
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
        faces = [[shape.tri_indices(k)[j] for j in range(3)] for k in range(shape.num_tris)]
        return {"type": "mesh", "vertices": np.array(shape.vertices()), "faces": np.array(faces)}
    if kind.startswith("Convex"):
        points = np.array([shape.point(k) for k in range(shape.num_points)])
        faces = [[shape.polygons(k)[j] for j in range(3)] for k in range(shape.num_polygons)]
        return {"type": "mesh", "vertices": points, "faces": np.array(faces)}
    raise BadInput(
        f"can't draw a {kind}",
        where=f"geometry {name!r}",
        allowed="sphere, ellipsoid, box, cylinder, capsule, cone, mesh",
    )


def thinned(count: int, most: int) -> np.ndarray:
    """Indices of at most ``most`` evenly spread samples of ``count``, both ends included."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def frames(duration: float) -> int:
    """Number of samples that shows a motion of some seconds smoothly: 60 a second, in bounds."""
    return int(np.clip(round(60 * duration) + 1, 241, 1201))


def levels(values: np.ndarray, bounds: Sequence[float]) -> np.ndarray:
    """Index of the band each value lies in: 0 below the first bound, and so on up."""
    return np.digitize(values, bounds).astype(float)


def _level(level: np.ndarray | None) -> dict[str, tuple[Any, tuple[int | None, ...]]]:
    return {} if level is None else {"level": (level, (-1,))}
