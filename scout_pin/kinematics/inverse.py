"""Closed-form inverse kinematics of a leg: every branch.

A leg has joint axes z y z z z x. Joints 1 and 2 meet in p2; joints 3, 4, 5 are
parallel, with common direction e; joint 6 passes through p5. So the foot fixes
p5 and the axis a of joint 6, and e must be perpendicular to a and to
v = p5 − p2: two choices of e, two of joint 2 for each, two of the knee.

Symbols as in :mod:`scout_pin.kinematics.forward`.

Source: Scout thesis, 3.1, the loop equation (3.4); the closed form replaces the
thesis's numeric solver.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.kinematics.closed_form import ClosedForm, Free
from scout_pin.kinematics.families import axis_bounds, yaw_bounds
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.solutions import BRANCHES as BRANCHES
from scout_pin.kinematics.solutions import LegSolutions as LegSolutions
from thesis_pin.numeric.arrays import finite_array, pose_array, spread, wrap
from thesis_pin.numeric.elementwise import ARRAYS, FEW, FLOATS, Elementwise, Number, Numbers, blocks
from thesis_pin.numeric.turns import fitted
from thesis_pin.tolerances import TOLERANCES

_FREE_POSES = 64
"""Singular poses worked on at a time: some hundred members of each family are tried."""

PAIRS = tuple((axis, two) for axis, two, _ in BRANCHES[::2])  # two ways of the knee each


def leg_inverse_kinematics(
    leg: LegGeometry, torso_to_foot: ArrayLike, reference: ArrayLike | None = None
) -> LegSolutions:
    """Every set of joint angles that brings a sole to a pose.

    Where a singular pose leaves an angle free there are families of them, and each
    branch stands for one family by one member: the reference's, if it keeps the joint
    limits; otherwise the nearest to the reference that does, or, if none does, that
    reaches. A branch is called unreachable only if no member of its family reaches.

    Args:
        leg: Geometry of the leg.
        torso_to_foot: Placement of the sole frame in the torso frame: a
            ``pin.SE3``, a sequence of them, or an array ``(..., 4, 4)``.
        reference: Angles θ [rad], ``(..., 6)`` or ``(6,)``, that fill in what a
            singular pose leaves free; None for zero.

    Returns:
        The eight branches with validity, residuals and reasons.

    Raises:
        BadInput: Wrong shape, NaN or not a rigid placement.
    """
    target = pose_array("torso_to_foot", torso_to_foot)
    if reference is not None:
        reference = finite_array("reference", reference, 6)
    return every_branch(leg, target, reference)


def every_branch(
    leg: LegGeometry, target: np.ndarray, reference: np.ndarray | None
) -> LegSolutions:
    """:func:`leg_inverse_kinematics` of arrays that have been checked."""
    stack = target.shape[:-2]
    count = math.prod(stack)
    if reference is not None:
        reference = spread("reference", finite_array("reference", reference, 6), stack)
        reference = reference.reshape(count, 6)
    work, entries = _few if count < FEW else _many, target.reshape(count, 16)
    theta, excess, sine_axis, sine_hip = work(leg, entries, reference)
    if count and min(sine_axis.min(), sine_hip.min()) < TOLERANCES.singular:
        free = np.flatnonzero(np.minimum(sine_axis, sine_hip) < TOLERANCES.singular)
        for part in blocks(len(free), _FREE_POSES):
            some = free[part]
            given = np.zeros((len(some), 6)) if reference is None else reference[some]
            theta[some], excess[some] = _members(leg, entries[some], given)
    if (beyond := excess > TOLERANCES.reach).any():
        theta[beyond] = np.nan
    if leg.turned:
        theta = fitted(theta, leg.lower, leg.upper)
    return LegSolutions(
        leg,
        target,
        theta.reshape(*stack, 8, 6),
        excess.reshape(*stack, 8),
        sine_axis.reshape(stack),
        sine_hip.reshape(stack),
    )


_Solved = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""θ ``(n, 8, 6)``, excess ``(n, 8)``, two sines ``(n,)``."""


def _few(leg: LegGeometry, matrices: np.ndarray, reference: np.ndarray | None) -> _Solved:
    """All branches of a few poses, by floats."""
    numbers: list[Number] = []  # one list for all: an array costs more to begin than to fill
    for k, matrix in enumerate(matrices.tolist()):
        free = free_values(
            leg, FLOATS, None if reference is None else (reference[k] + leg.beta).tolist()
        )
        chunk = ClosedForm(FLOATS, leg, matrix, free)
        excesses: list[Number] = []
        for axis, two in PAIRS:
            one, other, excess = chunk.solve(axis, two)
            numbers += one
            numbers += other
            excesses += (excess, excess)
        numbers += (*excesses, chunk.sine_axis, chunk.h)
    rows = np.array(numbers).reshape(-1, 58)
    theta = wrap(rows[:, :48].reshape(-1, 8, 6) - leg.beta)
    return theta, rows[:, 48:56], rows[:, 56], rows[:, 57]


def _many(leg: LegGeometry, matrices: np.ndarray, reference: np.ndarray | None) -> _Solved:
    """All branches of many poses, by arrays, in blocks; the sample is their last axis."""
    count = len(matrices)
    theta, excess, sines = np.empty((8, 6, count)), np.empty((8, count)), np.empty((2, count))
    for part in blocks(count):
        given = None if reference is None else (reference[part] + leg.beta).T
        columns = np.ascontiguousarray(matrices[part].T)
        chunk = ClosedForm(ARRAYS, leg, columns, free_values(leg, ARRAYS, given))
        for k, pair in enumerate(PAIRS):
            one, other, excess[2 * k : 2 * k + 2, part] = chunk.solve(*pair)
            theta[2 * k, :, part], theta[2 * k + 1, :, part] = one, other
        theta[:, :, part] = wrap(theta[:, :, part] - leg.beta[:, None])
        sines[:, part] = chunk.sine_axis, chunk.h
    return theta.transpose(2, 0, 1), excess.T, sines[0], sines[1]


def _members(
    leg: LegGeometry, matrices: np.ndarray, reference: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """θ ``(n, 8, 6)`` and excess ``(n, 8)`` of singular poses: one member of each family.

    The reference's own value of what is free, if it keeps the joint limits; else the
    nearest member that does; else, limits aside, likewise; else the nearest to reach.
    """
    count, columns = len(matrices), np.ascontiguousarray(matrices.T)
    gamma_1, axis = free_values(leg, ARRAYS, (reference + leg.beta).T)
    given = ClosedForm(ARRAYS, leg, columns, (gamma_1, axis))
    v, a, j = (np.stack(vector) for vector in (given.reach, given.a, given.j))
    level = np.array([0.0, 0.0, 1.0])[:, None]
    yaws = np.concatenate([np.array(gamma_1)[None], yaw_bounds(leg, v, a)])
    axes = np.stack([np.stack(axis), *np.broadcast_to(level, (len(yaws) - 1, 3, count))])
    if np.any(given.sine_axis < TOLERANCES.singular):
        more = axis_bounds(leg, v, a, j)
        axes = np.concatenate([axes, more])
        yaws = np.concatenate([yaws, np.broadcast_to(gamma_1, (len(more), count))])
    tried = len(yaws)
    chunk = ClosedForm(
        ARRAYS,
        leg,
        np.tile(columns, tried),
        (yaws.ravel(), (axes[:, 0].ravel(), axes[:, 1].ravel(), axes[:, 2].ravel())),
    )
    gamma, gaps = np.empty((8, 6, tried * count)), np.empty((8, tried * count))
    for k, pair in enumerate(PAIRS):
        gamma[2 * k], gamma[2 * k + 1], gaps[2 * k : 2 * k + 2] = chunk.solve(*pair)
    theta = wrap(gamma - leg.beta[:, None]).reshape(8, 6, tried, count).transpose(2, 3, 0, 1)
    excess = gaps.reshape(8, tried, count).transpose(1, 2, 0)
    theta = fitted(theta, leg.lower, leg.upper)
    distance = np.abs(wrap(theta - reference[:, None, :])).sum(axis=-1)
    distance[0] = -1.0  # the reference's own comes first
    beyond = np.maximum(leg.lower - theta, theta - leg.upper).max(axis=-1)
    reaches = excess <= TOLERANCES.reach
    best = np.argmin(np.where(reaches, distance, 6 * np.pi + excess), axis=0)
    kept = reaches & (beyond <= TOLERANCES.joint_limit)
    best = np.where(kept.any(axis=0), np.argmin(np.where(kept, distance, np.inf), axis=0), best)
    return (
        np.take_along_axis(theta, best[None, ..., None], axis=0)[0],
        np.take_along_axis(excess, best[None], axis=0)[0],
    )


def free_values(leg: LegGeometry, xp: Elementwise, gamma: Numbers | None) -> Free:
    """What a reference, as γ with the joint first, says of γ1 and e; None is neutral."""
    if gamma is None:
        gamma = leg.beta.tolist()
    (c1, s1), (c2, s2) = xp.cosine_sine(gamma[0]), xp.cosine_sine(gamma[1])
    return gamma[0], (c1 * s2, s1 * s2, c2)
