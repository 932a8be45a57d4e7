"""Statements of the thesis that no single identity decides."""

from __future__ import annotations

from scout_pin.thesis.claims import dynamics, robot, tables
from thesis_pin.audit.reading import apart_from_text
from thesis_pin.audit.verdicts import Claims
from thesis_pin.equations.catalogue import Catalogue


def claims(catalogue: Catalogue, states: int) -> Claims:
    """All checks by name.

    Args:
        catalogue: The equations, whose printed numbers are read.
        states: Random states used for the law of motion.
    """
    found = tables.claims(catalogue) | robot.claims(catalogue) | dynamics.claims(states)
    return {name: apart_from_text(check) for name, check in found.items()}
