"""What a column of samples resolves, and what would settle what it leaves open."""

from __future__ import annotations

import math
from dataclasses import dataclass

from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.noise import ROUNDING

_FINEST = 1e-9
"""Resolution below which more digits are no answer [m], [rad]."""


@dataclass(frozen=True)
class Resolution:
    """What a column of samples resolves.

    Attributes:
        name: What the column is called.
        quantum: Smallest step of its text, or what the user stated [m] or [rad].
        noise: Standard deviation of a sample, by its fit; that of where it rests if it
            shows no motion.
        moves: Whether it shows any.
        turns: Whether it is an angle.
    """

    name: str
    quantum: float
    noise: float
    moves: bool
    turns: bool

    def needed(self, held: Interval, limit: float) -> float:
        """Resolution at which an interval would end at a limit, and one digit more.

        The posterior's standard deviation of x'' goes with σ to the power of (2m − 5)/2m.
        """
        from thesis_pin.smoothing.curve import ORDER

        beyond = held.high - held.value if held.value < limit else held.value - held.low
        ratio = abs(held.value - limit) / max(beyond, 1e-300)
        now = max(self.quantum, self.noise / ROUNDING)
        wanted = now * min(ratio, 1.0) ** (2 * ORDER / (2 * ORDER - 5)) / 10.0
        return max(10.0 ** math.floor(math.log10(max(wanted, 1e-300)) + 1e-9), _FINEST)


@dataclass(frozen=True, kw_only=True, eq=False)
class Sampled:
    """What curves from samples of finite resolution say of them.

    Attributes:
        columns: What each column resolves.
        rate: Samples a unit of time.
        seed: Of the draws.
    """

    columns: tuple[Resolution, ...]
    rate: float
    seed: int
