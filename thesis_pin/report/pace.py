"""Motions so slow that their time must be doubted: milliseconds read as seconds."""

from __future__ import annotations

import numpy as np

from thesis_pin.tolerances import TOLERANCES

_FEWEST, _MOST = 1e-2, 1e3
"""Largest acceleration that a robot's motion has, if its unit of time is right [m/s²], [rad/s²]."""


def doubts(duration: float, travel: float, acceleration: float, unit: str = "m") -> list[str]:
    """A warning where a motion moves, and inertia plays no part in it.

    Args:
        duration: How long it lasts [s].
        travel: How far anything moves [m] or [rad].
        acceleration: Largest size of an acceleration [m/s²] or [rad/s²].
        unit: Unit of the travel.
    """
    if travel < TOLERANCES.moves or not 0 < acceleration < TOLERANCES.inertia_unfelt:
        return []
    said = (
        f"the motion lasts {duration:.6g} s and accelerates by at most {acceleration:.1e} "
        f"{unit}/s²: it is so slow that inertia plays no part in it"
    )
    for word, name, factor in (("milliseconds", "t_ms", 1e6), ("microseconds", "t_us", 1e12)):
        if _FEWEST <= acceleration * factor <= _MOST:
            return [f"{said}. Is its time in {word}? Such a column is called {name}"]
    return [said]


def largest(*values: np.ndarray) -> float:
    """Largest length of some stacks of vectors ``(n, 3)``."""
    return max(float(np.linalg.norm(one, axis=-1).max(initial=0.0)) for one in values)
