"""Which branch one leg takes: what is asked for, else the nearest to a reference.

For both legs together see :mod:`scout_pin.kinematics.choosing`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scout_pin.kinematics.branches import EVERY, LABELS, SHAPES, leg_branches
from scout_pin.kinematics.closed_form import one_pose
from scout_pin.kinematics.closed_form.stack import ClosedForm, Free
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.inverse import every_branch, free_values, single_pose
from scout_pin.kinematics.signs import GONE, SUMMANDS
from scout_pin.kinematics.solutions import LegSolutions
from thesis_pin.errors import Unreachable
from thesis_pin.numeric.arrays import check_rigid, finite_array, pose_array, wrap
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.turns import TURN, fitted
from thesis_pin.tolerances import TOLERANCES

Floats = NDArray[np.float64]
Entries = Callable[[slice], np.ndarray]
"""Gives the rows of the rigid placements torso to sole of some samples, entries first,
shape ``(12 or 16, n)``."""


def nearest_first(
    leg: LegGeometry, costs: Floats, numbers: Sequence[int], like: int | None = None
) -> Iterator[int]:
    """Branches by distance; of equally near ones ``like``, then those with the knee forward."""
    shapes, far = SHAPES[leg.heelwards], costs.tolist()
    left = sorted(numbers, key=lambda k: (k != like, shapes[k], k))
    while left:
        nearest = min(map(far.__getitem__, left)) + TOLERANCES.branch_tie
        taken = next(k for k in left if far[k] <= nearest)
        left.remove(taken)
        yield taken


def one_branch(
    leg: LegGeometry,
    side: str,
    target: np.ndarray,
    reference: np.ndarray,
    only: Sequence[int] = EVERY,
) -> np.ndarray:
    """Angles ``(..., 6)`` of one leg near a reference, by the rule of ``Scout.inverse_kinematics``.

    ``only`` are the numbers of the branches it may take.

    Raises:
        Unreachable: Some pose has no valid branch.
    """
    if target.ndim == 3 and len(target) and reference.ndim == 1:
        entries = target.reshape(-1, 16).T
        found = follow_branch(leg, len(target), lambda part: entries[:, part], reference, only)
        if found is not None:
            return found
    return choose_branch(every_branch(leg, target, reference), side, reference, only)


def choose_branch(
    solutions: LegSolutions,
    side: str,
    reference: ArrayLike | None = None,
    only: Sequence[int] = EVERY,
) -> np.ndarray:
    """One valid branch a pose, for one leg alone: the nearest to the reference.

    Args:
        solutions: All branches, of a single pose or a stack.
        side: Name of the leg, for messages.
        reference: Angles [rad], ``(6,)`` or ``(..., 6)``.
        only: Numbers of the branches it may take.

    Returns:
        Angles [rad], shape ``(..., 6)``.

    Raises:
        Unreachable: Some pose has no valid branch.
    """
    leg, angles = solutions.geometry, solutions.angles
    valid = solutions.valid & np.isin(EVERY, only)
    possible = valid.any(axis=-1)
    if not possible.all():
        index = tuple(int(k) for k in np.argwhere(~np.atleast_1d(possible))[0])[: possible.ndim]
        where = f"{side} foot" + (f", sample {index[0]}" if index else "")
        raise Unreachable(
            solutions.explain(index, only), where=where, remedy="Move the torso or the foot closer"
        )
    start = np.zeros(6) if reference is None else np.asarray(reference)
    each = np.ndim(start) > 1
    if angles.ndim == 2 or each:
        cost = np.where(valid, np.abs(wrap(angles - start[..., None, :])).max(axis=-1), np.inf)
        best = _nearest(leg, cost)
        return np.take_along_axis(angles, best[..., None, None], axis=-2)[..., 0, :]
    first = np.abs(wrap(angles[0] - start)).max(axis=-1)
    throughout = valid.reshape(-1, 8).all(axis=0)
    if throughout.any():
        cost = np.where(throughout, first.reshape(-1, 8).max(axis=0), np.inf)
        return np.asarray(angles[..., int(_nearest(leg, cost)), :])
    chosen = np.empty((*angles.shape[:-2], 6))
    previous = np.broadcast_to(start, chosen.shape[1:])
    for k in range(len(angles)):
        step = np.abs(wrap(angles[k] - previous[..., None, :])).max(axis=-1)
        best = _nearest(leg, np.where(valid[k], step, np.inf))
        chosen[k] = np.take_along_axis(angles[k], best[..., None, None], axis=-2)[..., 0, :]
        previous = chosen[k]
    return chosen


def _nearest(leg: LegGeometry, cost: np.ndarray) -> np.ndarray:
    """Number of the nearest branch: ``(..., 8)`` → ``(...)``; of equal ones, knees forward."""
    near = cost <= cost.min(axis=-1, keepdims=True) + TOLERANCES.joint_limit
    return np.asarray(np.argmax(near * (4 - np.array(SHAPES[leg.heelwards])), axis=-1))


def follow_branch(
    leg: LegGeometry,
    count: int,
    matrices: Entries,
    reference: np.ndarray | None = None,
    only: Sequence[int] = EVERY,
    unchecked: str | None = None,
) -> np.ndarray | None:
    """One branch along a whole motion, if one is valid throughout: no other is worked out.

    The branch is the one :func:`choose_branch` takes: of those valid throughout,
    the nearest to the reference at the first sample.

    Args:
        leg: Geometry of the leg.
        count: Number of samples, at least 1.
        matrices: Placements torso to sole.
        reference: Angles [rad], ``(6,)``; None for zero.
        only: Numbers of the branches to try.
        unchecked: Name for messages, if the placements may not be rigid.

    Returns:
        Angles [rad], shape ``(count, 6)``; None if no branch is valid throughout.

    Raises:
        BadInput: A placement isn't rigid.
    """
    costs = distances(leg, matrices, reference)
    for k in nearest_first(leg, costs, only):
        if (theta := along_branch(leg, count, matrices, reference, k, unchecked)) is not None:
            return theta
    return None


def distances(leg: LegGeometry, matrices: Entries, reference: np.ndarray | None) -> Floats:
    """Largest difference of each branch from a reference at the first sample [rad], ``(8,)``.

    Where a branch doesn't reach the knee counts as straight or folded.
    """
    entries = matrices(slice(0, 1))
    if (found := one_pose.summands(leg, _pose(entries), True)) is not None:
        summands = np.array(found[:SUMMANDS])
    else:
        summands = ClosedForm(leg, entries, _free(leg, reference)).summands()[0][:, 0]
    summands[GONE] = 0.0
    gaps = summands.dot(leg.sums).reshape(8, 6) + math.pi  # θ; whole turns don't count
    if reference is not None:
        gaps -= reference
    gaps -= TURN * np.rint(gaps / TURN)
    return np.asarray(np.abs(gaps).max(axis=1))


def along_branch(
    leg: LegGeometry,
    count: int,
    matrices: Entries,
    reference: np.ndarray | None,
    number: int,
    unchecked: str | None = None,
) -> np.ndarray | None:
    """Angles along a motion on one branch ``(count, 6)``; None if it isn't valid throughout.

    Args:
        leg: Geometry of the leg.
        count: Number of samples.
        matrices: Placements torso to sole.
        reference: Angles [rad], ``(6,)``, that fill in what is free; None for zero.
        number: Of the branch.
        unchecked: Name for messages, if the placements may not be rigid.

    Raises:
        BadInput: A placement isn't rigid.
    """
    if count == 1:  # by floats: a third of the time of a gait's single sample
        pose = _pose(matrices(slice(0, 1)))
        if (plain := one_pose.one_branch(leg, pose, number, unchecked is None)) is not None:
            return np.array([plain])
    free = _free(leg, reference)
    lower, upper = leg.lower - TOLERANCES.joint_limit, leg.upper + TOLERANCES.joint_limit
    theta = np.empty((6, count))  # joints first, as rates and dynamics want them
    for part in blocks(count):
        entries = matrices(part)
        form = ClosedForm(leg, entries, free)
        if unchecked is not None and not form.surely_rigid():
            check_rigid(unchecked, entries, entries.shape[1:], part.start)
        angles, excess = form.branch(number)
        if leg.turned:
            angles = fitted(angles, leg.lower[:, None], leg.upper[:, None])
        if not (
            excess.max() <= TOLERANCES.reach  # NaN compares false
            and (angles.min(axis=1) >= lower).all()
            and (angles.max(axis=1) <= upper).all()
        ):
            return None
        theta[:, part] = angles
    return theta.T


def _pose(entries: np.ndarray) -> np.ndarray:
    """Three rows of the first of some placements, entries first: ``(12 or 16, n)`` → ``(3, 4)``."""
    return entries[:12, 0].reshape(3, 4)


def _free(leg: LegGeometry, reference: np.ndarray | None) -> Free:
    return free_values(leg, None if reference is None else reference + leg.beta)


def leg_angles(
    leg: LegGeometry,
    torso_to_foot: ArrayLike,
    branch: str | None = None,
    reference: ArrayLike | None = None,
) -> np.ndarray:
    """One valid branch a pose, for one leg alone, of those asked for the nearest to a reference.

    One asked for by its signs is found twice as fast as all eight.

    Args:
        leg: Geometry of the leg.
        torso_to_foot: Placement of the sole in the torso frame: a ``pin.SE3``, a sequence of
            them, or an array ``(..., 4, 4)``.
        branch: Three signs, as ``"+-+"``; or the way the knee bends, ``"forward"`` or
            ``"backward"``; None for any.
        reference: Angles [rad], ``(6,)`` for a start or ``(..., 6)`` for each pose; None for zero.

    Returns:
        Angles [rad], shape ``(..., 6)``. A stack is a trajectory along its first axis: on one
        branch as long as one is valid throughout.

    Raises:
        Unreachable: Some pose has no such branch that is valid; says which and why.
        BadInput: Wrong shape, NaN, not a rigid placement, or no such branch.
    """
    if reference is None and type(branch) is str and branch in LABELS:
        pose, rigid = single_pose(torso_to_foot)
        if pose is not None:
            theta = one_pose.one_branch(leg, pose, LABELS[branch], rigid)
            if theta is not None:
                return np.array(theta)
    only = leg_branches(leg, branch)
    target = pose_array("torso_to_foot", torso_to_foot)
    start = np.zeros(6) if reference is None else finite_array("reference", reference, 6)
    return one_branch(leg, leg.names[0].split("_")[0], target, start, only)
