"""What a law of time asks of the motors along a path."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.smallest.free import AnyLaw
from thesis_pin.sizing.loads import Array, Loads
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.timing.law import Law
from thesis_pin.timing.solving import Solved
from thesis_pin.timing.track import Grid, Values

POINTS = 4
"""Inside each interval of a law's grid at which loads are told."""


@dataclass(frozen=True, eq=False)
class Found:
    """The smallest motors of some proportions that do a path in a time.

    Attributes:
        torque: Stall torque of each [N·m], shape ``(6,)``.
        law: The law, as long as it may be.
        grid: Its places.
        solved: The fastest law with such motors, judged between its places.
        settled: Relative change of the torque when all intervals were halved: about as much less
            would do.
    """

    torque: Array
    law: Law
    grid: Grid
    solved: Solved
    settled: float


def heat_along(path: AnyLaw, found: Found, family: Family) -> Array:
    """Root mean square of the motors' torques over a law [N·m], ``(6,)``; quick, at its places."""
    law, limits = found.law, path.limits(found.torque, family)
    u, total = law.acceleration[:, None], np.zeros(len(ACTUATOR_NAMES))
    for known, rate in zip(found.grid.sides(), (law.rate[:-1], law.rate[1:]), strict=True):
        v = rate[:, None]
        a, b, d = np.moveaxis(known.effort, 1, 0)
        rotor = 0.0 if limits.rotor is None else limits.rotor
        torque = (a + rotor * known.speed) * u + (b + rotor * known.bend) * v**2 + d
        total += np.diff(law.time) @ torque**2 / 2.0
    return np.asarray(np.sqrt(total / law.duration))


def inside(found: Found) -> list[Values]:
    """What the path asks for at points inside all intervals of a law's grid, piece by piece."""
    grid, law = found.grid, found.law
    counts = np.cumsum([len(one) - 1 for one in grid.places])[:-1]
    at = np.split(law.within(POINTS)[0], counts)
    return [grid.track.values(piece, one.ravel()) for piece, one in enumerate(at)]


def loads_along(
    path: AnyLaw, found: Found, given: Loads, asked: list[Values] | None = None
) -> Loads:
    """What a law asks of each motor's joint, at points inside all intervals of its grid.

    Args:
        path: The path.
        found: The law.
        given: Loads in another timing, for their names and notes.
        asked: From :func:`inside`, of any law of the same grid; None works it out.
    """
    grid, law = found.grid, found.law
    s, rate, bend = (np.asarray(one, dtype=float) for one in law.within(POINTS))
    start, first = law.time[:-1, None], law.rate[:-1, None]
    time = start + 2.0 * (s - law.place[:-1, None]) / (first + rate)
    own = path.report.robot.specification.motors.armature()
    parts = [grid.split(one) for one in (rate, bend)]
    torque, speed, acceleration = [], [], []
    for known, v, u in zip(inside(found) if asked is None else asked, *parts, strict=True):
        v, u = v.reshape(-1, 1), u.reshape(-1, 1)
        a, b, d = np.moveaxis(known.effort, 1, 0)
        moved = known.speed * u + known.bend * v**2
        torque.append(a * u + b * v**2 + d - own * moved)
        speed.append(known.speed * v)
        acceleration.append(moved)
    return Loads(
        given.robot,
        given.motion,
        given.joints,
        time.ravel(),
        np.concatenate(torque),
        np.concatenate(speed),
        np.concatenate(acceleration),
        given.notes,
    )
