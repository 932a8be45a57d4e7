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
        certain: Whether the samples' resolution can't be all of it.
    """

    foot: str
    speed: float
    time: float
    place: tuple[float, float, float]
    way: float
    certain: bool = True

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


def slides_of(
    found: FootDynamics, time: Array, resting: float, loose: Array | None = None
) -> tuple[Slide, ...]:
    """Feet that bear load and slide, or may, in the feet's order.

    One that moves for a moment, as where a table says too early that it landed, doesn't.

    Args:
        found: Where the feet are and who bears load.
        time: Of the samples [s], shape ``(n,)``.
        resting: Speed up to which a foot rests [m/s].
        loose: What the samples leave open of each foot's speed [m/s], ``(feet,)``; None if
            nothing.
    """
    loose = np.zeros(len(found.feet)) if loose is None else loose
    slides = []
    for k, foot in enumerate(found.feet):
        speed = np.where(found.support[:, k], found.stance.speed[:, k], 0.0)
        ends = np.flatnonzero(np.diff(found.support[:, k], prepend=False, append=False))
        stretches = list(pairwise(ends.tolist()))[::2]
        far = _furthest(speed, resting, time, stretches)
        if far > TOLERANCES.slide:
            first = int(speed.argmax())
            x, y, z = found.stance.origin[first, k].tolist()
            fast, when = float(speed[first]), float(time[first])
            sure = _furthest(speed - loose[k], resting, time, stretches) > TOLERANCES.slide
            slides.append(Slide(foot.name, fast, when, (x, y, z), far, sure))
    return tuple(slides)


def _furthest(speed: Array, resting: float, time: Array, stretches: list[tuple[int, int]]) -> float:
    """The longest way [m] that a foot makes faster than resting, in one stretch."""
    moves = np.where(speed > resting, speed, 0.0)
    way = np.concatenate([[0.0], np.cumsum((moves[1:] + moves[:-1]) / 2 * np.diff(time))])
    return max((float(way[end - 1] - way[start]) for start, end in stretches), default=0.0)
