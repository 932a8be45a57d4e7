"""States whose accelerations follow from generalized forces that a derivation gives."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from thesis_pin.audit.derivation.moving.states import States
from thesis_pin.equations.values import STEP
from thesis_pin.errors import ModelError

Law = Callable[[States], np.ndarray]
"""States → generalized forces of some coordinates [N], [N·m], shape ``(N, k)``."""


def unforced(count: int) -> Law:
    """The law of so many coordinates that nothing pushes."""
    return lambda states: np.zeros((len(states.x), count))


def driven(states: States, numbers: Sequence[int], law: Law) -> States:
    """The same states with accelerations that the forces of some coordinates bring about.

    Args:
        states: The states; the accelerations of all other coordinates are kept.
        numbers: The coordinates whose forces are given, from 0.
        law: Their forces. They can't depend on accelerations.

    Raises:
        ModelError: The coordinates move no mass.
    """
    found = replace(states, a=_following(states, numbers, law))
    later = _following(found.imaginary(None, 0), numbers, law)
    jerk = found.jerk.copy()
    jerk[:, list(numbers)] = later[:, list(numbers)].imag / STEP
    return replace(found, jerk=jerk)


def _following(states: States, numbers: Sequence[int], law: Law) -> np.ndarray:
    """Accelerations of all coordinates, shape ``(N, n)``."""
    chosen = list(numbers)
    joints = states.coordinates.joint_rates
    a = states.a.astype(np.result_type(states.x, states.a))
    a[:, chosen] = 0.0
    held = replace(states, a=a)
    mass = (joints.T @ held.motion.mass_matrix() @ joints)[:, chosen][..., chosen]
    lacking = law(held) - (held.motion.force() @ joints)[:, chosen]
    try:
        a[:, chosen] = np.linalg.solve(mass, lacking[..., None])[..., 0]
    except np.linalg.LinAlgError:
        listed = ", ".join(states.coordinates.symbols[k] for k in chosen)
        raise ModelError(
            f"no acceleration of {listed} follows from its force: it moves no mass",
            remedy="Give the links behind it a mass, or leave it out of [forces]",
        ) from None
    return a
