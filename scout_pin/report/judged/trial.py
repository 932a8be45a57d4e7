"""Speeds tried on samples of double support, where a quadratic programme has the answer."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from scout_pin.dynamics.scaling import DoubleSupport
from scout_pin.report.judged.causes import CAUSES, Cause
from thesis_pin.tolerances import TOLERANCES

_TRIED = 12  # samples looked at for each speed tried
_CHECKED = 32  # and how many hold a limit found
_BISECTED = 4  # samples a limit is bisected on
_CLIMB = (-16, -8, -4, -2, -1, 0, 1, 2, 4, 8, 16)  # samples beside one that may be worse


class Trial:
    """Tries speeds on samples of double support.

    Args:
        double: The samples.
        growth: Shares of the servos' speed that count at s = 1, shape ``(m, 12)``.
        stall: Stall torques [N·m], ``(12,)``.
        cause: What the servos' limit is called.
        stands: Whether wrenches that no pair of soles can give are forbidden too.
    """

    def __init__(
        self,
        double: DoubleSupport,
        growth: np.ndarray,
        stall: np.ndarray,
        cause: Cause,
        *,
        stands: bool,
    ) -> None:
        self.double, self.growth, self.stall = double, growth, stall
        self.cause, self.stands = cause, stands
        self._tried: dict[float, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}

    def worst(self, s: float) -> list[int] | None:
        """Cause, sample and joint of what is passed most at a speed; None if nothing is."""
        if not (few := self._few(s)).size:
            return None
        some, use, joint = self._tried[s] = self.uses(s, few)
        return self._source(some, use, joint) if use.max(initial=0.0) > 1.0 else None

    def bisected(self, fine: float, bad: float) -> tuple[float, list[int]]:
        """Where between a fine and a bad speed, both tried, the limit is, and what it is."""
        known = np.empty(0, dtype=np.intp)
        some, use, joint = self._tried[bad]
        while True:
            source = self._source(some, use, joint)
            order = np.argsort(use, kind="stable")[-_BISECTED:]
            top = some[order[use[order] > 1.0]]
            known, root = np.union1d(known, top), self._root(top, fine, bad, use.max())
            # A little to the fine side of it, and never beyond.
            step = 1.0 + TOLERANCES.time_unit
            bad = max(root / step, fine) if fine < bad else min(root * step, fine)
            if bad == fine:
                return bad, source
            # Ten neighbours climb to the worst sample, where all would be looked at each time.
            some, use, joint = self.uses(bad, self._near(bad, some[np.argmax(use)], _CLIMB))
            if use.max(initial=0.0) <= 1.0:
                some, use, joint = self.uses(bad, self._checked(bad, known))
            if use.max(initial=0.0) <= 1.0:
                return bad, source

    def _root(self, some: np.ndarray, fine: float, bad: float, most: float) -> float:
        """Speed between a fine and a bad one at which one of some samples meets its limit.

        ``most`` is the most that they use of a servo at the bad speed.
        """
        from scipy.optimize import brentq

        ends = {bad**2: most}  # brentq asks for both once more

        def passed(square: float) -> float:
            if square not in ends:
                ends[square] = self.uses(math.sqrt(square), some)[1].max()
            return float(min(ends[square] - 1.0, 1.0))

        # Of s² torques are linear between two changes of what the programme presses against.
        if passed(fine**2) >= 0.0:
            return fine
        return math.sqrt(brentq(passed, fine**2, bad**2, rtol=TOLERANCES.time_unit / 2))

    def _few(self, s: float) -> np.ndarray:
        some = beyond(self.double, s, s)
        return some[:: 1 + len(some) // _TRIED]

    def _near(self, s: float, samples: np.ndarray, offsets: Sequence[int]) -> np.ndarray:
        """Neighbours of some samples that a speed takes to the border of a cone."""
        some = beyond(self.double, s, s)
        return some[np.isin(some, np.add.outer(samples, offsets))]

    def _checked(self, s: float, known: np.ndarray) -> np.ndarray:
        """Samples on which a limit found is held: many, and the neighbours of what decides."""
        some, few = beyond(self.double, s, s), self._few(s)
        many = np.union1d(some[:: 1 + len(some) // _CHECKED], few)
        return np.union1d(many, self._near(s, known, (-2, -1, 0, 1, 2)))

    def uses(self, s: float, some: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The samples, the most each uses of a servo (infinite if it can't stand), and which."""
        torque, broken = self.double.at(some, s)
        share = np.abs(torque) / self.stall + self.growth[some] * s
        share = np.round(share / TOLERANCES.mirror) * TOLERANCES.mirror
        use = share.max(axis=1, initial=0.0)
        if self.stands:
            use = np.where(broken, np.inf, use)
        return some, use, share.argmax(axis=1) if len(some) else np.empty(0, dtype=np.intp)

    def _source(self, some: np.ndarray, use: np.ndarray, joint: np.ndarray) -> list[int]:
        k = int(np.argmax(use))
        stands = bool(np.isfinite(use[k]))
        cause: Cause = self.cause if stands else "contact"
        sample = int(self.double.samples[some[k]])
        return [CAUSES.index(cause), sample, int(joint[k]) if stands else -1]


def beyond(double: DoubleSupport, low: float, high: float) -> np.ndarray:
    """Samples that some speed in a range takes to the border of a cone."""
    free = double.free
    return np.flatnonzero((free.low > low**2) | (free.high < high**2))
