"""A law of motion along a path: how far one is at each time."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.timing.rows import Array


@dataclass(frozen=True, eq=False)
class Law(Brief):
    """Motion along a path with constant acceleration between places.

    Attributes:
        place: Places s, increasing, shape ``(n,)``.
        rate: ṡ there, shape ``(n,)``; never zero at two in a row.
    """

    place: Array
    rate: Array

    @cached_property
    def time(self) -> Array:
        """When it is at each place [s], shape ``(n,)``; never beyond two in a row at rest."""
        with np.errstate(divide="ignore"):
            step = 2 * np.diff(self.place) / (self.rate[1:] + self.rate[:-1])
        return np.concatenate([[0.0], np.cumsum(step)])

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.time[-1])

    @cached_property
    def acceleration(self) -> Array:
        """s̈ between places, shape ``(n − 1,)``."""
        return np.asarray(np.diff(self.rate**2) / (2 * np.diff(self.place)))

    def __call__(self, time: Array) -> tuple[Array, Array, Array]:
        """s, ṡ and s̈ at times within the duration, each ``(n,)``."""
        k = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.place) - 2)
        after, rate, bend = time - self.time[k], self.rate[k], self.acceleration[k]
        s = self.place[k] + after * (rate + after * bend / 2)
        s = np.clip(s, self.place[k], self.place[k + 1])
        return s, np.maximum(rate + after * bend, 0.0), bend

    def square(self, place: Array) -> Array:
        """ṡ² at places, the same shape."""
        return np.interp(place, self.place, self.rate**2)

    def within(self, points: int) -> tuple[Array, Array, Array]:
        """s, ṡ and s̈ at points evenly spread inside each interval, each ``(n − 1, points)``."""
        share = (np.arange(points) + 0.5) / points
        width, square = np.diff(self.place)[:, None], self.rate**2
        x = square[:-1, None] + share * np.diff(square)[:, None]
        bend = np.broadcast_to(self.acceleration[:, None], x.shape)
        return self.place[:-1, None] + share * width, np.sqrt(np.maximum(x, 0.0)), bend

    def slower(self, factor: float) -> Law:
        """The same at a share of its rates: it takes 1 / factor as long."""
        return Law(self.place, self.rate * factor)
