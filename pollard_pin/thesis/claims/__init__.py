"""Statements of the thesis that no single identity decides."""

from __future__ import annotations

from functools import partial

from pollard_pin.thesis.claims import angles, dynamics, path, robot
from pollard_pin.thesis.references import References
from thesis_pin.audit.verdicts import Claims
from thesis_pin.equations.catalogue import Catalogue


def claims(catalogue: Catalogue, closed: References) -> Claims:
    """All checks by name: the kind of check, ":", and what it is about."""
    kinds = {**angles.CHECKS, **robot.CHECKS, **path.CHECKS, **dynamics.CHECKS}
    return {
        equation.claim: partial(kinds[equation.claim.split(":")[0]], catalogue, equation, closed)
        for equation in catalogue.equations
        if equation.claim
    }
