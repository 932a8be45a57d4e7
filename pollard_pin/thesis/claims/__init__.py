"""Statements of the thesis that no single identity decides.

Each check evaluates what its equation says, left side and members; what stands in
their place is held to the same.
"""

from __future__ import annotations

from functools import partial

from pollard_pin.thesis.claims import angles, dynamics, general, inertia, names, path, robot
from pollard_pin.thesis.references import References
from thesis_pin.audit.judging.verdicts import Claims
from thesis_pin.equations.catalogue import Catalogue

CHECKS = (angles, robot, inertia, path, dynamics, general, names)


def claims(catalogue: Catalogue, closed: References) -> Claims:
    """All checks by name: the kind of check, ":", and what it is about."""
    kinds = {kind: check for module in CHECKS for kind, check in module.CHECKS.items()}
    names = {equation.claim for equation in catalogue.equations if equation.claim}
    return {name: partial(kinds[name.split(":")[0]], catalogue, closed) for name in names}
