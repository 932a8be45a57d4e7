"""Swings, touching links, jumps of rates and landings of a gait, JSON-ready; times in seconds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from scout_pin.dynamics.impact import Impact
from scout_pin.motion.collisions import Collisions, Touch
from scout_pin.motion.swings import Swing

if TYPE_CHECKING:  # it brings smoothing, which exact gaits don't need
    from scout_pin.motion.jumps import RateJump


def swing(one: Swing, unit: float) -> dict[str, object]:
    """A swing; ``unit`` is the seconds in the gait's unit of t, here and below."""
    return {
        "foot": one.side,
        "start": one.start * unit,
        "end": one.end * unit,
        "clearance": one.clearance,
        "way": one.way,
        "scraped": one.scraped,
        "scrapes": one.scrapes,
    }


def collisions(found: Collisions, time: np.ndarray) -> dict[str, object]:
    """Which links touch, and which pairs weren't looked at.

    Args:
        found: The links.
        time: Sample times [s], shape ``(n,)``.
    """

    def touching(pairs: tuple[Touch, ...]) -> list[dict[str, object]]:
        return [{"links": list(one.links), "time": float(time[one.sample])} for one in pairs]

    return {
        "judged": list(found.judged),
        "touching": touching(found.touching),
        "drawn_touching": touching(found.drawn),
        "left_out": {
            "neighbours": [list(pair) for pair in found.neighbours],
            "touching_in_neutral": [list(pair) for pair in found.neutral],
        },
    }


def rate_jump(one: RateJump, unit: float) -> dict[str, object]:
    """A jump of a planned rate."""
    return {"time": one.t * unit, "body": one.body, "what": one.coordinate, "size": one.size}


def impact(one: Impact, unit: float) -> dict[str, object]:
    """A landing."""
    return {
        "time": one.t * unit,
        "foot": one.side,
        "held": list(one.held),
        "foot_velocity": one.foot_velocity,
        "impulse": one.impulse,
        "velocity_jump": one.velocity_jump,
        "energy_lost": one.energy_lost,
        "admissible": one.admissible,
    }
