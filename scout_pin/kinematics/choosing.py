"""Which branch a leg takes where several reach: what is asked for, else one shape for both legs.

The rule, where no reference says what to be near: both legs stand alike, knees one way and
hips one way, in the shape whose farther leg is nearest to the neutral pose; where two
are equally near, knees bend forward. Only where no shape serves both legs does each leg
take its own nearest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scout_pin.kinematics import one_pose
from scout_pin.kinematics.branches import EVERY, SHAPES, Legs, Numbers, members, mirrored
from scout_pin.kinematics.closed_form import ClosedForm, Free
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.inverse import every_branch, free_values
from scout_pin.kinematics.signs import GONE, SUMMANDS, sum_angles
from scout_pin.kinematics.solutions import LegSolutions
from scout_pin.specification import SIDES
from thesis_pin.errors import Unreachable
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.turns import fitted
from thesis_pin.tolerances import TOLERANCES

Floats = NDArray[np.float64]
Entries = Callable[[slice], np.ndarray]
"""Gives the rows of the rigid placements torso to sole of some samples, entries first,
shape ``(12 or 16, n)``."""


def both_legs(
    legs: Legs, targets: Sequence[np.ndarray], allowed: tuple[Numbers, Numbers]
) -> list[np.ndarray]:
    """Angles ``(..., 6)`` of both legs, one branch a leg, by the rule above.

    Args:
        legs: Left and right leg.
        targets: Placement of each sole in the torso frame, ``(..., 4, 4)``; a stack is a
            trajectory along its first axis.
        allowed: Numbers of the branches each leg may take.

    Raises:
        Unreachable: Some pose has no valid branch.
    """
    if all(target.ndim == 3 and len(target) for target in targets):
        columns = [target.reshape(-1, 16).T for target in targets]

        def entries(number: int) -> Entries:
            return lambda part: columns[number][:, part].copy()

        counts = (len(targets[0]), len(targets[1]))
        found = follow_both(legs, counts, (entries(0), entries(1)), allowed)
        return [
            choose_branch(every_branch(leg, target, None), side, None, only)
            if angles is None
            else angles
            for leg, side, target, only, angles in zip(
                legs, SIDES, targets, allowed, found, strict=True
            )
        ]
    solutions = [every_branch(leg, target, None) for leg, target in zip(legs, targets, strict=True)]
    costs = [_first_distance(one) for one in solutions]
    throughout = [np.atleast_1d(one.valid.reshape(-1, 8).all(axis=0)) for one in solutions]
    taken = _choose(legs, costs, allowed, lambda leg, k: bool(throughout[leg][k]))
    return [
        choose_branch(one, side, None, only if number is None else (number,))
        for one, side, only, number in zip(solutions, SIDES, allowed, taken, strict=True)
    ]


def follow_both(
    legs: Legs,
    counts: tuple[int, int],
    entries: tuple[Entries, Entries],
    allowed: tuple[Numbers, Numbers],
) -> list[np.ndarray | None]:
    """Angles of both legs along a motion, ``(count, 6)`` each; None without a branch throughout.

    Args:
        legs: Left and right leg.
        counts: Number of samples of each, at least 1.
        entries: Placements of each sole.
        allowed: Numbers of the branches each leg may take.
    """
    costs = [distances(leg, one, None) for leg, one in zip(legs, entries, strict=True)]
    tried: dict[tuple[int, int], np.ndarray | None] = {}

    def keeps(leg: int, k: int) -> bool:
        if (leg, k) not in tried:
            tried[leg, k] = _along(legs[leg], counts[leg], entries[leg], None, k)
        return tried[leg, k] is not None

    taken = _choose(legs, costs, allowed, keeps)
    return [None if k is None else tried[leg, k] for leg, k in enumerate(taken)]


def _choose(
    legs: Legs,
    costs: Sequence[Floats],
    allowed: tuple[Numbers, Numbers],
    keeps: Callable[[int, int], bool],
) -> tuple[int | None, int | None]:
    """The branch of each leg, None where none is valid throughout.

    ``costs`` are distances from neutral at the first sample, ``(8,)`` each; ``keeps`` says
    whether a leg's branch is valid throughout.
    """
    for form in _shapes(legs, costs, allowed):
        for one in _nearest_first(legs[0], costs[0], members(legs[0], form, allowed[0])):
            if not keeps(0, one):
                continue
            right = members(legs[1], form, allowed[1])
            like = mirrored(legs, one)
            for other in _nearest_first(legs[1], costs[1], right, like):
                if keeps(1, other):
                    return one, other
            break  # the left leg's other branch of this shape doesn't help the right one
    alone: list[int | None] = []
    for leg in (0, 1):
        nearest = _nearest_first(legs[leg], costs[leg], allowed[leg])
        alone.append(next((k for k in nearest if keeps(leg, k)), None))
    return alone[0], alone[1]


def _shapes(legs: Legs, costs: Sequence[Floats], allowed: tuple[Numbers, Numbers]) -> Iterator[int]:
    """Shapes both legs may have, the nearest first; of equally near ones, knees forward."""
    distance: dict[int, float] = {}
    for form in range(4):
        some = [members(legs[leg], form, allowed[leg]) for leg in (0, 1)]
        if all(some):
            distance[form] = max(min(costs[leg][k] for k in some[leg]) for leg in (0, 1))
    while distance:
        nearest = min(distance.values())
        # They are in the order of preference.
        form = next(one for one, far in distance.items() if far <= nearest + TOLERANCES.branch_tie)
        del distance[form]
        yield form


def _nearest_first(
    leg: LegGeometry, costs: Floats, numbers: Sequence[int], like: int | None = None
) -> Iterator[int]:
    """Branches by distance; of equally near ones ``like``, then those with the knee forward."""
    shapes = SHAPES[leg.heelwards]
    left = sorted(numbers, key=lambda k: (k != like, shapes[k], k))
    while left:
        nearest = min(costs[k] for k in left)
        taken = next(k for k in left if costs[k] <= nearest + TOLERANCES.branch_tie)
        left.remove(taken)
        yield taken


def _first_distance(solutions: LegSolutions) -> Floats:
    """Largest angle of each branch at the first pose of a stack [rad], ``(8,)``."""
    angles = solutions.angles
    first = angles if angles.ndim == 2 or not len(angles) else angles[0]
    far = np.abs(first).max(axis=-1).reshape(-1, 8)
    return np.asarray(np.nan_to_num(far.max(axis=0, initial=0.0), nan=np.inf))


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
        found = follow_branch(
            leg, len(target), lambda part: entries[:, part].copy(), reference, only
        )
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

    Returns:
        Angles [rad], shape ``(count, 6)``; None if no branch is valid throughout.
    """
    costs = distances(leg, matrices, reference)
    for k in _nearest_first(leg, costs, only):
        if (theta := _along(leg, count, matrices, reference, k)) is not None:
            return theta
    return None


def distances(leg: LegGeometry, matrices: Entries, reference: np.ndarray | None) -> Floats:
    """Largest difference of each branch from a reference at the first sample [rad], ``(8,)``.

    Where a branch doesn't reach the knee counts as straight or folded.
    """
    start, entries = np.zeros(6) if reference is None else reference, matrices(slice(0, 1))
    pose = np.vstack([entries[:12].reshape(3, 4), [[0.0, 0.0, 0.0, 1.0]]])
    if (found := one_pose.summands(leg, pose, True)) is not None:
        summands = np.array(found[:SUMMANDS])
    else:
        summands = ClosedForm(leg, entries, _free(leg, reference)).summands()[0][:, 0]
    summands[GONE] = 0.0
    theta = sum_angles(leg.sums, summands[None]).reshape(8, 6)
    return np.asarray(np.abs(wrap(theta - start)).max(axis=1))


def _along(
    leg: LegGeometry, count: int, matrices: Entries, reference: np.ndarray | None, number: int
) -> np.ndarray | None:
    """Angles along a motion on one branch ``(count, 6)``; None if it isn't valid throughout."""
    free = _free(leg, reference)
    lower, upper = (
        (limit + sign * TOLERANCES.joint_limit)[:, None]
        for limit, sign in ((leg.lower, -1), (leg.upper, 1))
    )
    theta = np.empty((count, 6))
    for part in blocks(count):
        gamma, excess = ClosedForm(leg, matrices(part), free).branch(number)
        angles = wrap(gamma - leg.beta[:, None])
        angles = fitted(angles, leg.lower[:, None], leg.upper[:, None])
        if not (
            np.all(excess <= TOLERANCES.reach)
            and (angles >= lower).all()
            and (angles <= upper).all()
        ):
            return None
        theta[part] = angles.T
    return theta


def _free(leg: LegGeometry, reference: np.ndarray | None) -> Free:
    return free_values(leg, None if reference is None else reference + leg.beta)
