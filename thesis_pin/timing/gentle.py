"""The law of a given duration that asks least of the motors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from thesis_pin.errors import Infeasible, TrajectoryError
from thesis_pin.timing.fastest import fastest
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.track import Grid

_NEAR = 1e-4  # relative difference of two shares that ends the search
_STEPS = 40


def gentlest(grid: Grid, limits: Limits, duration: float) -> tuple[Law, float]:
    """The law whose largest share of the motors' torque limits is the least.

    It is the fastest law under a share of all torque limits, the share being such that it
    takes this long; of torque–speed lines where these limit the motors.

    Args:
        grid: Places on a track.
        limits: The motors' torque limits say what counts as how much; the others are kept.
        duration: How long the motion takes [s].

    Returns:
        The law, and the share.

    Raises:
        TrajectoryError: Within the limits the motion takes longer.
        Infeasible: At rest a limit is exceeded somewhere.
    """
    whole = fastest(grid, limits)
    if whole.duration > duration:
        raise TrajectoryError(
            f"the motion shall take {duration:.6g} s",
            allowed=f"at least {whole.duration:.6g} s, which the limits leave",
            remedy="Allow more time, or more torque",
        )
    low, high, best = 0.0, 1.0, whole
    for _ in range(_STEPS):
        middle = (low + high) / 2
        try:
            law = fastest(grid, _shared(limits, middle))
        except Infeasible:
            low = middle
            continue
        if law.duration <= duration:
            high, best = middle, law
        else:
            low = middle
        if high - low <= _NEAR * high:
            break
    # What is left of the time is spent everywhere alike; slower, nothing asks for more.
    return best.slower(best.duration / duration), float(np.float64(high))


def _shared(limits: Limits, share: float) -> Limits:
    """A share of what motors may be asked for: of a line its no-load speed is a part too."""
    speed = limits.speed * share if limits.line else limits.speed
    return replace(limits, effort=limits.effort * share, speed=speed)
