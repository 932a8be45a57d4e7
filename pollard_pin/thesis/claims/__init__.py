"""Statements of the thesis that no single identity decides."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from pollard_pin.thesis.claims import angles, dynamics, path, robot
from pollard_pin.thesis.references import References
from thesis_pin.audit.verdicts import ClaimResult, Claims
from thesis_pin.equations.catalogue import Catalogue, Equation


def claims(catalogue: Catalogue, closed: References) -> Claims:
    """All checks by name: the kind of check, ":", and what it is about."""
    kinds = {**angles.CHECKS, **robot.CHECKS, **path.CHECKS, **dynamics.CHECKS}
    return {
        equation.claim: _apart(partial(kinds[equation.claim.split(":")[0]], catalogue), closed)
        for equation in catalogue.equations
        if equation.claim
    }


def _apart(
    check: Callable[[Equation, References], ClaimResult], closed: References
) -> Callable[[Equation], ClaimResult]:
    """A check that reads no more of its equation than it used to."""

    def read(equation: Equation) -> ClaimResult:
        tuple(equation.printed)
        return check(equation, closed)

    return read
