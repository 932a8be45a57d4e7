"""Checks of what no identity can decide: angles given by arctangents.

Source: Pollard thesis, (2.10), (2.19), (2.23), (2.34), (2.39), (2.47), (2.97),
(2.103), (2.105), (2.114), (2.123), (2.131).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from pollard_pin.thesis.claims.given import Check
from pollard_pin.thesis.references import References
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation, index_values
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError
from thesis_pin.numeric.arrays import wrap


def _angle(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """θ = arctan(a/b): the angle itself, and what two arguments can give."""
    try:
        gaps = np.concatenate(
            [_gaps(catalogue, equation.left, member, closed, "+") for member in equation.printed]
        )
        residual = _either(catalogue, equation.left, tuple(equation.printed), closed)
        share = float((np.abs(gaps) > 1e-6).mean())
        found = f"a plain arctan is half a turn off at {share:.0%} of the states"
        if np.abs(np.sin(gaps)).max() > 1e-9:
            found = "the tangent itself is wrong, and a plain arctan keeps only half the circle"
    except FormulaError as error:
        residual, found = np.inf, error.what
    members = equation.members("corrected")
    return ClaimResult(residual, _either(catalogue, equation.left, members, closed), found)


def _half_angle(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """θ = 2 arctan((B ± √…)/(A − C)): one of the two signs gives the angle."""
    residual = _either(catalogue, equation.left, tuple(equation.printed), closed)
    return ClaimResult(residual, note="one of the two signs at every state")


def _either(catalogue: Catalogue, left: str, members: Sequence[str], closed: References) -> float:
    """Largest difference of an angle from the nearer of what both signs of ± give."""
    worst = []
    for member in members:
        gaps = [np.abs(_gaps(catalogue, left, member, closed, sign)) for sign in "+-"]
        worst.append(np.minimum(*gaps).max())
    return float(np.max(worst))


def _gaps(
    catalogue: Catalogue, left: str, member: str, closed: References, sign: str
) -> np.ndarray:
    """Differences of an angle and a formula [rad], within half a turn."""
    sides = catalogue.parse(left), catalogue.parse(member)
    values = []
    for indices in index_values(*sides):
        angle, other = (evaluate(side, closed, {**indices, "±": sign}).array for side in sides)
        values.append((angle - other).ravel())
    return np.asarray(wrap(np.concatenate(values)))


CHECKS: Mapping[str, Check] = {"angle": _angle, "half-angle": _half_angle}
"""Checks by the first part of a claim's name."""
