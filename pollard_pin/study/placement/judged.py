"""What a path asks for from many places, or why it can't be followed from there: as data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from pollard_pin.kinematics.geometry import Geometry
from pollard_pin.kinematics.screws import Posture

Array = NDArray[np.float64]

REASONS = (
    "can be followed",
    "out of reach",
    "a joint leaves its limits",
    "crosses or touches a singularity of the inverse kinematics",
    "crosses a singularity of the actuation",
    "the arms of chains 1 and 2 cross",
    "the condition number exceeds what is allowed",
    "a motor's torque exceeds its limit",
    "a motor's speed exceeds its limit",
    "the motors can't hold the robot at rest",
)
"""Why a path can't be followed from a placement; the first is that it can."""

FOLLOWED, OUT, LIMITS, SERIAL, ACTUATION, ARMS, CONDITION, TORQUE, SPEED, WEIGHT = range(
    len(REASONS)
)

NEAREST = (*Posture.SERIAL_NAMES, "the three base motors lose the tool")
"""Singular sets whose sines the clearance is the least of."""


@dataclass(frozen=True)
class Judged:
    """What a path asks from each of m placements; NaN where no joint motion follows it.

    Attributes:
        reason: Number in :data:`REASONS`, shape ``(m,)``.
        torque: Peak of each motor's torque [N·m], shape ``(m, 6)``.
        speed: Peak of its speed [rad/s], shape ``(m, 6)``.
        condition: Largest condition number of the six motors, shape ``(m,)``; NaN if it wasn't
            asked for.
        margin: Least reach margin, shape ``(m,)``.
        clearance: Least sine of the singular sets, 0 in one and 1 far from all, shape ``(m,)``.
        nearest: Which set that is, number in :data:`NEAREST`, shape ``(m,)``.
        pace: How many times as fast the motors' limits let it be played, shape ``(m,)``; 0 if
            they can't hold it at all, NaN if it wasn't asked for.
        crossed: Whether the arms of the side chains cross somewhere, seen from above, ``(m,)``.
    """

    reason: NDArray[np.intp]
    torque: Array
    speed: Array
    condition: Array
    margin: Array
    clearance: Array
    nearest: NDArray[np.intp]
    pace: Array
    crossed: NDArray[np.bool_]

    @classmethod
    def none(cls, count: int) -> Judged:
        """Nothing known of some placements yet."""
        torque, speed = np.full((2, count, 6), np.nan)
        condition, margin, clearance, pace = np.full((4, count), np.nan)
        reason, nearest = np.zeros((2, count), dtype=np.intp)
        crossed = np.zeros(count, dtype=bool)
        return cls(reason, torque, speed, condition, margin, clearance, nearest, pace, crossed)

    def put(self, where: NDArray[np.intp], other: Judged) -> None:
        """Write others' numbers."""
        for field in fields(self):
            getattr(self, field.name)[where] = getattr(other, field.name)

    @classmethod
    def joined(cls, parts: Sequence[Judged]) -> Judged:
        """One after the other."""
        return cls(
            **{
                field.name: np.concatenate([getattr(part, field.name) for part in parts])
                for field in fields(cls)
            }
        )


def arms_cross(geometry: Geometry, q: Array) -> NDArray[np.bool_]:
    """Whether the arms of chains 1 and 2 cross, seen from above; ``(..., 12)`` → ``(...)``."""
    base = np.stack([np.zeros(2), geometry.y_10], axis=-1)
    turn = q[..., [6, 9]]
    arm = geometry.x_43[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    apart = base[1] - base[0]

    def side(a: Array, b: Array) -> Array:
        return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])

    one, two = arm[..., 0, :], arm[..., 1, :]
    both = side(one, two)
    with np.errstate(divide="ignore", invalid="ignore"):
        along_one, along_two = side(apart, two) / both, side(apart, one) / both
    inside = [(along >= 0.0) & (along <= 1.0) for along in (along_one, along_two)]
    return np.asarray(inside[0] & inside[1])


def pace_within(
    torque: Array, weight: Array, speed: Array, effort: Array, velocity: Array
) -> Array:
    """How many times as fast motions can be played, shape ``(m,)``; 0 where nothing holds them.

    Played k times as fast, what isn't weight grows with k², and speeds with k.

    Args:
        torque: As it is played, shape ``(m, n, 6)``.
        weight: What it is at rest, same shape.
        speed: Of the motors, same shape.
        effort: Limits of torque, shape ``(6,)``.
        velocity: Limits of speed, shape ``(6,)``.
    """
    pull = torque - weight
    room = np.where(pull > 0, effort - weight, effort + weight)
    with np.errstate(divide="ignore", invalid="ignore"):
        square = np.where(pull == 0, np.inf, room / np.abs(pull))
        turning = np.where(speed == 0, np.inf, velocity / np.abs(speed))
    held = (np.abs(weight) <= effort).all(axis=(1, 2))
    fastest = np.minimum(np.sqrt(np.maximum(square, 0.0)), turning).min(axis=(1, 2))
    return np.where(held, fastest, 0.0)
