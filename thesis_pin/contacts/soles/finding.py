"""Feet of a robot: those that are named, or a guess; their soles from its shapes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.contacts.soles.foot import FRICTION, Foot, by_name, check_free, check_friction
from thesis_pin.contacts.soles.lowest import Lowest, covers, lowest, sole
from thesis_pin.errors import BadInput, ModelError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import frame_id
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_LEVEL = 0.1  # lean of a sole that isn't worth a word [deg]
_BESIDE = 0.02  # joints that near the lowest may be feet as well [m]


def find_feet(
    robot: ClosedRobot,
    names: Sequence[str] | None = None,
    *,
    pose: ArrayLike | None = None,
    friction: float = FRICTION,
) -> tuple[Foot, ...]:
    """Feet of a robot, each with what of its collision shapes is lowest in a pose.

    What lies within 1 mm of a link's lowest point is its sole, if that is 20 mm wide; else it
    is an edge or a point, with the radius of a ball where it is one. Where the pose holds a
    link tilted, its sole is a face that leans by less than 30° and is half as large again as
    what is lowest. Where a point or an edge lies within 1 mm in the sole of another link that
    is fixed to it, that is the sole. ``source`` says both. Soles have at most eight corners.
    Where nobody says which, feet are all links at the ends of limbs that end no higher above
    the lowest than 3 % of the robot's height. Without collision shapes visual ones are taken.

    Args:
        robot: The robot, with a free root.
        names: Frames or links; None for a guess.
        pose: Configuration in which it stands upright, its feet level, shape ``(nq,)``; None
            for the neutral one.
        friction: Coefficient of friction of all.

    Returns:
        The feet, in the model's order if they are guessed; ``source`` says what each is from.

    Raises:
        UnknownName: There is no such frame.
        BadInput: The root is tied to the world, a link has no shapes, or nothing looks like a foot.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    check_free(robot)
    check_friction(friction)
    q = robot.q0 if pose is None else vector("pose", pose, robot.model.nq)
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q)
    pin.updateFramePlacements(robot.model, data)
    shapes = _Shapes(robot)
    if names is None:
        links = _guessed(robot, data, shapes)
        feet = [_foot(robot, data, shapes, link, friction) for link in links]
    else:
        feet = [_foot(robot, data, shapes, name, friction) for name in names]
    return tuple(by_name(feet).values())


class _Shapes:
    """Collision shapes of a robot by joint, else visual ones."""

    def __init__(self, robot: ClosedRobot) -> None:
        self.each: list[list[pin.GeometryObject]] = [[] for _ in range(robot.model.njoints)]
        self.word, self.reason = "collision shapes", ""
        for word in ("collision", "visual"):
            try:
                model = robot.collision_model if word == "collision" else robot.visual_model
            except ModelError as error:  # a mesh is missing
                self.reason = self.reason or error.what
                continue
            for shape in model.geometryObjects:
                self.each[shape.parentJoint].append(shape)
            if any(self.each):
                self.word = f"{word} shapes"
                return

    def of(self, robot: ClosedRobot, frame: int) -> list[pin.GeometryObject]:
        """A link's own shapes; of a frame without any those of its whole body."""
        joint = robot.model.frames[frame].parentJoint
        return self.links(joint).get(frame) or self.each[joint]

    def links(self, joint: int) -> dict[int, list[pin.GeometryObject]]:
        """Shapes of each link that moves with a joint, by the link's frame."""
        found: dict[int, list[pin.GeometryObject]] = {}
        for shape in self.each[joint]:
            found.setdefault(shape.parentFrame, []).append(shape)
        return found


def _foot(robot: ClosedRobot, data: pin.Data, shapes: _Shapes, name: str, friction: float) -> Foot:
    model, up = robot.model, np.array([0.0, 0.0, 1.0])
    frame = frame_id(model, name, where="feet")
    joint = model.frames[frame].parentJoint
    found = sole(shapes.of(robot, frame), data.oMi[joint], up)
    word = shapes.word
    if found is not None and len(found.corners) < 3:
        for other, theirs in shapes.links(joint).items():
            face = sole(theirs, data.oMi[joint], up) if other != frame else None
            if face is not None and covers(face, found):
                found, word = face, f"{shapes.word} as {model.frames[other].name}"
                break
    if found is None:
        because = f" ({shapes.reason})" if shapes.reason else ""
        raise BadInput(
            f"foot {name!r} has no shapes from which its sole could be taken{because}",
            where=robot.description.where,
            remedy=f"Say what meets the floor: {name}=0.2x0.1 (a sole, in metres) or {name}=point",
        )
    return _in_frame(name, data.oMf[frame], found, friction, word)


def _in_frame(name: str, place: pin.SE3, found: Lowest, friction: float, word: str) -> Foot:
    """What is lowest, as a foot on a frame; its sole's origin is below that of the frame."""
    up = found.up
    ahead = place.rotation[:, 0] if abs(place.rotation[:, 0] @ up) < 0.9 else place.rotation[:, 1]
    first = ahead - up * (ahead @ up)
    first /= np.linalg.norm(first)
    turn = np.column_stack([first, np.cross(up, first), up])
    origin = place.translation + up * (found.corners[0] @ up - place.translation @ up)
    if len(found.corners) < 3:
        origin = found.corners.mean(axis=0)
    axes = np.eye(4)
    axes[:3, :3] = place.rotation.T @ turn
    axes[:3, 3] = place.rotation.T @ (origin - place.translation)
    corners = (found.corners - origin) @ turn[:, :2]
    what = {1: "the lowest point", 2: "the lowest edge"}.get(len(corners), "the lowest face")
    if found.radius:
        what = f"a ball of {found.radius * 1e3:.3g} mm"
    source = f"{what} of its {word}"
    if (lean := np.degrees(np.arccos(min(float(up[2]), 1.0)))) > _LEVEL:
        source += f", which leans by {lean:.3g}° in the pose"
    if found.lost > 0:
        source += f", {len(corners)} corners of it ({found.lost:.1%} of the area left out)"
    return Foot(name, name, axes, corners, float(friction), found.radius, source)


def _guessed(robot: ClosedRobot, data: pin.Data, shapes: _Shapes) -> list[str]:
    """Links at the ends of limbs that end about as low as the lowest."""
    model, up = robot.model, np.array([0.0, 0.0, 1.0])
    ends: dict[int, tuple[float, str]] = {}
    for joint in range(1, model.njoints):
        each = [
            (found.height, model.frames[frame].name)
            for frame, own in shapes.links(joint).items()
            if (found := lowest(own, data.oMi[joint], up)) is not None
        ]
        if each:
            ends[joint] = min(each)
    if not ends:
        because = f" ({shapes.reason})" if shapes.reason else ""
        raise BadInput(
            f"nobody said which links are feet, and no shape says which are lowest{because}",
            where=robot.description.where,
            remedy="Name them, with a sole in metres or as points: "
            f"--feet {','.join(f'{link}=0.2x0.1' for link in _lowest_ends(robot, data))} or =point",
        )
    low = min(height for height, _ in ends.values())
    tops = [float(place.translation @ up) for place in list(data.oMi)[1:]]
    ends_of_limbs = ",".join(_lowest_ends(robot, data))
    near = low + TOLERANCES.foot_height * (max(tops) - low)
    feet = {joint: name for joint, (height, name) in ends.items() if height <= near}
    if 1 in feet:
        raise BadInput(
            f"nobody said which links are feet, and {feet[1]!r} of the root is as low as any",
            where=robot.description.where,
            remedy=f"Name them: --feet {ends_of_limbs}, if it stands on these",
        )
    above = {parent for joint in feet for parent in list(model.supports[joint])[:-1]}
    return [name for joint, name in feet.items() if joint not in above]


def _lowest_ends(robot: ClosedRobot, data: pin.Data, most: int = 4) -> list[str]:
    """Links at the ends of limbs whose joints are lowest, to be named in a message."""
    model = robot.model
    parents = set(model.parents.tolist())
    ends = [joint for joint in range(1, model.njoints) if joint not in parents or joint == 1]
    ends = [joint for joint in ends if joint > 1] or ends
    ends.sort(key=lambda joint: round(float(data.oMi[joint].translation[2]), 6))
    low = float(data.oMi[ends[0]].translation[2])
    links: dict[int, str] = {}
    for frame in model.frames:
        if frame.type == pin.FrameType.BODY:
            links.setdefault(frame.parentJoint, frame.name)
    near = [joint for joint in ends if data.oMi[joint].translation[2] < low + _BESIDE]
    return [links[joint] for joint in near if joint in links][:most]
