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
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.kinematics.closed_form import one_pose
from scout_pin.kinematics.closed_form.families import axis_bounds, yaw_bounds
from scout_pin.kinematics.closed_form.stack import CHUNK, ClosedForm
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.signs import PLANES, SUMMANDS, sum_angles
from scout_pin.kinematics.solutions import BRANCHES as BRANCHES
from scout_pin.kinematics.solutions import LegSolutions as LegSolutions
from scout_pin.kinematics.solutions import Solved
from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array, pose_array, spread, wrap
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import FEW, blocks
from thesis_pin.numeric.turns import fitted
from thesis_pin.tolerances import TOLERANCES

_FREE_POSES = 64
"""Singular poses worked on at a time: some hundred members of each family are tried."""


def leg_inverse_kinematics(
    leg: LegGeometry,
    torso_to_foot: ArrayLike,
    reference: ArrayLike | None = None,
    *,
    out: LegSolutions | None = None,
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
        out: An earlier answer for as many poses, no longer needed: its angles are written over.
            Fresh memory for a million poses takes as long as their angles.

    Returns:
        The eight branches with validity, residuals and reasons.

    Raises:
        BadInput: Wrong shape, NaN or not a rigid placement.
    """
    if out is not None:
        instance("out", out, LegSolutions, "leg_inverse_kinematics()")
    elif reference is None:
        pose, rigid = single_pose(torso_to_foot)
        if pose is not None and (found := one_pose.summands(leg, pose, rigid)) is not None:
            return LegSolutions(leg, pose, found)
    look_closer = None
    if _plain_stack(torso_to_foot):
        target = np.asarray(torso_to_foot)

        def look_closer() -> None:
            pose_array("torso_to_foot", target)

    else:
        target = pose_array("torso_to_foot", torso_to_foot)
    if reference is not None:
        reference = finite_array("reference", reference, 6)
    return every_branch(leg, target, reference, look_closer, out)


def single_pose(pose: ArrayLike) -> tuple[np.ndarray | None, bool]:
    """A matrix ``(4, 4)``, None if it's another thing, and whether it is known to be rigid."""
    if type(pose) is np.ndarray:
        plain = pose.shape == (4, 4) and pose.dtype == np.float64
        return (pose.copy() if plain else None), False
    return getattr(pose, "homogeneous", None), True


def _plain_stack(pose: ArrayLike) -> bool:
    """Whether these are floats of the right shape, and so many that they are checked on the way."""
    return (
        type(pose) is np.ndarray
        and pose.dtype == np.float64
        and pose.shape[-2:] == (4, 4)
        and pose.size >= 16 * FEW
    )


def every_branch(
    leg: LegGeometry,
    target: np.ndarray,
    reference: np.ndarray | None,
    look_closer: Callable[[], None] | None = None,
    out: LegSolutions | None = None,
) -> LegSolutions:
    """:func:`leg_inverse_kinematics` of arrays that have been checked.

    Args:
        leg: Geometry of the leg.
        target: Placements, shape ``(..., 4, 4)``.
        reference: Angles [rad], shape ``(..., 6)`` or ``(6,)``; None for zero.
        look_closer: Raises unless all of them are rigid, if that isn't known yet; called only
            where it isn't plain.
        out: As for :func:`leg_inverse_kinematics`.
    """
    stack = target.shape[:-2]
    room = None if out is None else out.angles
    if room is not None and room.shape[:-2] != stack:
        raise WrongShape("out", room.shape[:-2], f"{stack}, as torso_to_foot")
    count = math.prod(stack)
    if reference is not None:
        reference = spread("reference", reference, stack).reshape(count, 6)
    entries = target.reshape(count, 16)
    if count < FEW:
        theta, excess, sines = _few(leg, entries)
    else:
        theta, excess, sines = _many(leg, entries, look_closer, room)
    if not (np.minimum(*sines) >= TOLERANCES.singular).all():  # NaN where e is free
        free = np.flatnonzero(~(np.minimum(*sines) >= TOLERANCES.singular))
        excess = excess[:, PLANES]
        for part in blocks(len(free), _FREE_POSES):
            some = free[part]
            given = np.zeros((len(some), 6)) if reference is None else reference[some]
            theta[some], excess[some], sines[1][some] = _members(leg, entries[some], given)
    theta = theta.reshape(*stack, 8, 6)
    if leg.turned:
        theta = fitted(theta, leg.lower, leg.upper)
    sine_axis, sine_hip = (sine.reshape(stack) for sine in sines)
    solved = Solved(theta, excess.reshape(*stack, excess.shape[-1]), (sine_axis, sine_hip))
    return LegSolutions(leg, target, solved)


_Found = tuple[np.ndarray, np.ndarray, np.ndarray]
"""θ ``(n, 8, 6)``, excess ``(n, 2)``, two sines ``(2, n)``: where either is zero, or isn't a
number, angles mean nothing yet."""


def _few(leg: LegGeometry, matrices: np.ndarray) -> _Found:
    """All branches of a few poses, by floats; by arrays if one of them isn't plain."""
    found = [one_pose.summands(leg, matrix.reshape(4, 4), True) for matrix in matrices]
    plain = [one for one in found if one is not None]
    if len(plain) < len(found) or not found:
        return _many(leg, matrices, None, None)
    numbers, form = np.array(plain), ClosedForm(leg, matrices.T)
    theta = sum_angles(leg.sums, numbers[:, :SUMMANDS]).reshape(-1, 8, 6)
    return theta, numbers[:, SUMMANDS:], np.stack([form.sine_axis, form.sine_hip])


def _many(
    leg: LegGeometry,
    matrices: np.ndarray,
    look_closer: Callable[[], None] | None,
    room: np.ndarray | None,
) -> _Found:
    """All branches of many poses, by arrays, in chunks; the angles in memory given, if any."""
    count = len(matrices)
    if room is None or not (room.flags.c_contiguous and room.flags.writeable):
        room = np.empty((count, 8, 6))
    theta, excess, sines = room.reshape(count, 48), np.empty((2, count)), np.empty((2, count))
    for part in blocks(count, CHUNK):
        some = matrices[part]
        form = ClosedForm(leg, some.T)
        if look_closer is not None and not (
            form.surely_rigid() and not some[:, 12:15].any() and (some[:, 15] == 1.0).all()
        ):
            look_closer()
            look_closer = None
        summands, excess[:, part] = form.summands()
        sum_angles(leg.sums, summands.T, theta[part])
        sines[0, part], sines[1, part] = form.sine_axis, form.sine_hip
    return theta.reshape(count, 8, 6), excess.T, sines


def _members(
    leg: LegGeometry, matrices: np.ndarray, reference: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """θ ``(n, 8, 6)``, excess ``(n, 8)`` and |sin γ2| of singular poses: one member of each family.

    The reference's own value of what is free, if it keeps the joint limits; else the
    nearest member that does; else, limits aside, likewise; else the nearest to reach.
    """
    count, columns = len(matrices), np.ascontiguousarray(matrices.T)
    gamma_1, axis = free_values(leg, (reference + leg.beta).T)
    given = ClosedForm(leg, columns, (gamma_1, axis), alike=True)
    v, a = given.v, given.a
    yaws = np.concatenate([gamma_1[None], yaw_bounds(leg, v, a)])
    level = np.array([0.0, 0.0, 1.0])[:, None]
    axes = np.stack([np.stack(axis), *np.broadcast_to(level, (len(yaws) - 1, 3, count))])
    if np.any(given.sine_axis < TOLERANCES.singular):
        more = axis_bounds(leg, v, a, -given.j)
        axes = np.concatenate([axes, more])
        yaws = np.concatenate([yaws, np.broadcast_to(gamma_1, (len(more), count))])
    tried = len(yaws)
    chunk = ClosedForm(
        leg,
        np.tile(columns, tried),
        (yaws.ravel(), (axes[:, 0].ravel(), axes[:, 1].ravel(), axes[:, 2].ravel())),
        alike=True,
    )
    summands, gaps = chunk.summands()
    theta = sum_angles(leg.sums, summands.T).reshape(tried, count, 8, 6)
    excess = gaps[PLANES].T.reshape(tried, count, 8)
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
        given.sine_hip,
    )


def free_values(
    leg: LegGeometry, gamma: np.ndarray | None
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """What a reference, as γ with the joint first, says of γ1 and e; None is neutral."""
    if gamma is None:
        gamma = leg.beta
    cosine, sine = np.cos(gamma[:2]), np.sin(gamma[:2])
    return gamma[0], (cosine[0] * sine[1], sine[0] * sine[1], cosine[1])
