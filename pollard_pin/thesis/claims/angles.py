"""Checks of what no identity can decide: angles given by arctangents.

Source: Pollard thesis, (2.10), (2.19), (2.23), (2.34), (2.39), (2.47), (2.97),
(2.103), (2.105), (2.114), (2.123), (2.131).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from pollard_pin.thesis.claims.robot import Check
from pollard_pin.thesis.references import References
from thesis_pin.audit.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation, index_values
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError
from thesis_pin.numeric.arrays import wrap


def _angle(catalogue: Catalogue, equation: Equation, closed: References) -> ClaimResult:
    """θ = arctan(a/b): the angle itself, and what two arguments can give.

    With both signs known the angle is right up to the half turn that a branch
    chooses; that is the residual of the correction.
    """
    try:
        printed = _gaps(catalogue, equation.left, equation.printed[-1], closed)
        residual = float(np.abs(wrap(printed)).max())
        share = float((np.abs(wrap(printed)) > 1e-6).mean())
        found = f"a plain arctan is half a turn off at {share:.0%} of the states"
        if np.abs(np.sin(printed)).max() > 1e-9:
            found = "the tangent itself is wrong, and a plain arctan keeps only half the circle"
    except FormulaError as error:
        residual, found = np.inf, error.what
    mended = _gaps(catalogue, equation.left, equation.members("corrected")[-1], closed)
    return ClaimResult(residual, float(np.abs(np.sin(mended)).max()), found)


def _gaps(catalogue: Catalogue, left: str, member: str, closed: References) -> np.ndarray:
    sides = catalogue.parse(left), catalogue.parse(member)
    values = []
    for indices in index_values(*sides):
        angle, other = (evaluate(side, closed, indices).array for side in sides)
        values.append((angle - other).ravel())
    return np.concatenate(values)


def _half_angle(catalogue: Catalogue, equation: Equation, closed: References) -> ClaimResult:
    """θ = 2 arctan((B ± √…)/(A − C)): one of the two signs gives the angle."""
    sides = catalogue.parse(equation.left), catalogue.parse(equation.printed[-1])
    worst = []
    for indices in index_values(*sides):
        gaps = []
        for sign in "+-":
            angle, other = (evaluate(s, closed, {**indices, "±": sign}).array for s in sides)
            gaps.append(np.abs(wrap(angle - other)))
        worst.append(np.minimum(*gaps).max())
    return ClaimResult(float(np.max(worst)), note="one of the two signs at every state")


CHECKS: Mapping[str, Check] = {"angle": _angle, "half-angle": _half_angle}
"""Checks by the first part of a claim's name."""
