"""What can be seen of any robot that stands: bodies, frames, masses, inertias, limits, loops."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import ThesisPinError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.pages.drawing import CLOSED, OPEN, robot_items
from thesis_pin.pages.live.hung import WHOLE, Hung, Places
from thesis_pin.pages.live.inertia import ellipsoids
from thesis_pin.pages.meshes import bare, seen
from thesis_pin.pages.scene import AXES, Arrow, Ball, Group, Item, Shape, Triad
from thesis_pin.report.curves import GREEN, ORANGE, PURPLE, SKY, VERMILLION

Array = NDArray[np.float64]
Point = tuple[float, float, float]

BLACK, YELLOW = "#1A1A1A", "#F0E442"
MOST_FRAMES = 250
"""Frames that are drawn; more can't be read."""

GROUPS = (
    Group("frames", "frames", tuple(zip(AXES, "xyz", strict=True)), False),
    Group("masses", "centres of mass: bodies, whole robot", ((PURPLE, ""), (BLACK, "")), False),
    Group("inertias", "inertia ellipsoids (solid, of equal inertia)", ((GREEN, ""),), False),
    Group("limits", "joints", ((ORANGE, "at a limit"), (VERMILLION, "beyond it"))),
    Group(
        "collision", "collision shapes (behind bodies of the same shape)", ((YELLOW, ""),), False
    ),
)
"""Groups of what is drawn beside bodies and loops."""

_SHORT = 1e-3
"""Bars that are shorter, relative to the robot, can't be seen."""

LIMIT_COLOURS = (ORANGE, VERMILLION)
_ZERO = np.zeros((2, 3))
_REST = np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (2, 1))


@dataclass(frozen=True, eq=False)
class Layers:
    """What is drawn of a robot.

    Attributes:
        groups: For the legend.
        hung: Items, each with what it hangs on.
        size: How large the robot is [m].
        low: Height of its lowest point [m].
        notes: What can't be drawn as it is, in words.
    """

    groups: tuple[Group, ...]
    hung: tuple[Hung, ...]
    size: float
    low: float
    notes: tuple[str, ...]


def layers(
    robot: LoadedRobot, q: Array, *, bodies: Sequence[Item] = (), groups: Sequence[Group] = ()
) -> Layers:
    """Everything there is to see of a robot.

    Args:
        robot: The robot.
        q: A configuration, for its size, shape ``(nq,)``.
        bodies: Its visual shapes as items in the order of ``robot.visual_model``; without any
            its own, or bars from joint to joint where it has none.
        groups: Groups of these.
    """
    model, notes = robot.model, list[str]()
    places = Places.of(model, model.createData(), q)
    visual = robot.visual_model if bodies else seen(robot, "visual", notes)
    shapes = list(bodies) or _shapes(model, visual, "robot", notes)
    hung = [
        Hung(shape, int(one.parentJoint))
        for shape, one in zip(shapes, visual.geometryObjects, strict=False)
    ]
    size, low = _extent(model, places, hung)
    barred = not hung or bare(robot, visual, notes)
    if barred:
        hung += _bars(robot, size)
    collision = seen(robot, "collision", notes)
    blocks = _shapes(model, collision, "collision", notes)
    for shape, one in zip(blocks, collision.geometryObjects, strict=False):
        hung.append(Hung(shape, int(one.parentJoint)))
    hung += [*_frames(model, size, notes), *_masses(robot, size, notes)]
    hung += [
        Hung(
            Ball(f"limit of {name}", "limits", _ZERO, 0.025 * size, LIMIT_COLOURS, np.zeros(2)),
            number,
            marks=number,
        )
        for number, name in enumerate(model.names)
        if number
    ]
    own = tuple(groups) or (Group("robot", "robot", ((SKY, ""),) * (not bodies and barred)),)
    if isinstance(robot, ClosedRobot) and robot.loops:
        own = (*own, Group("loops", "loops", ((CLOSED, "closed"), (OPEN, "open"))))
        hung += _loops(robot, size)
    used = {one.item.group for one in hung}
    every = tuple(group for group in (*own, *GROUPS) if group.name in used)
    return Layers(every, tuple(hung), size, low, tuple(dict.fromkeys(notes)))


def _shapes(
    model: pin.Model, geometry: pin.GeometryModel, group: str, notes: list[str]
) -> list[Shape]:
    """Shapes of a geometry, each under a name of its own; none where one can't be drawn."""
    made, q = [], np.tile(pin.neutral(model), (2, 1))
    solid = group == "robot"
    try:
        shapes = robot_items(
            model, geometry, q, group=group, colour=None if solid else lambda _: YELLOW
        )
    except ThesisPinError as error:
        notes.append(str(error))
        return []
    for number, shape in enumerate(shapes):
        name = f"{'body' if solid else 'collision'} {number} {shape.name}"
        opacity = shape.opacity if solid else 0.45
        local = shape.local
        made.append(
            Shape(name, group, shape.geometry, _REST, local, shape.colour, opacity, not solid)
        )
    return made


def _extent(model: pin.Model, places: Places, hung: Sequence[Hung]) -> tuple[float, float]:
    """The longest side of a box about joints, frames and shapes [m], and how high it begins."""
    points = [places.positions[:-1]]
    points += [
        places.point(frame.parentJoint, frame.placement.translation)[None] for frame in model.frames
    ]
    for one in hung:
        assert isinstance(one.item, Shape)
        corners = one.item.corners()
        points.append(corners @ places.rotations[one.joint].T + places.positions[one.joint])
    every = np.concatenate(points)
    extent = float(np.ptp(every, axis=0).max())
    return extent if extent > 0 else 1.0, float(every[:, 2].min())


def _bars(robot: LoadedRobot, size: float) -> Iterator[Hung]:
    """A bar from each joint to the next, to the ends of loops and of the last links."""
    model = robot.model
    ends: dict[int, set[Point]] = {}
    for frame in model.frames:
        if frame.parentJoint:
            at = _point(frame.placement.translation)
            if np.linalg.norm(at) > _SHORT * size:
                ends.setdefault(frame.parentJoint, set()).add(at)
    for joint in range(1, model.njoints):
        name, parent = model.names[joint], model.parents[joint]
        yield Hung(Ball(f"joint {joint} {name}", "robot", _ZERO, 0.012 * size, (SKY,)), joint)
        if parent:
            yield _bar(f"bar {joint}", parent, (0.0, 0.0, 0.0), (joint, (0.0, 0.0, 0.0)), size)
        for number, at in enumerate(sorted(ends.get(joint, ()))):
            yield _bar(f"bar {joint} end {number}", joint, (0.0, 0.0, 0.0), (joint, at), size)


def _bar(name: str, joint: int, at: Point, tip: tuple[int, Point], size: float) -> Hung:
    arrow = Arrow(name, "robot", _ZERO, _ZERO, 1.0, 6e-3 * size, SKY, head=False)
    return Hung(arrow, joint, at, tip)


def _frames(model: pin.Model, size: float, notes: list[str]) -> Iterator[Hung]:
    """A triad a place: frames that coincide share one, under all their names."""
    found: dict[tuple[int, bytes], tuple[pin.SE3, list[str]]] = {}
    for frame in model.frames:
        key = (frame.parentJoint, (np.round(frame.placement.homogeneous, 9) + 0.0).tobytes())
        found.setdefault(key, (frame.placement, []))[1].append(frame.name)
    if len(found) > MOST_FRAMES:
        notes.append(f"{MOST_FRAMES} of {len(found)} frames are drawn")
    for (joint, _), (place, names) in list(found.items())[:MOST_FRAMES]:
        local = place.homogeneous
        label = " = ".join(dict.fromkeys(names[:2])) + (" …" if len(names) > 2 else "")
        item = Triad(f"frame {names[0]} of {joint}", "frames", _REST, local, 0.06 * size, label)
        yield Hung(item, joint)


def _masses(robot: LoadedRobot, size: float, notes: list[str]) -> Iterator[Hung]:
    for body in ellipsoids(robot, notes):
        ball = Ball(f"mass of {body.name}", "masses", _ZERO, 0.008 * size, (PURPLE,))
        yield Hung(ball, body.joint, _point(body.local[:3, 3]))
        if body.radii is not None and max(body.radii) > 0:
            solid = {"type": "ellipsoid", "radii": list(body.radii)}
            name = f"inertia of {body.name}"
            egg = Shape(name, "inertias", solid, _REST, body.local, GREEN, 0.5, True)
            yield Hung(egg, body.joint)
    if sum(inertia.mass for inertia in robot.model.inertias) > 0:
        yield Hung(Ball("centre of mass", "masses", _ZERO, 0.014 * size, (BLACK,)), WHOLE)
    else:
        notes.append("no body has mass: there is no centre of mass, and there are no inertias")


def _loops(robot: ClosedRobot, size: float) -> Iterator[Hung]:
    """A ball where frames meet, a second one and a bar where they don't; or a rod."""
    for k, loop in enumerate(robot.loops):
        frames = [robot.model.frames[end] for end in loop.ids]
        (one, at), (two, to) = ((f.parentJoint, _point(f.placement.translation)) for f in frames)
        rod = loop.length is not None
        colour, radius = CLOSED if rod else OPEN, 0.015 * size
        yield Hung(Ball(f"loop {k} {frames[0].name}", "loops", _ZERO, radius, (CLOSED,)), one, at)
        other = Ball(f"loop {k} {frames[1].name}", "loops", _ZERO, 0.8 * radius, (colour,))
        yield Hung(other, two, to)
        between = Arrow(f"loop {k}", "loops", _ZERO, _ZERO, 1.0, radius / 3, colour, head=False)
        yield Hung(between, one, at, (two, to))


def _point(values: Array) -> Point:
    x, y, z = (float(value) for value in values)
    return x, y, z
