"""When feet are on the floor, told from how high they are and how fast they move."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.stance import Stance
from thesis_pin.contacts.floor import Floor
from thesis_pin.tolerances import GRAVITY, TOLERANCES

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

HIGHER = 2.0
"""How many times higher and faster than where it lands a foot may be until it has left."""


def lowest_point(floor: Floor, places: Stance) -> float:
    """How high above the floor the lowest corner of any foot is in a whole motion [m]."""
    return min(float(floor.above(corners).min()) for corners in places.corners)


def detect(floor: Floor, places: Stance) -> Flags:
    """Which feet are on the floor at each sample, booleans ``(n, feet)``.

    A foot lands where its highest corner is lower than ``touch_height`` times the height of the
    centre of mass, and slower than ``touch_speed`` times the speed of a fall from there; it leaves
    where it is twice as high or as fast.

    Args:
        floor: The floor.
        places: Where the feet are, with speeds.
    """
    low, slow = touch_height(floor, places), touch_speed(floor, places)
    found = np.zeros(places.speed.shape, dtype=bool)
    for k, corners in enumerate(places.corners):
        height = floor.above(corners).max(axis=1) / low
        speed = places.speed[:, k] / slow
        use = np.maximum(np.abs(height), speed)
        found[:, k] = _with_hysteresis(use)
    return found


def touch_height(floor: Floor, places: Stance) -> float:
    """Height [m] below which a slow foot is on the floor."""
    return TOLERANCES.touch_height * _size(floor, places)


def touch_speed(floor: Floor, places: Stance) -> float:
    """Speed [m/s] below which a foot near the floor rests."""
    return TOLERANCES.touch_speed * float(np.sqrt(2 * GRAVITY * _size(floor, places)))


def _size(floor: Floor, places: Stance) -> float:
    """Height of the centre of mass [m]."""
    return max(float(np.median(floor.above(places.com))), TOLERANCES.touching)


def _with_hysteresis(use: Array) -> Flags:
    """True from where a number falls to 1 until it exceeds :data:`HIGHER`, both ways in time."""
    inside, outside = use <= 1.0, use > HIGHER
    number = np.cumsum(outside)  # samples between two that are outside belong together
    touched = np.zeros(number[-1] + 1, dtype=bool)
    touched[number[inside]] = True
    return np.asarray(touched[number] & ~outside)
