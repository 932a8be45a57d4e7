"""Generalized forces of the open tree: inertia, gravity, and what the description adds."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.system.equations import Poses
from thesis_pin.model.loading import frame_id
from thesis_pin.numeric.arrays import finite_array, spread
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Wrenches = Mapping[str, ArrayLike]


def passive_forces(robot: ClosedRobot, q: Array, v: Array, sliding: Array | None = None) -> Array:
    """What moves against damping, friction and springs, shape ``(n, nv)``.

    Friction of a joint at rest is taken as zero.

    Args:
        robot: The robot.
        q: Configurations, shape ``(n, nq)``.
        v: Rates, shape ``(n, nv)``.
        sliding: Which way each joint's friction is overcome, 1, −1 or 0, same shape; None for
            that of its rate, where this isn't zero.
    """
    model = robot.model
    if sliding is None:
        sliding = np.where(np.abs(v) > TOLERANCES.static, np.sign(v), 0.0)
    forces = model.damping * v + model.upperDryFrictionLimit * sliding
    for spring in robot.springs:
        joint = model.joints[model.getJointId(spring.joint)]
        position = q[:, joint.idx_q]
        if joint.nq == 2:
            position = np.arctan2(q[:, joint.idx_q + 1], position)
        stretch = position - spring.rest
        if joint.nq == 2:
            stretch = stretch - 2 * np.pi * np.round(stretch / (2 * np.pi))
        forces[:, joint.idx_v] += spring.stiffness * stretch
    return np.asarray(forces)


def open_tree_forces(
    robot: ClosedRobot, data: pin.Data, q: Array, v: Array, a: Array, sliding: Array | None = None
) -> Array:
    """Generalized forces that the motion of the open tree needs, shape ``(n, nv)``.

    ``sliding`` is that of :func:`passive_forces`.
    """
    tau = np.empty_like(v)
    for k in range(len(q)):
        tau[k] = pin.rnea(robot.model, data, q[k], v[k], a[k])
    tau += passive_forces(robot, q, v, sliding)
    return tau


def checked_wrenches(
    robot: ClosedRobot, external: Wrenches | None, stack: tuple[int, ...]
) -> list[tuple[int, Array]]:
    """Frames and wrenches ``(n, 6)`` that act on them from outside.

    Raises:
        UnknownName: A frame doesn't exist.
        WrongShape, NotFinite, BadInput: A wrench can't be used.
    """
    found = []
    for name, value in (external or {}).items():
        wrench = finite_array(f"external wrench on {name!r}", value, 6)
        wrench = spread(f"external wrench on {name!r}", wrench, stack)
        found.append((frame_id(robot.model, name, where="external"), wrench.reshape(-1, 6)))
    return found


def external_forces(
    robot: ClosedRobot, data: pin.Data, poses: Poses, wrenches: list[tuple[int, Array]]
) -> Array:
    """Generalized forces ``(n, nv)`` of wrenches on frames, by virtual work."""
    model = robot.model
    tau = np.zeros((len(poses.q), model.nv))
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    for k in range(len(poses.q)) if wrenches else ():
        pin.computeJointJacobians(model, data, poses.q[k])
        pin.updateFramePlacements(model, data)
        for frame, wrench in wrenches:
            tau[k] += pin.getFrameJacobian(model, data, frame, axes).T @ wrench[k]
    return tau
