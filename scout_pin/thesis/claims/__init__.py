"""Statements of the thesis that no single identity decides."""

from __future__ import annotations

from scout_pin.thesis.claims import dynamics, robot, tables
from thesis_pin.audit.verdicts import Claims
from thesis_pin.equations.catalogue import Catalogue


def claims(catalogue: Catalogue, states: int) -> Claims:
    """All checks by name.

    Args:
        catalogue: The equations, whose printed numbers are read.
        states: Random states used for the law of motion.
    """
    return tables.claims(catalogue) | robot.claims(catalogue) | dynamics.claims(states)
