"""What no biped of this kind is made of: as a rule, a unit mistaken for another."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from scout_pin.kinematics.neutral import tilts
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from thesis_pin.model.mechanism.plausible import odd_body, odd_ranges, odd_weight
from thesis_pin.tolerances import TOLERANCES


def implausible(specification: Specification) -> list[str]:
    """Whole sentences; empty if nothing is odd."""
    spec = specification
    reach = max(_reach(spec, side) for side in SIDES)
    found = [said for name in spec.servos for said in spec.actuator(name).odd()]
    for name, link in spec.links.items():
        tensor = link.centroidal(spec.inertia_convention, "physical")
        found += odd_body(name, link.mass, np.array(link.com), tensor, spec.span(name), reach)
    limits = np.transpose(spec.assumptions.joint_range.radians()).tolist()
    found += odd_ranges(dict(zip(JOINT_NAMES, map(tuple, limits), strict=True)))
    found += odd_weight(spec.mass, reach, float(spec.servo_limits()[0].max()))
    return [*found, *_soles(spec), *_likeness(spec), *_tilted(spec)]


def _reach(spec: Specification, side: str) -> float:
    leg = spec.leg(side)
    return leg.x_0 + leg.z_1 + leg.x_2 + leg.x_3 + leg.x_4 + leg.x_5 + leg.y_6


def _soles(spec: Specification) -> Iterator[str]:
    """Soles that are larger than a leg, or points."""
    reach = min(_reach(spec, side) for side in SIDES)
    for side in SIDES:
        corners = np.array(spec.leg(side).sole)
        size, far = float(np.ptp(corners, axis=0).max()), float(np.abs(corners).max())
        if not reach / TOLERANCES.slender < size < 2.0 * reach or far > 2.0 * reach:
            yield (
                f"{side} sole: it is {size:.3g} m long and reaches {far:.3g} m from its origin, "
                f"under a leg of {reach:.3g} m. Are its corners in metres?"
            )


def _likeness(spec: Specification) -> Iterator[str]:
    """Lengths of one leg that the other leg as a whole doesn't have."""
    for name in ("x_0", "z_1", "x_2", "x_3", "x_4", "x_5", "y_6"):
        left, right = (float(getattr(spec.leg(side), name)) for side in SIDES)
        if max(left, right) > _reach(spec, "left" if left < right else "right"):
            yield f"{name}: {left:g} m on the left and {right:g} m on the right. Both in metres?"


def _tilted(spec: Specification) -> Iterator[str]:
    for tilt in tilts(spec):
        said = tilt.sentence(np.radians(spec.leg(tilt.side).beta_deg))
        yield (
            f'{said[0].upper()}{said[1:]}. If it is meant, write neutral_soles = "tilted" at the '
            "specification's top."
        )
