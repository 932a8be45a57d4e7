"""Feet that slide while they bear load: which, how fast, where and how far."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.result import FootDynamics
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Slide:
    """A foot that slides while it bears load.

    Attributes:
        foot: Its name.
        speed: Of its fastest corner [m/s].
        time: When that is [s].
        place: Where the foot then is in the world [m].
        way: How far it slides at most from where it lands until it leaves [m].
    """

    foot: str
    speed: float
    time: float
    place: tuple[float, float, float]
    way: float

    def said(self) -> str:
        """It in words."""
        x, y, z = (f"{part:z.3f}" for part in self.place)
        return (
            f"{self.foot} at up to {self.speed:.3g} m/s (t = {self.time:.4g} s, at x = {x}, "
            f"y = {y}, z = {z} m), {self.way * 1e3:.3g} mm in one stretch"
        )

    def document(self) -> dict[str, object]:
        """It, JSON-ready."""
        return asdict(self)


def slides_of(found: FootDynamics, time: Array, resting: float) -> tuple[Slide, ...]:
    """Feet that bear load and slide, in the feet's order.

    One that moves for a moment, as where a table says too early that it landed, doesn't.

    Args:
        found: Where the feet are and who bears load.
        time: Of the samples [s], shape ``(n,)``.
        resting: Speed up to which a foot rests [m/s].
    """
    slides = []
    for k, foot in enumerate(found.feet):
        speed = np.where(found.support[:, k], found.stance.speed[:, k], 0.0)
        moves = np.where(speed > resting, speed, 0.0)
        way = np.concatenate([[0.0], np.cumsum((moves[1:] + moves[:-1]) / 2 * np.diff(time))])
        ends = np.flatnonzero(np.diff(found.support[:, k], prepend=False, append=False))
        stretches = list(pairwise(ends))[::2]
        far = max((float(way[end - 1] - way[start]) for start, end in stretches), default=0.0)
        if far > TOLERANCES.slide:
            first = int(speed.argmax())
            x, y, z = found.stance.origin[first, k].tolist()
            fast = float(speed[first])
            slides.append(Slide(foot.name, fast, float(time[first]), (x, y, z), far))
    return tuple(slides)
