"""What no robot of this kind is made of: as a rule, a unit mistaken for another."""

from __future__ import annotations

import numpy as np

from pollard_pin.specification import JOINT_NAMES, LINK_NAMES, Specification
from thesis_pin.model.mechanism.plausible import odd_body, odd_ranges, odd_weight


def implausible(specification: Specification) -> list[str]:
    """Whole sentences; empty if nothing is odd."""
    spec = specification
    found: list[str] = []
    reach = abs(spec.chain_0.z_10) + sum(spec.span(name) for name in LINK_NAMES[:5])
    for name in LINK_NAMES:
        mass, tensor = spec.links[name].mass, spec.centroidal(name)
        found += odd_body(name, mass, spec.com(name), tensor, spec.span(name), reach)
    limits = np.transpose(spec.assumptions.joint_limits.radians()).tolist()
    found += odd_ranges(dict(zip(JOINT_NAMES, map(tuple, limits), strict=True)))
    torque = float(spec.assumptions.joint_limits.of_motors()[0].max())
    return [*found, *odd_weight(spec.mass, reach, torque)]
