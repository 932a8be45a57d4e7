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
from pollard_pin.kinematics.solutions import Solutions
from thesis_pin.numeric.arrays import finite_array, spread, wrap
from thesis_pin.numeric.elementwise import ARRAYS, FEW, FLOATS, Number, blocks
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
    target = finite_array("pose", pose, 6)
    stack, count = target.shape[:-1], math.prod(target.shape[:-1])
    flat = target.reshape(count, 6)
    free = np.zeros((count, 12))
    if reference is not None:
        given = finite_array("reference", reference, 12)
        free = spread("reference", given, stack).reshape(count, 12)
    work = _few if count < FEW else _many
    angles, cosines, loose = work(geometry, flat, branches, free)
    for k in loose:
        angles[k], cosines[k] = _members(geometry, flat[k], branches, free[k])
    if (beyond := ~(np.abs(cosines).max(axis=-1) <= 1.0 + TOLERANCES.reach)).any():
        angles[beyond] = np.nan
    if geometry.turned:
        angles = fitted(angles, geometry.lower, geometry.upper)
    shape: tuple[int, ...] = (*stack, len(branches))
    target = target[..., None, :]
    if squeeze and len(branches) == 1:
        shape, target = stack, target[..., 0, :]
    return Solutions(
        geometry,
        tuple(branches),
        target,
        angles.reshape(*shape, 12),
        cosines.reshape(*shape, 3),
    )


_Solved = tuple[np.ndarray, np.ndarray, list[int]]
"""Angles ``(n, branches, 12)``, cosines ``(n, branches, 3)``, poses with θ21 or θ43 free."""


def _few(
    geometry: Geometry, poses: np.ndarray, branches: Sequence[Branch], free: np.ndarray
) -> _Solved:
    """A few poses, by floats."""
    numbers: list[Number] = []  # one list for all: an array costs more to begin than to fill
    loose: list[int] = []
    for k, (pose, one) in enumerate(zip(poses.tolist(), free.tolist(), strict=True)):
        chunk = ClosedForm(FLOATS, geometry, pose, one)
        for branch in branches:
            angles, cosines = chunk.solve(branch)
            numbers += angles
            numbers += cosines
        if chunk.loose:
            loose.append(k)
    rows = np.array(numbers).reshape(len(poses), len(branches), 15)
    return wrap(rows[..., :12]), rows[..., 12:], loose


def _many(
    geometry: Geometry, poses: np.ndarray, branches: Sequence[Branch], free: np.ndarray
) -> _Solved:
    """Many poses, by arrays, in blocks."""
    count, loose = len(poses), []
    angles, cosines = np.empty((count, len(branches), 12)), np.empty((count, len(branches), 3))
    for part in blocks(count):
        chunk = ClosedForm(ARRAYS, geometry, np.ascontiguousarray(poses[part].T), free[part].T)
        for b, branch in enumerate(branches):
            found, cosine = chunk.solve(branch)
            angles[part, b] = wrap(np.array(found)).T
            cosines[part, b] = np.array(cosine).T
        loose += (part.start + np.flatnonzero(chunk.loose)).tolist()
    return angles, cosines, loose


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
