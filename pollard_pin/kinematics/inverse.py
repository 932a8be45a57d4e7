"""Closed-form inverse kinematics: all twelve angles, every branch labelled.

The wrist centre W fixes chain 0, chain 0 fixes the two ball joints S_i, and each
ball joint fixes its side chain; the wrist joints take up the orientation.
Two-argument arctangents replace the thesis's arctan and 2 arctan, which fail on
half the circle.

Symbols: θ_21 … as printed; f0, e0 … the signs of a :class:`Branch`; (X, Y, Z)
is W seen from the elbow in the frame turned by θ21, which (2.20) prints in the
base frame.

Source: Pollard thesis, 2.4 (2.8–2.23), 2.7 (2.89–2.105), 2.7.4–2.7.6 (2.107).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.kinematics.closed_form import ClosedForm
from pollard_pin.kinematics.geometry import Branch, Geometry
from pollard_pin.kinematics.linkage import Linkage
from pollard_pin.kinematics.regular import singular
from pollard_pin.kinematics.solutions import CLOSES, Solutions, Solved, half_open
from thesis_pin.numeric.arrays import finite_array, spread, wrap
from thesis_pin.numeric.elementwise import (
    ARRAYS,
    FEW,
    FLOATS,
    Elementwise,
    Number,
    Numbers,
    blocks,
)
from thesis_pin.numeric.turns import fitted
from thesis_pin.tolerances import TOLERANCES

_TRIED = 720
"""Values of θ21 or θ43 that are tried where a pose leaves one free."""


def inverse_kinematics(
    geometry: Geometry,
    pose: ArrayLike,
    branches: Sequence[Branch],
    reference: ArrayLike | None = None,
    *,
    squeeze: bool = True,
) -> Solutions:
    """Joint angles that bring the spray tip to a pose, on the branches asked for.

    Where a singular pose leaves an angle free, a branch stands for a family of
    solutions by one member. A straight wrist, and a rod along the axis of a joint,
    keep the reference's angle. A wrist centre on the shoulder's axis, or a forearm
    along y, leave θ21 or θ43 free and all chains depend on it: the reference's value
    is kept if every chain closes and the joint limits hold; otherwise the nearest of
    720 evenly spread ones for which they do, or else for which the chains close.

    Args:
        geometry: The robot's lengths.
        pose: (x, y, z, ψ, θ, φ) [m, rad], shape ``(..., 6)``.
        branches: Labels.
        reference: Angles [rad], ``(12,)`` or ``(..., 12)``, that fill in what a singular
            pose leaves free; None for zero.
        squeeze: Drop the branch axis if there is one branch.

    Returns:
        Angles, margins, residuals and reasons.

    Raises:
        WrongShape, NotFinite: The pose isn't an array ``(..., 6)`` of finite numbers.
    """
    if squeeze and reference is None and len(branches) == 1:
        one = _one(geometry, pose, branches[0])
        if one is not None:
            return one
    pose = finite_array("pose", pose, 6)
    stack, count = pose.shape[:-1], pose.size // 6
    flat, free = pose.reshape(count, 6), None
    if reference is not None:
        given = finite_array("reference", reference, 12)
        free = spread("reference", given, stack).reshape(count, 12)
    work = _few if count < FEW else _many
    angles, cosines, loose = work(geometry, flat, branches, free)
    for k in loose:
        kept = np.zeros(12) if free is None else free[k]
        angles[k], cosines[k] = _members(geometry, flat[k], branches, kept)
    if geometry.turned:
        angles = fitted(angles, geometry.lower, geometry.upper)
    shape: tuple[int, ...] = (*stack, len(branches))
    target = pose[..., None, :]
    if squeeze and len(branches) == 1:
        shape, target = stack, pose
    return Solutions(
        geometry,
        tuple(branches),
        target,
        Solved(angles.reshape(*shape, 12), cosines.reshape(*shape, 3)),
    )


_NONE = (math.nan,) * 12
ZERO = (0.0,) * 12

_Stack = tuple[np.ndarray, np.ndarray, list[int]]
"""Angles ``(n, branches, 12)``, NaN where a chain doesn't close, cosines ``(n, branches, 3)``,
and the poses with θ21 or θ43 free."""


def _one(geometry: Geometry, pose: ArrayLike, branch: Branch) -> Solutions | None:
    """One pose on one branch by floats; None for what takes a closer look."""
    if not isinstance(pose, np.ndarray) or pose.shape != (6,) or pose.dtype.char != "d":
        return None
    numbers = pose.tolist()
    if not math.isfinite(sum(numbers)):
        return None
    chunk = ClosedForm(FLOATS, geometry, numbers, ZERO)
    found = chunk.solve(branch)
    if chunk.loose or geometry.turned:
        return None
    return Solutions(geometry, (branch,), pose, found)


def _few(
    geometry: Geometry, poses: np.ndarray, branches: Sequence[Branch], free: np.ndarray | None
) -> _Stack:
    """A few poses, by floats."""
    angles: list[Number] = []  # one list for all: an array costs more to begin than to fill
    cosines: list[Number] = []
    loose: list[int] = []
    for k, pose in enumerate(poses.tolist()):
        chunk = ClosedForm(FLOATS, geometry, pose, ZERO if free is None else free[k].tolist())
        every = chunk.every(branches) if len(branches) > 1 else (chunk.solve(branches[0]),)
        for found in every:
            cosine = found.cosines
            closed = all(-CLOSES <= one <= CLOSES for one in cosine)
            angles += found.angles if closed else _NONE
            cosines += cosine
        if chunk.loose:
            loose.append(k)
    shape = (len(poses), len(branches))
    rows = half_open(np.array(angles)).reshape(*shape, 12)
    return rows, np.array(cosines).reshape(*shape, 3), loose


def _many(
    geometry: Geometry, poses: np.ndarray, branches: Sequence[Branch], free: np.ndarray | None
) -> _Stack:
    """Many poses, by arrays, in blocks."""
    count, loose = len(poses), []
    angles, cosines = np.empty((count, len(branches), 12)), np.empty((count, len(branches), 3))
    for part in blocks(count):
        kept = np.broadcast_to(0.0, (12, 1)) if free is None else free[part].T
        chunk = ClosedForm(ARRAYS, geometry, np.ascontiguousarray(poses[part].T), kept)
        for b, found in enumerate(chunk.every(branches)):
            rows, cosine = half_open(np.array(found.angles)), np.array(found.cosines)
            beyond = ~(np.abs(cosine).max(axis=0) <= CLOSES)
            if beyond.any():
                rows[:, beyond] = np.nan
            angles[part, b], cosines[part, b] = rows.T, cosine.T
        loose += (part.start + np.flatnonzero(chunk.loose)).tolist()
    return angles, cosines, loose


def usual(
    xp: Elementwise, geometry: Geometry, pose: Numbers, branch: Branch
) -> tuple[Numbers, Numbers, Linkage] | None:
    """Angles, cosines and linkage of some poses; None where one takes a closer look.

    Usual is what is reachable and regular; joint limits are for the caller to look at.

    Args:
        xp: For floats or for arrays.
        geometry: The robot's lengths.
        pose: Six numbers (x, y, z, ψ, θ, φ), floats or arrays ``(n,)``.
        branch: Label.
    """
    chunk = ClosedForm(xp, geometry, pose, ZERO)
    found = chunk.solve(branch)
    known, angles = found.linkage, found.angles
    # A chain that doesn't close, or only just, has a vanishing sine.
    if xp.some(chunk.loose) or singular(xp, geometry, known):
        return None
    if xp is FLOATS:
        return None if -math.pi in angles else (angles, found.cosines, known)
    return half_open(np.array(angles)), found.cosines, known


def _members(
    geometry: Geometry, pose: np.ndarray, branches: Sequence[Branch], free: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Angles and cosines of one pose that leaves θ21 or θ43 free, one member of each family."""
    tried = np.tile(free, (1 + _TRIED, 1))
    tried[1:, :2] += (np.arange(1, 1 + _TRIED) * (2 * np.pi / _TRIED))[:, None]
    angles, cosines, _ = _many(geometry, np.tile(pose, (len(tried), 1)), branches, tried)
    size = np.abs(cosines).max(axis=-1)
    distance = np.abs(wrap(angles - free)).sum(axis=-1)
    distance[0] = -1.0  # the reference's own comes first
    closes = size <= 1.0 + TOLERANCES.reach
    inside = fitted(angles, geometry.lower, geometry.upper)
    beyond = np.maximum(geometry.lower - inside, inside - geometry.upper).max(axis=-1)
    kept = closes & (beyond <= TOLERANCES.joint_limit)
    cost = np.where(closes, distance, 12 * np.pi + size)
    cost = np.where(kept.any(axis=0) & ~kept, np.inf, cost)
    best = np.argmin(cost, axis=0)[None, :, None]
    return (
        np.take_along_axis(angles, best, axis=0)[0],
        np.take_along_axis(cosines, best, axis=0)[0],
    )
