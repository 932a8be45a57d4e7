"""What samples of finite resolution leave open of a gait: other curves, other contacts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.motion.jumps import RateJump
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.smoothing.resolution import Sampled


@dataclass(frozen=True)
class Rows:
    """Where in its file each sample of a gait stands.

    Attributes:
        file: The file.
        t: Times, shape ``(n,)``.
        lines: Lines, ``(n,)``.
    """

    file: str
    t: np.ndarray
    lines: np.ndarray

    def where(self, t: float) -> str:
        """File and lines of the samples next to a time."""
        k = int(np.clip(np.searchsorted(self.t, t), 1, len(self.t) - 1))
        return f"{self.file}:{self.lines[k - 1]}–{self.lines[k]}"


@dataclass(frozen=True)
class Change:
    """Two rows between which contact changes; at which instant, they don't say.

    Attributes:
        start, end: Times t of the rows.
        before, after: Which feet bear load, left then right.
    """

    start: float
    end: float
    before: tuple[bool, bool]
    after: tuple[bool, bool]


@dataclass(frozen=True)
class Variants(Sampled):
    """What a smoothed gait carries beside its curves.

    Attributes:
        curves: For each body six curves with values ``(2 + draws,)``: the gait's own, the
            rival's (see :mod:`thesis_pin.smoothing.curve`), draws.
        changes: Where contact changes.
        hidden: Intervals of t between two rows in which a foot's rate jumps; nothing is
            known of the motion inside.
        jumps: These jumps, their rates per unit of t.
    """

    curves: dict[str, tuple[Piecewise, ...]]
    changes: tuple[Change, ...]
    hidden: tuple[tuple[float, float], ...]
    jumps: tuple[RateJump, ...]

    @property
    def count(self) -> int:
        """How many curves there are for each."""
        return int(self.curves["torso"][0].c.shape[2])

    def other_support(self, t: np.ndarray, support: np.ndarray) -> np.ndarray:
        """The other support that the rows allow at times t, ``(n, 2)``; the same if none."""
        result = np.array(support)
        for change in self.changes:
            inside = (t > change.start) & (t < change.end)
            before, after = np.array(change.before), np.array(change.after)
            was_before = (support[inside] == before).all(axis=1)
            result[inside] = np.where(was_before[:, None], after, before)
        return result

    def known(self, t: np.ndarray) -> np.ndarray:
        """Which times t aren't hidden, booleans ``(n,)``."""
        result = np.ones(len(t), dtype=bool)
        for start, end in self.hidden:
            result &= (t <= start) | (t >= end)
        return result
