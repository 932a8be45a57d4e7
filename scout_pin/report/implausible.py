"""What no biped of this kind is made of: as a rule, a unit mistaken for another."""

from __future__ import annotations

from scout_pin.specification import Specification


def implausible(specification: Specification) -> list[str]:
    """Whole sentences; empty if nothing is odd."""
    return [said for name in specification.servos for said in specification.actuator(name).odd()]
