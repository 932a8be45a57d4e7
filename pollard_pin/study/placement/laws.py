"""The fastest law of motion at the best placements: what the motors' limits leave of the time.

A grid is put into order by playing the path faster as it is timed, which costs a thousandth; which
of the best is the fastest with a law of its own is known only when that has been found.
"""

from __future__ import annotations

import math
from dataclasses import replace

from pollard_pin.motion.placing import place_path
from pollard_pin.study.placement.placements import Placements
from pollard_pin.study.placement.result import Found
from thesis_pin.errors import ThesisPinError

COUNT = 3
"""Placements whose laws are looked for."""


def with_laws(space: Placements, count: int = COUNT) -> Placements:
    """The same search with the fastest laws of its best placements, the fastest first.

    Args:
        space: A search for the shortest time.
        count: For how many of the best.
    """
    best = [_timed(space, one) for one in space.best[:count]]
    best.sort(key=lambda one: one.duration_by_law)
    start = space.start if space.start.reason else _timed(space, space.start)
    return replace(space, start=start, best=(*best, *space.best[count:]))


def _timed(space: Placements, one: Found) -> Found:
    from pollard_pin.study.timing.timed import time_path

    path = place_path(space.path, one.placement)
    try:
        law = time_path(space.robot, path, branch=one.branch)
    except ThesisPinError:
        return one  # nothing is lost: it can still be played as it is timed
    return replace(one, law=law) if law.within_limits and math.isfinite(law.duration) else one
