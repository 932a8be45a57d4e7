"""Checks of the robot's degrees of freedom and of the names of its moves.

Source: Pollard thesis, 2.1, 2.2.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping

import numpy as np

from pollard_pin.model import Pollard, load
from pollard_pin.specification import SKEWED_PATH
from pollard_pin.thesis.claims.given import Check, Given, names_in, thesis_robot, value_of
from pollard_pin.thesis.references import References
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError


def _moves(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """Which of T_z1 … T_z6 turn, and about which axis, by the matrices printed below."""
    found = []
    for name in names_in(catalogue, equation.left):
        (printed,) = catalogue[f"pollard:2.1:{name}"].printed
        matrix = evaluate(catalogue.parse(printed), closed, {}).array[0]
        turned = matrix[:3, :3] - np.eye(3)
        turns = bool(turned.any())
        axis = np.flatnonzero(~turned.any(axis=1) if turns else np.abs(matrix[:3, 3]))
        found.append(("R" if turns else "T") + "_" + "xyz"[int(axis[0])])
    # A name that isn't the one meant is no value that is off by so much.
    before, after = (
        0.0 if all(list(names_in(catalogue, text)) == found for text in members) else math.inf
        for members in (equation.printed, equation.members("corrected"))
    )
    return ClaimResult(before, after, f"the matrices are {', '.join(found)}")


def counts(robot: Pollard) -> dict[str, int]:
    """Links, joints and their freedoms, counted from the model as the thesis counts.

    Joints of the model without an offset between them are one joint: two revolute ones a
    universal joint, three the wrist. Each loop adds a ball joint.
    """
    offset = [np.linalg.norm(place.translation) for place in robot.model.jointPlacements[1:]]
    root = [parent == 0 for parent in list(robot.model.parents)[1:]]
    joints = sum(bool(far > 1e-9 or first) for far, first in zip(offset, root, strict=True))
    balls = robot.equations // 3
    return {
        "links": joints + 1,
        "joints": joints + balls,
        "freedoms": robot.model.nv + 3 * balls,
    }


_COUNTED = {"b": "links", "g": "joints", r"\sum_k f_k": "freedoms"}
"""The formula's letters: links with the base, joints, freedoms of all joints."""


def _count(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """A number of the model, counted by what stands on the left."""
    if equation.left not in _COUNTED:
        raise FormulaError(f"nothing called {equation.left} is counted")
    number = counts(thesis_robot())[_COUNTED[equation.left]]
    printed = [float(value_of(catalogue, text, Given())) for text in equation.printed]
    worst = max(abs(value - number) / number for value in printed)
    return ClaimResult(worst, note=f"counted: {number}")


@functools.cache
def freedoms() -> dict[str, set[int]]:
    """Degrees of freedom by rank of the loops' Jacobian, at 50 random poses of two robots."""
    generator, found = np.random.default_rng(22), {}
    for robot in (thesis_robot(), load(SKEWED_PATH)):
        poses = np.zeros((200, 6))
        poses[:, :3] = generator.uniform((0.3, -0.2, -0.2), (0.6, 0.2, 0.2), (200, 3))
        poses[:, 3:] = generator.uniform(-0.5, 0.5, (200, 3))
        solved = robot.inverse_kinematics(poses)
        some = solved.angles[solved.valid][:50]
        found[robot.specification.name] = {robot.mobility(q).freedom for q in some}
    return found


def _freedoms(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """The formula gives what the loops leave, robot by robot."""
    if equation.left != "L":
        raise FormulaError(f"the degrees of freedom are L, not {equation.left}")
    worst = 0.0
    for name, ranked in freedoms().items():
        counted = counts(thesis_robot() if name == "pollard" else load(SKEWED_PATH))
        given = Given(b=counted["links"], g=counted["joints"])
        for member in equation.printed:
            text = member.replace(r"\sum_k f_k", str(counted["freedoms"]))
            number = float(value_of(catalogue, text, given))
            worst = max(worst, *(abs(number - freedom) / freedom for freedom in ranked))
    return ClaimResult(worst, note="by rank of the loops at 50 random poses of each of two robots")


CHECKS: Mapping[str, Check] = {"moves": _moves, "count": _count, "freedoms": _freedoms}
"""Checks by the first part of a claim's name."""
