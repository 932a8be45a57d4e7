"""How some joints of a robot move: what a motion is before the loops move the others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.loops.motion.variants import Variants
from thesis_pin.loops.system.rows import Mask

Array = NDArray[np.float64]

COORDINATES = ("x", "y", "z", "roll", "pitch", "yaw")
"""Of a frame in the world; its turns are about the world's x, y, z, in that order."""


@dataclass(frozen=True)
class Tool:
    """A frame that is told to move.

    Attributes:
        frame: Its name.
        told: Which of :data:`COORDINATES` are told; the others are left to the robot.
        kept: How the frame is to be turned before its yaw, if that is told, or at all, as a
            quaternion x, y, z, w: the robot has to do so by itself. None if nobody says.
    """

    frame: str
    told: tuple[str, ...]
    kept: tuple[float, ...] | None = None

    @property
    def rows(self) -> Mask:
        """Which of its shifts and turns are told."""
        x, y, z, roll, pitch, yaw = (name in self.told for name in COORDINATES)
        return x, y, z, roll, pitch, yaw


@dataclass(frozen=True, eq=False)
class JointMotion(Brief):
    """How some joints of a robot move.

    Attributes:
        name: What it is called in reports.
        time: Sample times [s], shape ``(n,)``.
        joints: Names of the joints, ``k`` of them.
        position: [rad] or [m], shape ``(n, k)``.
        rate: [rad/s] or [m/s], the same shape.
        acceleration: [rad/s²] or [m/s²], the same.
        base: Placement of a free root, or of the tool's frame, over time: position and
            quaternion x, y, z, w, shape ``(n, 7)``; None if it isn't given.
        interpolated: Joints whose rates or accelerations were made from the samples, ``base``
            among them.
        warnings: What is odd about the samples.
        notes: How the file was read, where that isn't plain.
        base_change: First and second derivatives of ``base``, each ``(n, 7)``; None for those
            of splines through it.
        variants: What samples of finite resolution leave open; None if the motion is exact,
            as far as anybody knows.
        tool: The frame whose placement ``base`` is; None for a free root's.
        lines: Line of the file that holds each sample, shape ``(n,)``; None without a file.
    """

    name: str
    time: Array
    joints: tuple[str, ...]
    position: Array
    rate: Array
    acceleration: Array
    base: Array | None = None
    interpolated: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    base_change: tuple[Array, Array] | None = None
    variants: Variants | None = None
    tool: Tool | None = None
    lines: NDArray[np.intp] | None = None

    def where(self, sample: int) -> str:
        """Where a sample stands, for messages."""
        line = "" if self.lines is None else f" ({self.name}:{self.lines[sample]})"
        return f"sample {sample}{line}"
