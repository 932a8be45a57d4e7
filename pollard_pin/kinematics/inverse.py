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
from typing import Any

import numpy as np

from pollard_pin.kinematics.closed_form import ClosedForm
from pollard_pin.kinematics.geometry import Branch, Geometry
from pollard_pin.kinematics.solutions import Solutions
from thesis_pin.numeric.arrays import finite_array, spread, wrap
from thesis_pin.numeric.elementwise import ARRAYS, FEW, FLOATS, blocks
from thesis_pin.tolerances import TOLERANCES


def inverse_kinematics(
    geometry: Geometry,
    pose: Any,
    branches: Sequence[Branch],
    reference: Any = None,
    *,
    squeeze: bool = True,
) -> Solutions:
    """Joint angles that bring the spray tip to a pose, on the branches asked for.

    Args:
        geometry: The robot's lengths.
        pose: (x, y, z, ψ, θ, φ) [m, rad], shape ``(..., 6)``.
        branches: Labels.
        reference: Angles [rad], ``(12,)`` or ``(..., 12)``, whose θ1615 is kept where
            the wrist is straight and only θ1615 ± θ1817 is determined (0 without one).
        squeeze: Drop the branch axis if there is one branch.

    Returns:
        Angles, margins, residuals and reasons.

    Raises:
        WrongShape, NotFinite: The pose isn't an array ``(..., 6)`` of finite numbers.
    """
    target = finite_array("pose", pose, 6)
    stack, count = target.shape[:-1], math.prod(target.shape[:-1])
    flat = target.reshape(count, 6)
    roll = np.zeros(count)
    if reference is not None:
        given = finite_array("reference", reference, 12)
        roll = spread("reference", given, stack)[..., 3].reshape(count)
    work = _few if count < FEW else _many
    angles, cosines = work(geometry, flat, branches, roll)
    if (beyond := ~(np.abs(cosines).max(axis=-1) <= 1.0 + TOLERANCES.reach)).any():
        angles[beyond] = np.nan
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


def _few(
    geometry: Geometry, poses: np.ndarray, branches: Sequence[Branch], roll: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Angles ``(n, branches, 12)`` and cosines ``(n, branches, 3)`` of n poses, by floats."""
    numbers: list[float] = []  # one list for all: an array costs more to begin than to fill
    for pose, one in zip(poses.tolist(), roll.tolist(), strict=True):
        chunk = ClosedForm(FLOATS, geometry, pose, one)
        for branch in branches:
            angles, cosines = chunk.solve(branch)
            numbers += angles
            numbers += cosines
    rows = np.array(numbers).reshape(len(poses), len(branches), 15)
    return wrap(rows[..., :12]), rows[..., 12:]


def _many(
    geometry: Geometry, poses: np.ndarray, branches: Sequence[Branch], roll: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The same by arrays, in blocks."""
    count = len(poses)
    angles, cosines = np.empty((count, len(branches), 12)), np.empty((count, len(branches), 3))
    for part in blocks(count):
        chunk = ClosedForm(ARRAYS, geometry, np.ascontiguousarray(poses[part].T), roll[part])
        for b, branch in enumerate(branches):
            found, cosine = chunk.solve(branch)
            angles[part, b] = wrap(np.array(found)).T
            cosines[part, b] = np.array(cosine).T
    return angles, cosines
