"""Sizes that nobody builds: as a rule, a unit mistaken for another, or a slipped decimal.

What can't be at all is refused by :mod:`thesis_pin.model.mechanism.inertia`; this is about what
could be and isn't, so callers warn.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from thesis_pin.tolerances import GRAVITY, TOLERANCES


def density(mass: float, tensor: np.ndarray) -> float:
    """Mean density that a body has at most [kg/m³], from its moments.

    Of all bodies of a volume, none has a smaller determinant of second moments than an
    ellipsoid, so the ellipsoid with the body's moments is at least as large as the body.

    Args:
        mass: [kg].
        tensor: About the centre of mass [kg·m²], shape ``(3, 3)``.
    """
    moments = np.linalg.eigvalsh(tensor)
    second = np.maximum(0.5 * moments.sum() - moments, 0.0) / mass
    axes = np.sqrt(5.0 * second)
    volume = 4.0 / 3.0 * np.pi * float(axes.prod())
    return mass / volume if volume > 0.0 else np.inf


def odd_body(
    name: str, mass: float, com: np.ndarray, tensor: np.ndarray, span: float, reach: float
) -> Iterator[str]:
    """What is odd about a body, a sentence each.

    Args:
        name: Its name.
        mass: [kg].
        com: Centre of mass in the joint's frame [m], shape ``(3,)``.
        tensor: About the centre of mass [kg·m²], shape ``(3, 3)``.
        span: From its joint to its far end [m].
        reach: Length of the robot's limbs [m].
    """
    most = TOLERANCES.density
    gyration = float(np.sqrt(np.linalg.eigvalsh(tensor)[-1] / mass))
    if (dense := density(mass, tensor)) > most:
        much = f"of {dense:.2g} kg/m³" if np.isfinite(dense) else "without end"
        yield (
            f"{name}: {mass:.3g} kg with moments of inertia this small have a density {much}, "
            f"and osmium has {most:,.0f} kg/m³. Are mass and inertia in kg and kg·m²?"
        )
    if gyration > reach:
        yield (
            f"{name}: its radius of gyration is {gyration:.3g} m in a robot whose limbs are "
            f"{reach:.3g} m long. Is its inertia in kg·m²?"
        )
    if span > TOLERANCES.slender * gyration:
        yield (
            f"{name}: it is {span:.3g} m long, and its mass lies within {gyration:.2g} m. Is its "
            "length in metres?"
        )
    if (far := float(np.linalg.norm(com))) > 2.0 * reach:
        yield (
            f"{name}: its centre of mass is {far:.3g} m from its joint, in a robot whose limbs are "
            f"{reach:.3g} m long. Is it in metres?"
        )


def odd_ranges(ranges: Mapping[str, tuple[float, float]]) -> Iterator[str]:
    """What is odd about joints' ranges [rad], lower and upper by the joint's name."""
    if ranges and all(high - low < TOLERANCES.narrow for low, high in ranges.values()):
        name, (low, high) = next(iter(ranges.items()))
        yield (
            f"{name}: no joint turns by more than {np.degrees(TOLERANCES.narrow):.0f}°; this one "
            f"from {np.degrees(low):.3g}° to {np.degrees(high):.3g}°. Are the ranges in degrees?"
        )


def odd_weight(mass: float, reach: float, torque: float) -> Iterator[str]:
    """What is odd about a robot's weight beside its strongest actuator.

    Args:
        mass: Of the robot [kg].
        reach: Length of its limbs [m].
        torque: Of its strongest actuator [N·m].
    """
    if (load := mass * GRAVITY * reach) > TOLERANCES.overload * torque:
        yield (
            f"{mass:.3g} kg on limbs of {reach:.3g} m make {load:.3g} N·m, and the strongest "
            f"actuator gives {torque:.3g} N·m. Are masses in kg, lengths in m, torques in N·m?"
        )
