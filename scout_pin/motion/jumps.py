"""Planned rates that change in an instant."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class RateJump:
    """A planned rate that changes in an instant: it would take an infinite force.

    Attributes:
        t: Time in the gait's unit.
        body: One of :data:`scout_pin.motion.gait.BODIES`.
        coordinate: One of :data:`scout_pin.coordinates.POSE_NAMES`.
        size: Jump [m/s] or [rad/s].
    """

    t: float
    body: str
    coordinate: str
    size: float
