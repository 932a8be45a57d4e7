"""Any robot along a motion, as items of a scene: bodies or bars, and what closes its loops."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import ModelWarning, ThesisPinError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.pages.drawing import (
    CLOSED,
    OPEN,
    closure_items,
    frame_placements,
    joint_placements,
    robot_items,
)
from thesis_pin.pages.meshes import bare, seen
from thesis_pin.pages.scene import Arrow, Ball, Group, Item
from thesis_pin.report.curves import SKY

Array = NDArray[np.float64]

GROUPS = (
    Group("robot", "robot", ((SKY, ""),)),
    Group("loops", "loops", ((CLOSED, "closed"), (OPEN, "open"))),
)
"""Groups of the items."""


_LOOKED = "; looked for in "  # of a message on a mesh: folders follow


def size_of(moves: Array) -> float:
    """How large a robot looks [m], by the placements of its joints ``(n, joints, 7)``."""
    extent = float(np.ptp(moves[..., :3].reshape(-1, 3), axis=0).max())
    return extent if extent > 0 else 1.0


def items_of(robot: ClosedRobot, q: Array) -> tuple[tuple[Item, ...], tuple[str, ...]]:
    """A robot at configurations: its shapes where they are known, else bars; its loops.

    Args:
        robot: The robot; a :class:`~thesis_pin.errors.ModelWarning` says what of it isn't drawn.
        q: Configurations, shape ``(n, nq)``.

    Returns:
        The items, and for the page what of the robot isn't drawn, in words.
    """
    notes: list[str] = []
    visual = seen(robot, "visual", notes)
    bodies = _bodies(robot, visual, q, notes)
    bars = not bodies or bare(robot, visual, notes)
    if notes and bars:
        notes.append("bars are drawn from joint to joint instead")
    if notes:
        warnings.warn("; ".join(notes), ModelWarning, stacklevel=2)
    size = size_of(joint_placements(robot.model, q))
    # A page that is mailed doesn't say where files lie on this machine.
    where, here = robot.description.where, _LOOKED
    short = (note.partition(here)[0].replace(where, os.path.basename(where)) for note in notes)
    told = tuple(f"{note[:1].upper()}{note[1:]}." for note in short)
    return (*bodies, *around(robot, q, size, bars=bars)), told


def around(robot: ClosedRobot, q: Array, size: float, *, bars: bool = False) -> Iterator[Item]:
    """What is drawn of a robot besides its shapes: its loops, and bars for want of shapes.

    Args:
        robot: The robot.
        q: Configurations, shape ``(n, nq)``.
        size: How large it looks [m].
        bars: Whether to draw a bar from joint to joint.
    """
    if bars:
        yield from _bars(robot, q, joint_placements(robot.model, q), size)
    yield from _loops(robot, q, size)


def _bodies(
    robot: ClosedRobot, visual: pin.GeometryModel, q: Array, notes: list[str]
) -> list[Item]:
    """The visual shapes that are there; ``notes`` is told of what can't be drawn."""
    try:
        shapes = robot_items(robot.model, visual, q, group="robot")
    except ThesisPinError as error:  # a shape of a kind that can't be drawn
        notes.append(str(error))
        return []
    return [replace(shape, name=f"body {k} {shape.name}") for k, shape in enumerate(shapes)]


def _bars(robot: ClosedRobot, q: Array, moves: Array, size: float) -> Iterator[Item]:
    """A bar from each joint to the next, and a ball at each."""
    model = robot.model
    for joint in range(1, model.njoints):
        place, name = moves[:, joint, :3], model.names[joint]
        yield Ball(f"joint {joint} {name}", "robot", place, 0.012 * size, (SKY,))
        if parent := model.parents[joint]:
            origin = moves[:, parent, :3]
            yield Arrow(
                f"bar {joint}", "robot", origin, place - origin, 1.0, 6e-3 * size, SKY, head=False
            )
    for k, loop in enumerate(robot.loops):
        for end, frame in zip(loop.ids, loop.frames, strict=True):
            joint = model.frames[end].parentJoint
            if joint:
                origin = moves[:, joint, :3]
                way = frame_placements(model, frame, q)[:, :3] - origin
                name = f"bar to {frame} of loop {k}"
                yield Arrow(name, "robot", origin, way, 1.0, 6e-3 * size, SKY, head=False)


def _loops(robot: ClosedRobot, q: Array, size: float) -> Iterator[Item]:
    """A ball where frames meet; a rod from one to the other where a rod closes the loop."""
    for k, loop in enumerate(robot.loops):
        if loop.length is not None:
            one, two = (frame_placements(robot.model, name, q)[:, :3] for name in loop.frames)
            rod = f"rod of loop {k}"
            yield Arrow(rod, "loops", one, two - one, 1.0, 6e-3 * size, CLOSED, head=False)
            for number, end in enumerate((one, two)):
                yield Ball(f"loop {k} end {number}", "loops", end, 0.012 * size, (CLOSED,))
            continue
        items = closure_items(robot.model, [loop.frames], q, "loops", 0.015 * size)
        for item in items:
            yield replace(item, name=f"loop {k} {item.name}")
