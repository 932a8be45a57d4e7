"""How the legs of a gait stand: the branches taken, why these, and what else would do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from scout_pin.kinematics.branches import (
    BRANCHES,
    KNEES,
    SHAPES,
    branch_label,
    knee,
    members,
    taken_branches,
)
from scout_pin.kinematics.following import distances, follow_branch
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait, GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.numeric.arrays import thinned
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory
from thesis_pin.report.branches import label
from thesis_pin.tolerances import TOLERANCES

_TRIED = 201
"""Samples on which it is found out whether the legs could stand otherwise."""


@dataclass(frozen=True)
class Stance:
    """Which branches a gait's legs are on.

    Attributes:
        labels: Branch of each leg, left then right; several, if it changes, in order.
        knees: The way each knee bends at the first sample.
        chosen: Who chose: ``asked``, ``gait``, ``angles`` (those the gait was made from),
            ``specification`` or ``nearest``, where nobody said and the shape nearest to the
            neutral pose was taken.
        others: Ways both legs could stand throughout all the same, as words for
            ``branch``.
        tied: Whether one of the others is as near to the neutral pose.
    """

    labels: tuple[str, str]
    knees: tuple[str, str]
    chosen: str
    others: tuple[str, ...]
    tied: bool

    def sentence(self) -> str:
        """The choice in words."""
        left, right = self.labels
        if self.knees[0] == self.knees[1]:
            text = f"Knees bend {self.knees[0]} (left {left}, right {right})"
        else:
            text = (
                f"The left knee bends {self.knees[0]} ({left}), the right one {self.knees[1]} "
                f"({right})"
            )
        why = {
            "asked": "as asked for",
            "gait": "as the gait says",
            "specification": "as the specification says",
            "angles": "as the gait's joint angles say",
            "nearest": "nearest to the neutral pose",
        }[self.chosen]
        if self.tied:
            why = (
                f"the default, for {' or '.join(self.others)} is as near to the neutral pose and "
                "nothing says which"
            )
        text += f": {why}."
        if self.others and self.chosen == "nearest":
            other = self.others[0]
            word = f'knee = "{other}" in specification or gait, or ' if other in KNEES else ""
            text += f" Possible too: {', '.join(self.others)} ({word}--branch={other})."
        return text


def branch_asked(
    robot: Scout, gait: Gait, branch: str | Sequence[str] | None
) -> str | Sequence[str] | None:
    """What is asked for: by an argument, else by the gait, else by the specification.

    Joint angles that a gait was made from leave nothing to ask for.
    """
    of_robot = robot.specification.branch_asked if gait.reference is None else None
    return next((one for one in (branch, gait.branch, of_robot) if one is not None), None)


def stance(
    robot: Scout, gait: Gait, motion: GaitMotion, joints: JointTrajectory, asked: str | None
) -> Stance:
    """Find out how the legs of a gait stand.

    Args:
        robot: The biped.
        gait: The gait.
        motion: Its samples.
        joints: Their joint angles.
        asked: The branch that was asked for, from whoever; None left it open.
    """
    some = thinned(motion.t, _TRIED)
    angles = joints.q[some]
    taken = [
        taken_branches(robot.legs[side], angles[:, 6 * leg : 6 * leg + 6])
        for leg, side in enumerate(SIDES)
    ]
    names = [[label(BRANCHES[k]) for k in dict.fromkeys(one.tolist())] for one in taken]
    legs = robot.legs["left"], robot.legs["right"]
    first = [int(one[0]) for one in taken]
    chosen = "asked"
    if asked is None:
        chosen = "nearest" if gait.reference is None else "angles"
    elif gait.branch is not None and asked == branch_label(gait.branch):
        chosen = "gait"
    elif asked == branch_label(robot.specification.branch_asked):
        chosen = "specification"
    others, tied = ((), False) if chosen != "nearest" else _others(robot, motion.part(some), first)
    return Stance(
        (" ".join(names[0]), " ".join(names[1])),
        (knee(legs[0], first[0]), knee(legs[1], first[1])),
        chosen,
        others,
        tied,
    )


def _others(robot: Scout, motion: GaitMotion, first: list[int]) -> tuple[tuple[str, ...], bool]:
    """Other ways both legs could stand throughout, and whether one is as near to neutral."""
    legs = robot.legs["left"], robot.legs["right"]
    entries = [partial(_entries, motion, foot) for foot in (motion.left_foot, motion.right_foot)]
    far = [distances(leg, of, None) for leg, of in zip(legs, entries, strict=True)]
    mine = max(far[leg][first[leg]] for leg in (0, 1))
    forms = {SHAPES[leg.heelwards][k] for leg, k in zip(legs, first, strict=True)}
    found, tied = [], False
    for form in range(4):
        if forms == {form}:
            continue
        both = [members(leg, form) for leg in legs]
        if any(
            follow_branch(leg, len(motion.t), of, None, some) is None
            for leg, of, some in zip(legs, entries, both, strict=True)
        ):
            continue
        way = KNEES[form // 2]
        word = way if way not in [KNEES[one // 2] for one in forms] else _labels(far, both)
        found.append(word)
        nearest = max(far[leg][list(both[leg])].min() for leg in (0, 1))
        tied = tied or bool(nearest <= mine + TOLERANCES.branch_tie)
    return tuple(dict.fromkeys(found)), tied


def _labels(far: list[np.ndarray], both: list[tuple[int, ...]]) -> str:
    """The nearest branches of a shape as labels, left then right."""
    nearest = [min(some, key=lambda k: float(far[leg][k])) for leg, some in enumerate(both)]
    return ",".join(label(BRANCHES[k]) for k in nearest)


def _entries(motion: GaitMotion, foot: BodyMotion, part: slice) -> np.ndarray:
    return foot.part(part).entries_in(motion.torso.part(part))
