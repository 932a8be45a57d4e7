"""Statements of the thesis that no single identity decides."""

from __future__ import annotations

from scout_pin.thesis.claims import (
    angles,
    appendix_c,
    dynamics,
    gait,
    law,
    names,
    robot,
    soles,
    splines,
)
from thesis_pin.audit.judging.verdicts import Claims
from thesis_pin.equations.catalogue import Catalogue


def claims(catalogue: Catalogue, states: int) -> Claims:
    """All checks by name.

    Args:
        catalogue: The equations, whose printed numbers are read.
        states: Random states used for the law of motion.
    """
    rooms = (splines, appendix_c, gait, robot, soles, dynamics, names)
    found = law.claims(catalogue, states) | angles.claims()
    return found | {name: check for room in rooms for name, check in room.claims(catalogue).items()}
