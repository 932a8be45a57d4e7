"""Branches of a leg by name: three signs, or the way its knee bends.

S_E turns the direction of e, and with it the sign of every angle about e, but no link:
a leg's shape is S_2 and the product S_E S_K, the way the knee bends. Which labels are
mirror images of each other depends on how the two legs' angles are counted.

Source: Scout thesis, 3.1, the loop equation (3.4).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scout_pin.kinematics.forward import leg_frames
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.signs import BRANCHES as BRANCHES
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown
from thesis_pin.report.branches import label
from thesis_pin.tolerances import TOLERANCES

KNEES = ("forward", "backward")
"""Ways a knee bends: towards the toes, which is the sole's y, or away from them."""

Legs = tuple[LegGeometry, LegGeometry]
Numbers = tuple[int, ...]

LABELS = {label(signs): k for k, signs in enumerate(BRANCHES)}
"""Number of a branch by its signs, as ``"+-+"``."""

EVERY: Numbers = tuple(range(len(BRANCHES)))

SHAPES: dict[bool, Numbers] = {
    heelwards: tuple(
        2 * ((axis * bend > 0) != heelwards) + (two < 0) for axis, two, bend in BRANCHES
    )
    for heelwards in (True, False)
}
"""How a leg stands on each branch, however its angles are counted, by ``heelwards`` of its
geometry: 0 and 1 with the knee forward, 2 and 3 backward, even ones with sin γ2 > 0."""

_MEMBERS = {
    heelwards: tuple(tuple(k for k in EVERY if shapes[k] == form) for form in range(4))
    for heelwards, shapes in SHAPES.items()
}


def branch_words(branch: str | Sequence[str] | None) -> tuple[str | None, str | None]:
    """What each leg is asked for, left then right: a label, a way of the knee, or None.

    Args:
        branch: One word for both legs, as ``"+-+"`` or ``"forward"``; or one a leg, left
            then right, as ``("+++", "-+-")`` or ``"forward,backward"``.

    Raises:
        BadInput: It is none of these.
    """
    if branch is None:
        return None, None
    words = branch.split(",") if isinstance(branch, str) else branch
    known = isinstance(words, list | tuple) and all(isinstance(one, str) for one in words)
    if not known or len(words) not in (1, 2) or not {*words} <= {*KNEES, *LABELS}:
        raise BadInput(
            f"branch is {shown(branch)}",
            allowed='three signs for both legs, as "+-+", or for each, as "+++,-+-"; '
            "or the way the knees bend: forward, backward",
            remedy="scout-pin ik lists the branches of a pose",
        )
    return words[0], words[-1]


def branch_label(branch: str | Sequence[str] | None) -> str | None:
    """What both legs are asked for in one string, as ``"+++,-+-"``; None if it is open."""
    words = [word for word in branch_words(branch) if word is not None]
    return ",".join(dict.fromkeys(words) if {*words} <= {*KNEES} else words) or None


def allowed_branches(legs: Legs, branch: str | Sequence[str] | None) -> tuple[Numbers, Numbers]:
    """Numbers of the branches each leg may take; all eight where it is left open.

    Args:
        legs: Left and right leg.
        branch: As for :func:`branch_words`.

    Raises:
        BadInput: There is no such branch, or the leg's knee has no forward.
    """
    left, right = (
        leg_branches(leg, word) for leg, word in zip(legs, branch_words(branch), strict=True)
    )
    return left, right


def leg_branches(leg: LegGeometry, word: str | None) -> Numbers:
    """Numbers of the branches one leg may take: of a label, a way of the knee, or None for all.

    Raises:
        BadInput: There is no such branch, or the leg's knee has no forward.
    """
    if word is None:
        return EVERY
    if not isinstance(word, str) or word not in (*KNEES, *LABELS):
        raise BadInput(
            f"branch is {shown(word)}",
            allowed='three signs, as "+-+"; or the way the knee bends: forward, backward',
            remedy="scout-pin ik lists the branches of a pose",
        )
    if word in LABELS:
        return (LABELS[word],)
    if abs(leg.forward_part) < TOLERANCES.singular:
        raise BadInput(
            f"the {leg.names[0].split('_')[0]} knee has no way {shown(word)}: the axis of "
            "ankle_roll lies across the foot",
            allowed="three signs, as +-+",
        )
    return tuple(k for k in EVERY if knee(leg, k) == word)


def knee(leg: LegGeometry, number: int) -> str:
    """Which way a branch bends the knee: towards the toes or away, one of :data:`KNEES`.

    The knee lies off the line from hip to ankle against S_E S_K a, seen along the axis a
    of joint 6, and the sole says whether a points to its toes or to its heel.
    """
    return KNEES[SHAPES[leg.heelwards][number] // 2]


def members(leg: LegGeometry, form: int, allowed: Numbers = EVERY) -> Numbers:
    """The branches, of some, on which a leg has one of the four shapes."""
    both = _MEMBERS[leg.heelwards][form]
    return both if allowed is EVERY else tuple(k for k in both if k in allowed)


def mirrored(legs: Legs, number: int) -> int:
    """The right leg's branch that is the mirror image of one of the left leg's.

    Where e, the axis of joint 3, is mirrored with the leg, (v × a) isn't and S_E changes,
    and S_K too, for the angles about e change their signs.
    """
    (x, y, z), (u, v, w) = (leg.neutral_axis for leg in legs)
    turned = -x * u + y * v + z * w > 0.0
    axis, two, bend = BRANCHES[number]
    return BRANCHES.index((-axis, two, -bend) if turned else (axis, two, bend))


def taken_branches(leg: LegGeometry, theta: np.ndarray) -> np.ndarray:
    """Numbers of the branches that joint angles lie on: ``(n, 6)`` → ``(n,)``."""
    frames = leg_frames(leg, theta)
    v = frames.points[4] - frames.points[1]
    gamma = theta + leg.beta
    signs = (
        np.einsum("in,in->n", np.cross(v, frames.axes[5], axis=0), frames.axes[2]) < 0.0,
        np.sin(gamma[:, 1]) < 0.0,
        np.sin(gamma[:, 3]) < 0.0,
    )
    return np.asarray(4 * signs[0] + 2 * signs[1] + signs[2])
