"""Multipliers of the equations → forces and moments that a drawing can show."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.system.equations import Equations, Poses

Array = NDArray[np.float64]


def loop_wrenches(equations: Equations, poses: Poses, multipliers: Array) -> tuple[Array, Array]:
    """Force and moment on each loop's first body, world axes, ``(n, loops, 3)`` each.

    Args:
        equations: The robot's equations.
        poses: Where the loops' frames are.
        multipliers: Of every equation, shape ``(n, equations)``.
    """
    twists = equations.wrenches(poses, multipliers)
    # The residual grows when the second body moves on, so λ pushes that one.
    turned = -np.matmul(poses.turns[:, 0, :, None], twists.reshape(*twists.shape[:2], 2, 3, 1))
    return turned[:, :, 0, :, 0], turned[:, :, 1, :, 0]


def base_wrenches(robot: ClosedRobot, q: Array, base: Array) -> Array:
    """What the world does to a free flyer, in world axes: ``(n, 6)``, or ``(n, 0)``.

    Args:
        robot: The robot.
        q: Configurations, shape ``(n, nq)``.
        base: Force and moment in the base's own axes, shape ``(n, 6)`` or ``(n, 0)``.
    """
    if not base.size:
        return base
    upright = np.array(robot.model.jointPlacements[1].rotation)
    turns = [upright @ pin.Quaternion(*one[[6, 3, 4, 5]]).toRotationMatrix() for one in q]
    return np.concatenate(
        [np.matmul(turns, base[:, part, None])[..., 0] for part in (slice(0, 3), slice(3, 6))],
        axis=1,
    )
