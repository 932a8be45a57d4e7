"""What samples of finite resolution leave open of a path: other curves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from thesis_pin.numeric import quaternions
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.smoothing.resolution import Sampled

PLACE = 3
"""Coordinates of the spray tip; four of a quaternion follow."""


@dataclass(frozen=True)
class Variants(Sampled):
    """What a smoothed path carries beside its curves.

    Attributes:
        curves: x, y, z [m] and the orientation's quaternion x, y, z, w over time, each with
            values ``(2 + draws,)``: the path's own, the rival's (see
            :mod:`thesis_pin.smoothing.curve`), draws.
        parts: For each column of the samples, which curves it makes.
        moved: What is done to every curve's motion where the path is put elsewhere; None for
            nothing.
    """

    curves: tuple[Piecewise, ...]
    parts: tuple[tuple[int, ...], ...]
    moved: Callable[[BodyMotion], BodyMotion] | None = None

    @property
    def count(self) -> int:
        """How many curves there are for each."""
        return int(self.curves[0].c.shape[2])

    def others(self, time: np.ndarray) -> BodyMotion:
        """The tool's motion by all curves but the path's own, one after the other.

        Args:
            time: [s], shape ``(n,)``.

        Returns:
            The motion at ``(count − 1) n`` samples.
        """
        return self._moved(self._at(time)[..., 1:])

    def one_at_a_time(self, time: float, draws: int) -> BodyMotion:
        """The path's own motion at one time, with one column after the other drawn.

        Args:
            time: [s].
            draws: How many draws of each column.

        Returns:
            The motion at ``columns · draws`` samples.
        """
        every = self._at(np.array([time]))
        made = []
        for part in self.parts:
            one = np.repeat(every[..., :1], draws, axis=-1)
            one[:, list(part)] = every[:, list(part)][..., 2 : 2 + draws]
            made.append(one)
        return self._moved(np.concatenate(made, axis=-1))

    def _at(self, time: np.ndarray) -> np.ndarray:
        """Values and two derivatives, shape ``(3, 7, n, count)``."""
        return np.stack([[curve(time, k) for curve in self.curves] for k in (0, 1, 2)])

    def _moved(self, found: np.ndarray) -> BodyMotion:
        """A motion from ``(3, 7, n, variants)``, variant by variant."""
        flat = np.moveaxis(found, (1, -1), (-1, 1)).reshape(3, -1, found.shape[1])
        position, velocity, acceleration = flat[..., :PLACE]
        rotation, omega, alpha = quaternions.motion(*flat[..., PLACE:])
        motion = BodyMotion(rotation, position, velocity, acceleration, omega, alpha)
        return motion if self.moved is None else self.moved(motion)
