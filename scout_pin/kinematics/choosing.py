"""Which branch a leg takes where several reach: what is asked for, else one shape for both legs.

The rule, where no reference says what to be near: both legs stand alike, knees one way and
hips one way, in the shape whose farther leg is nearest to the neutral pose; where two
are equally near, knees bend forward. Only where no shape serves both legs does each leg
take its own nearest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from scout_pin.kinematics.branches import Legs, Numbers, members, mirrored
from scout_pin.kinematics.following import (
    Entries,
    Floats,
    along_branch,
    choose_branch,
    distances,
    nearest_first,
)
from scout_pin.kinematics.inverse import every_branch
from scout_pin.kinematics.solutions import LegSolutions
from scout_pin.specification import SIDES
from thesis_pin.tolerances import TOLERANCES


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
            return lambda part: columns[number][:, part]

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
    *,
    checked: bool = True,
) -> list[np.ndarray | None]:
    """Angles of both legs along a motion, ``(count, 6)`` each; None without a branch throughout.

    Args:
        legs: Left and right leg.
        counts: Number of samples of each, at least 1.
        entries: Placements of each sole.
        allowed: Numbers of the branches each leg may take.
        checked: Whether the placements are known to be rigid.

    Raises:
        BadInput: A placement isn't rigid.
    """
    costs = [distances(leg, one, None) for leg, one in zip(legs, entries, strict=True)]
    tried: dict[tuple[int, int], np.ndarray | None] = {}

    def keeps(leg: int, k: int) -> bool:
        if (leg, k) not in tried:
            unchecked = None if checked else f"{SIDES[leg]} foot"
            tried[leg, k] = along_branch(legs[leg], counts[leg], entries[leg], None, k, unchecked)
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
        for one in nearest_first(legs[0], costs[0], members(legs[0], form, allowed[0])):
            if not keeps(0, one):
                continue
            right = members(legs[1], form, allowed[1])
            like = mirrored(legs, one)
            for other in nearest_first(legs[1], costs[1], right, like):
                if keeps(1, other):
                    return one, other
            break  # the left leg's other branch of this shape doesn't help the right one
    alone: list[int | None] = []
    for leg in (0, 1):
        nearest = nearest_first(legs[leg], costs[leg], allowed[leg])
        alone.append(next((k for k in nearest if keeps(leg, k)), None))
    return alone[0], alone[1]


def _shapes(legs: Legs, costs: Sequence[Floats], allowed: tuple[Numbers, Numbers]) -> Iterator[int]:
    """Shapes both legs may have, the nearest first; of equally near ones, knees forward."""
    distance: dict[int, float] = {}
    left, right = (near.tolist() for near in costs)
    for form in range(4):
        some = members(legs[0], form, allowed[0])
        others = members(legs[1], form, allowed[1])
        if some and others:
            distance[form] = max(
                min(map(left.__getitem__, some)), min(map(right.__getitem__, others))
            )
    while distance:
        nearest = min(distance.values())
        # They are in the order of preference.
        form = next(one for one, far in distance.items() if far <= nearest + TOLERANCES.branch_tie)
        del distance[form]
        yield form


def _first_distance(solutions: LegSolutions) -> Floats:
    """Largest angle of each branch at the first pose of a stack [rad], ``(8,)``."""
    angles = solutions.angles
    first = angles if angles.ndim == 2 or not len(angles) else angles[0]
    far = np.abs(first).max(axis=-1).reshape(-1, 8)
    return np.asarray(np.nan_to_num(far.max(axis=0, initial=0.0), nan=np.inf))
