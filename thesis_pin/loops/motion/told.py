"""How some joints of a robot move: what a motion is before the loops move the others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.motion.variants import Variants

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class JointMotion:
    """How some joints of a robot move.

    Attributes:
        name: What it is called in reports.
        time: Sample times [s], shape ``(n,)``.
        joints: Names of the joints, ``k`` of them.
        position: [rad] or [m], shape ``(n, k)``.
        rate: [rad/s] or [m/s], the same shape.
        acceleration: [rad/s²] or [m/s²], the same.
        base: Placement of a free root over time, position and quaternion x, y, z, w,
            shape ``(n, 7)``; None if it isn't given.
        interpolated: Joints whose rates or accelerations were made from the samples, ``base``
            among them.
        warnings: What is odd about the samples.
        notes: How the file was read, where that isn't plain.
        base_change: First and second derivatives of ``base``, each ``(n, 7)``; None for those
            of splines through it.
        variants: What samples of finite resolution leave open; None if the motion is exact,
            as far as anybody knows.
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
