"""Why the floor can't give what a motion needs, and how much is missing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.grips import Grips
from thesis_pin.contacts.balance.result import FootDynamics
from thesis_pin.contacts.balance.sharing import missing, tolerance

Array = NDArray[np.float64]

EDGES = 32
"""Edges of the pyramids by which needed friction is told: within 0.5 % of the cone's."""

_MOST = 100.0  # times the friction there is; needing more is no matter of friction
_FORCE_FIRST = 1e3  # how much more a missing force counts than a missing moment
_FINE = 1e-4  # relative width of the interval in which the needed friction is found


@dataclass(frozen=True)
class Cause:
    """What is missing at one sample.

    Attributes:
        sample: Its number.
        friction: Friction that would be enough, of that there is [-]: more than 1 slips, None
            if no friction is.
        tip: Moment along the floor that no friction gives [N·m]: the robot tips.
        turn: Moment about the floor's normal that no friction gives [N·m].
        pull: Force out of the floor that no friction gives [N]: feet would have to stick.
        outside: How far the zero-moment point is outside the support polygon [m]; 0 inside.
    """

    sample: int
    friction: float | None
    tip: float
    turn: float
    pull: float
    outside: float

    @property
    def slips(self) -> bool:
        """Whether more friction would be enough."""
        return self.friction is not None and self.friction > 1.0


def cause(dynamics: FootDynamics, sample: int) -> Cause:
    """What is missing at a sample at which the floor can't give what the motion needs.

    Args:
        dynamics: The motion's.
        sample: Number of the sample.
    """
    floor, border = dynamics.floor, tolerance(dynamics.scale)
    margin = float(dynamics.margin[sample])
    outside = max(-margin, 0.0) if np.isfinite(margin) else 0.0
    standing = np.flatnonzero(dynamics.support[sample]).tolist()
    total = dynamics.required[sample].copy()
    if not standing:
        total[3:] -= np.cross(dynamics.stance.com[sample], total[:3])
        return Cause(sample, None, *_split(total, floor.normal), outside)
    here = dynamics.stance.part(slice(sample, sample + 1))
    about = here.origin[:, standing].mean(axis=1)
    total[3:] -= np.cross(about[0], total[:3])
    total[:3] *= dynamics.length
    grips = Grips.of(dynamics.feet, standing, dynamics.length)
    sums = grips.sums(here, about)[0]
    # A moment is to be named, not the force that would mend it by leaning on an edge.
    weights = np.repeat([_FORCE_FIRST, 1.0], 3)
    _, rest = missing(weights[:, None] * sums, grips.pushes, weights * total)
    rest /= weights
    if np.linalg.norm(rest) > border:
        rest[:3] /= dynamics.length
        return Cause(sample, None, *_split(rest, floor.normal), outside)
    needed = _least(lambda share: missing(sums, grips.rays(EDGES, share), total)[0] <= border)
    return Cause(sample, needed, 0.0, 0.0, 0.0, outside)


def _split(wrench: Array, normal: Array) -> tuple[float, float, float]:
    """Moments along and about the floor [N·m], and the force into it that is missing [N]."""
    force, moment = wrench[:3], wrench[3:]
    along = moment - normal * (moment @ normal)
    return (
        float(np.linalg.norm(along)),
        abs(float(moment @ normal)),
        max(-float(force @ normal), 0.0),
    )


def _least(enough: Callable[[float], bool]) -> float | None:
    """The least number that is enough, within :data:`_FINE`; None if :data:`_MOST` isn't."""
    high = 1.0
    while not enough(high):
        high *= 2.0
        if high > _MOST:
            return None
    low = 0.0
    while high - low > _FINE * high and high > _FINE:
        middle = (low + high) / 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high
