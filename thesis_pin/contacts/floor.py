"""The floor: a plane at some height and slope."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.numeric.checks import real

Array = NDArray[np.float64]

STEEPEST = np.radians(89.0)
"""Slope beyond which a plane is a wall [rad]."""


@dataclass(frozen=True)
class Floor:
    """A plane through (0, 0, height) of the world.

    Attributes:
        height: Its height at the world's origin [m].
        slope: Angle to the horizontal [rad].
        uphill: Heading in which it rises, from the world's x axis towards y [rad].
    """

    height: float = 0.0
    slope: float = 0.0
    uphill: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no floor.

        Raises:
            BadInput: A number isn't finite, or the slope isn't that of a floor.
        """
        real("floor height", self.height, unit="m")
        real("floor slope", self.slope, low=0.0, high=float(STEEPEST), unit="rad")
        real("floor heading", self.uphill, unit="rad")

    @property
    def normal(self) -> Array:
        """Unit vector out of the floor, world axes, shape ``(3,)``."""
        sine, cosine = np.sin(self.slope), np.cos(self.slope)
        return np.array([-sine * np.cos(self.uphill), -sine * np.sin(self.uphill), cosine])

    @property
    def axes(self) -> Array:
        """Two axes along the floor, then its normal, as columns in the world, ``(3, 3)``.

        The first lies above the world's x axis, so that a level floor has the world's axes.
        """
        normal = self.normal
        first = np.array([normal[2], 0.0, -normal[0]])
        first /= np.linalg.norm(first)
        return np.column_stack([first, np.cross(normal, first), normal])

    @property
    def origin(self) -> Array:
        """The point of the floor on the world's z axis [m], shape ``(3,)``."""
        return np.array([0.0, 0.0, self.height])

    def above(self, points: Array) -> Array:
        """Distance of points ``(..., 3)`` from the floor [m], negative below it."""
        return np.asarray((points - self.origin) @ self.normal)

    def flat(self, points: Array) -> Array:
        """Points ``(..., 3)`` in the floor's own two axes, from its origin [m], ``(..., 2)``."""
        return np.asarray((points - self.origin) @ self.axes[:, :2])


def raised(floor: Floor, way: float) -> Floor:
    """A floor moved along its normal [m]."""
    return replace(floor, height=floor.height + way / float(floor.normal[2]))
