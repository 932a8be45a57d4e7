"""Where feet are in a motion, and what a push on each does to the joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.display.brief import Brief
from thesis_pin.model.loading import LoadedRobot, frame_id
from thesis_pin.numeric.arrays import skew
from thesis_pin.numeric.elementwise import blocks

Array = NDArray[np.float64]

CHUNK = 1024
"""Samples worked on at once, so that memory stays bounded."""

_AXES = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


@dataclass(frozen=True, eq=False)
class Stance(Brief):
    """Feet over some samples; all in the world's axes.

    Attributes:
        origin: Of each foot's sole; of a point, where it touches [m], shape ``(n, feet, 3)``.
        turn: Axes of each contact as columns: of a sole its own, of points and edges the
            floor's, shape ``(n, feet, 3, 3)``.
        corners: Of each foot, a list of ``(n, k, 3)`` [m].
        speed: Largest speed of a corner [m/s], shape ``(n, feet)``.
        frames: Origins of the frames that the feet are fixed to [m], ``(n, feet, 3)``.
        root: Where the root's joint is [m], shape ``(n, 3)``.
        com: Centre of mass [m], shape ``(n, 3)``.
    """

    origin: Array
    turn: Array
    corners: list[Array]
    speed: Array
    frames: Array
    root: Array
    com: Array

    def part(self, some: slice | NDArray[np.intp]) -> Stance:
        """The feet at some of the samples."""
        return Stance(
            self.origin[some],
            self.turn[some],
            [corners[some] for corners in self.corners],
            self.speed[some],
            self.frames[some],
            self.root[some],
            self.com[some],
        )

    @classmethod
    def joined(cls, parts: Sequence[Stance]) -> Stance:
        """The feet at the samples of several, one after the other."""
        every = [[getattr(part, field.name) for part in parts] for field in fields(cls)]
        origin, turn, corners, speed, frames, root, com = every
        return cls(
            np.concatenate(origin),
            np.concatenate(turn),
            [np.concatenate(points) for points in zip(*corners, strict=True)],
            np.concatenate(speed),
            np.concatenate(frames),
            np.concatenate(root),
            np.concatenate(com),
        )


@dataclass(frozen=True, eq=False)
class Levers:
    """What pushes on feet do to the joints, over some samples; kilobytes a sample.

    Attributes:
        frames: Origins of the frames that the feet are fixed to [m], ``(n, feet, 3)``.
        jacobian: Of these frames, linear then angular, world axes, shape ``(n, feet, 6, nv)``.
    """

    frames: Array
    jacobian: Array

    def part(self, some: slice | NDArray[np.intp]) -> Levers:
        """They at some of the samples."""
        return Levers(self.frames[some], self.jacobian[some])

    def pushes(self, foot: int, points: Array) -> Array:
        """Generalized forces of unit forces at points of a foot, ``(n, 3)`` → ``(n, nv, 3)``."""
        arm = points - self.frames[:, foot]
        linear, angular = self.jacobian[:, foot, :3], self.jacobian[:, foot, 3:]
        return np.asarray(np.swapaxes(linear - skew(arm) @ angular, 1, 2))

    def turns(self, foot: int) -> Array:
        """Generalized forces of unit moments on a foot, shape ``(n, nv, 3)``."""
        return np.asarray(np.swapaxes(self.jacobian[:, foot, 3:], 1, 2))


def stance(
    robot: LoadedRobot, feet: Sequence[Foot], floor: Floor, q: Array, v: Array | None = None
) -> Stance:
    """Where the feet are.

    Args:
        robot: The robot.
        feet: Its feet.
        floor: The floor, whose normal says where a ball touches.
        q: Configurations, shape ``(n, nq)``.
        v: Rates, shape ``(n, nv)``; None for none.

    Raises:
        UnknownName: A foot is on a frame that isn't there.
    """
    parts = blocks(len(q), CHUNK)
    rates = [None if v is None else v[some] for some in parts]
    return Stance.joined(
        [placed(robot, feet, floor, q[p], rate)[0] for p, rate in zip(parts, rates, strict=True)]
    )


def placed(
    robot: LoadedRobot, feet: Sequence[Foot], floor: Floor, q: Array, v: Array | None = None
) -> tuple[Stance, Levers]:
    """:func:`stance`, and what pushes on the feet do to the joints."""
    model = robot.model
    data, count = model.createData(), len(q)
    ids = [frame_id(model, foot.frame, where=f"foot {foot.name}") for foot in feet]
    turns = np.empty((count, len(feet), 3, 3))
    frames = np.empty((count, len(feet), 3))
    jacobian = np.empty((count, len(feet), 6, model.nv))
    root, com = np.empty((count, 3)), np.empty((count, 3))
    for k in range(count):
        pin.computeJointJacobians(model, data, q[k])
        pin.updateFramePlacements(model, data)
        com[k] = pin.centerOfMass(model, data, q[k], False)
        root[k] = data.oMi[1].translation if model.njoints > 1 else 0.0
        for j, frame in enumerate(ids):
            turns[k, j] = data.oMf[frame].rotation
            frames[k, j] = data.oMf[frame].translation
            jacobian[k, j] = pin.getFrameJacobian(model, data, frame, _AXES)
    origin, axes, corners = np.empty_like(frames), np.empty_like(turns), []
    for j, foot in enumerate(feet):
        sole = turns[:, j] @ foot.placement[:3, :3]
        origin[:, j] = frames[:, j] + turns[:, j] @ foot.placement[:3, 3]
        reach = np.einsum("nij,kj->nki", sole[:, :, :2], foot.corners)
        touching = origin[:, j, None] + reach - foot.radius * floor.normal
        corners.append(touching)
        axes[:, j] = sole
        if foot.kind != "sole":
            axes[:, j] = floor.axes
            origin[:, j] = touching.mean(axis=1)
    speed = np.zeros((count, len(feet)))
    if v is not None:
        twist = np.einsum("nfiv,nv->nfi", jacobian, v)
        for j, points in enumerate(corners):
            arm = points - frames[:, j, None]
            moved = twist[:, j, None, :3] + np.cross(twist[:, j, None, 3:], arm)
            speed[:, j] = np.linalg.norm(moved, axis=-1).max(axis=1)
    return Stance(origin, axes, corners, speed, frames, root, com), Levers(frames, jacobian)
