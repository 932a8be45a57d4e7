"""Values at samples with their derivatives by the torso's jet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Sloped:
    """Values of n samples, and how they change.

    Attributes:
        value: Shape ``(n, ...)``.
        slope: Shape ``(n, ..., 18)``; None if it wasn't asked for.
    """

    value: np.ndarray
    slope: np.ndarray | None

    def part(self, samples: np.ndarray | slice) -> Sloped:
        """Some samples."""
        return Sloped(self.value[samples], None if self.slope is None else self.slope[samples])

    @property
    def size(self) -> Sloped:
        """The absolute values."""
        sign = np.sign(self.value)
        return Sloped(
            np.abs(self.value), None if self.slope is None else sign[..., None] * self.slope
        )

    def times(self, factor: np.ndarray | float) -> Sloped:
        """Times constants that fit the values."""
        slope = None if self.slope is None else np.asarray(factor)[..., None] * self.slope
        return Sloped(self.value * factor, slope)

    def plus(self, other: Sloped) -> Sloped:
        """The sum of two of one shape."""
        if self.slope is None or other.slope is None:
            return Sloped(self.value + other.value, None)
        return Sloped(self.value + other.value, self.slope + other.slope)

    def less(self, constant: np.ndarray | float) -> Sloped:
        """Less constants that fit the values."""
        return Sloped(self.value - constant, self.slope)
