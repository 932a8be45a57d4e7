"""Robots with drawn errors, each on exact kinematics: how far off they put the spray tip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.study.accuracy.exact import reached
from pollard_pin.study.accuracy.tolerances import Tolerances
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import whole
from thesis_pin.numeric.workers import silent

MOST = 20_000_000
"""Draws times poses at most: 160 MB of distances."""

_AT_ONCE = 16_384
"""Robots times poses that are worked out at once."""


@dataclass(frozen=True)
class Draws(Brief):
    """Drawn robots; those that can't be assembled at a pose don't count there.

    Attributes:
        seed: Of the errors; the same seed draws the same robots.
        distance: How far off each puts the tip [m], shape ``(draws, n)``; NaN where it can't be
            assembled.
        turn: How far the spray direction is off [rad], likewise.
        deviation: Standard deviation of the tip's place: root of the sum of its components'
            variances [m], shape ``(n,)``.
    """

    seed: int
    distance: np.ndarray
    turn: np.ndarray
    deviation: np.ndarray

    @property
    def count(self) -> int:
        """How many robots were drawn."""
        return len(self.distance)

    @property
    def assembled(self) -> np.ndarray:
        """Whether each can be assembled at every pose, shape ``(draws,)``."""
        return np.asarray(~np.isnan(self.distance).any(axis=1))

    @property
    def farthest(self) -> np.ndarray:
        """Farthest that each puts the tip off anywhere [m], infinite if it can't go everywhere."""
        return np.where(self.assembled, self.distance.max(axis=1), np.inf)

    @property
    def turned(self) -> np.ndarray:
        """The same of the spray direction [rad]."""
        return np.where(self.assembled, self.turn.max(axis=1), np.inf)


def drawn(
    robot: Pollard,
    angles: np.ndarray,
    allowed: Tolerances,
    draws: int,
    seed: int = 0,
    progress: Callable[[int, int], None] = silent,
) -> Draws:
    """Draw robots within tolerances and send each to all poses, the motors as planned.

    Args:
        robot: The planned robot.
        angles: Its closed configurations [rad], shape ``(n, 12)``.
        allowed: What may be off.
        draws: How many.
        seed: Of the errors.
        progress: Called with the robots done and their total.

    Raises:
        BadInput: More than 20 million draws times poses.
    """
    draws, seed, count = whole("draws", draws, 1), whole("seed", seed, 0), len(angles)
    if draws * count > MOST:
        raise BadInput(
            f"{draws:,} draws at {count:,} poses",
            allowed=f"{MOST:,} draws times poses",
            remedy="Take fewer of either",
        )
    posture = robot.posture(angles)
    planned, along = posture.tip, posture.tool_rotation[..., :, 0]
    distance, turn = np.empty((draws, count)), np.empty((draws, count))
    sums, squares = np.zeros((count, 3)), np.zeros((count, 3))
    step = max(1, _AT_ONCE // count)
    for first in range(0, draws, step):
        some = range(first, min(first + step, draws))
        errors = allowed.whole(allowed.drawn(seed, some))[..., None]
        where = reached(robot.specification, angles, errors)
        away = where.tip - planned
        distance[some] = np.linalg.norm(away, axis=-1)
        turn[some] = _angle(where.direction, along)
        known = np.where(np.isnan(away), 0.0, away)
        sums += known.sum(axis=0)
        squares += (known * known).sum(axis=0)
        progress(some.stop, draws)
    there = (~np.isnan(distance)).sum(axis=0)[:, None]
    with np.errstate(invalid="ignore", divide="ignore"):
        variance = (squares - sums * sums / there) / (there - 1)
    return Draws(seed, distance, turn, np.sqrt(variance.clip(min=0.0).sum(axis=-1)))


def _angle(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Angle between unit vectors [rad]; by the chord, which small angles don't lose digits of."""
    chord = np.linalg.norm(a - b, axis=-1)
    return np.asarray(2.0 * np.arcsin(np.minimum(chord / 2.0, 1.0)))
