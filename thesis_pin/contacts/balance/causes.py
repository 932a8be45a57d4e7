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

ROUGH = 2.0
"""Friction that no floor exceeds; feet that would need more tip or turn [-]."""

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
        push: Force along the floor that no friction gives [N].
        pull: Force into the floor that is missing [N]: feet would have to stick to it.
        outside: How far the zero-moment point is outside the support polygon [m]; 0 inside.
    """

    sample: int
    friction: float | None
    tip: float
    turn: float
    push: float
    pull: float
    outside: float

    @property
    def slips(self) -> bool:
        """Whether more friction would be enough."""
        return self.friction is not None and self.friction > 1.0


def cause(dynamics: FootDynamics, sample: int, border: float | None = None) -> Cause:
    """What is missing at a sample at which the floor can't give what the motion needs.

    What even the roughest floor (:data:`ROUGH`) couldn't give tips, turns or lifts off; what it
    could slips.

    Args:
        dynamics: The motion's.
        sample: Number of the sample.
        border: What may be missing [N·m]; None for rounding alone.
    """
    floor = dynamics.floor
    border = tolerance(dynamics.scale) if border is None else border
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
    rough = max(1.0, ROUGH / max(dynamics.feet[k].friction for k in standing))
    _, rest = missing(weights[:, None] * sums, grips.rays(EDGES, rough), weights * total)
    rest /= weights
    if np.linalg.norm(rest) > border:
        rest[:3] /= dynamics.length
        return Cause(sample, None, *_split(rest, floor.normal), outside)
    least = missing(sums, grips.rays(EDGES, rough), total)[0] + tolerance(dynamics.scale)
    needed = _least(lambda share: missing(sums, grips.rays(EDGES, share), total)[0] <= least, rough)
    return Cause(sample, needed, 0.0, 0.0, 0.0, 0.0, outside)


def _split(wrench: Array, normal: Array) -> tuple[float, float, float, float]:
    """Moments along and about the floor [N·m], forces along and into it that are missing [N]."""
    force, moment = wrench[:3], wrench[3:]
    across, turn = moment - normal * (moment @ normal), abs(float(moment @ normal))
    push = float(np.linalg.norm(force - normal * (force @ normal)))
    return float(np.linalg.norm(across)), turn, push, max(-float(force @ normal), 0.0)


def _least(enough: Callable[[float], bool], high: float) -> float:
    """The least number that is enough, within :data:`_FINE`, if the given one is."""
    low = 0.0
    while high - low > _FINE * high and high > _FINE:
        middle = (low + high) / 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high
