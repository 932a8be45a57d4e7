"""The smallest motors with which a path is done in a time, and the laws for them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from pollard_pin.study.smallest.along import Found
from pollard_pin.study.smallest.free import AnyLaw
from thesis_pin.errors import BadInput
from thesis_pin.sizing.loads import Array
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.timing.fastest import fastest
from thesis_pin.timing.law import Law
from thesis_pin.timing.solving import SPARE, solve
from thesis_pin.timing.track import Grid
from thesis_pin.tolerances import TOLERANCES

_ROUNDS = 3
_HALVINGS = 6
_STEP = 1.5
_STEPS = 30  # either way
_FINE = 1.02  # first step from what is known to do
_FAR = 3.0  # of the logarithm of a duration over the asked one: as good as never
_MOST = 10.0  # times the least torque, beyond which laws are no gentler
_NEAR = 0.05  # relative difference of two such torques that ends the search


def smallest_in(
    path: AnyLaw,
    family: Family,
    shape: Array,
    within: float,
    tick: Callable[[], None],
) -> Found:
    """The smallest motors of some proportions with which a path is done in a time.

    Args:
        path: The path.
        family: Which motors.
        shape: Their stall torques up to a common factor [N·m], ``(6,)``.
        within: The time [s].
        tick: Called at each step.

    Raises:
        BadInput: No motors of the kind do it.
    """
    grid, scale = path.course.grid, 1.0

    def excess(size: float, grid: Grid) -> float:
        time = path.fastest(path.limits(size * shape, family), grid)
        return min(math.log(time / within), _FAR)

    def make(size: float, grid: Grid) -> Law:
        return fastest(grid, path.limits(size * shape, family).tightened(SPARE))

    scale = _least(partial(excess, grid=grid), scale)
    # Near what just holds the robot the time is steep in the torque: the torque has to settle.
    for _ in range(_HALVINGS):
        tick()
        grid = grid.finer([np.full(len(one) - 1, 2) for one in grid.places])
        last, scale = scale, _least(partial(excess, grid=grid), scale)
        settled = abs(scale / last - 1.0)
        if settled <= TOLERANCES.settled_torque:
            break
    for _ in range(_ROUNDS):
        tick()
        solved = solve(grid, path.limits(scale * shape, family), partial(make, scale))
        if solved.law.duration <= within * (1.0 + TOLERANCES.motor_torque):
            break
        grid = solved.grid
        scale = _least(partial(excess, grid=grid), scale)
    law = solved.law.slower(min(solved.law.duration / within, 1.0))
    return Found(scale * shape, law, solved.grid, solved, settled)


def gentlest_in(
    path: AnyLaw, family: Family, found: Found, within: float, heat: Callable[[Found], float]
) -> Found:
    """The coolest of laws that are fastest under a multiple of the torques, and then run slower.

    Args:
        path: The path.
        family: Which motors.
        found: The smallest motors that do it once.
        within: The time [s].
        heat: What is to be least.
    """
    from scipy.optimize import minimize_scalar

    limits = path.limits(found.torque, family)

    def law(size: float, grid: Grid) -> Found:
        made = fastest(grid, replace(limits, effort=limits.effort * math.exp(size)))
        slow = made.slower(min(made.duration / within, 1.0))
        return replace(found, law=slow, grid=grid)

    best = minimize_scalar(
        lambda size: heat(law(size, path.course.grid)),
        bounds=(0.0, math.log(_MOST)),
        method="bounded",
        options={"xatol": _NEAR},
    )
    return law(float(best.x), found.grid)


def _least(excess: Callable[[float], float], start: float) -> float:
    """The least size with which a path is in time, from the side that is.

    Args:
        excess: Logarithm of the path's time with a size over the one that is asked for.
        start: Where to begin.

    Raises:
        BadInput: None is.
    """
    good, high = start, excess(start)
    for k in range(1, _STEPS):
        if high <= 0.0:
            break
        # Where speed falls with torque, the sizes that do may be smaller ones.
        for size in (start * _STEP**k, start / _STEP**k):
            good, high = size, excess(size)
            if high <= 0.0:
                break
    else:
        raise BadInput(
            "no motors of this kind do the path in that time, however strong",
            remedy="Allow more time, a greater speed or power, or a lighter rotor",
        )
    step = _FINE
    bad, low = good / step, excess(good / step)
    while low <= 0.0:
        good, high, step = bad, low, step**2
        bad = good / step
        low = excess(bad)
    return _between(excess, (bad, low), (good, high))


def _between(
    excess: Callable[[float], float], bad: tuple[float, float], good: tuple[float, float]
) -> float:
    """The border between two sizes, on the good side: by secants, and halves where they stall."""
    halve, side, near = False, 1.0, TOLERANCES.motor_torque / 3
    while (width := good[0] - bad[0]) > TOLERANCES.motor_torque * good[0]:
        share = 0.5 if halve else bad[1] / (bad[1] - good[1])
        # Once a little to the good side, once to the other, so that the bracket closes from both.
        size = bad[0] + width * share + side * near * good[0]
        size = min(max(size, bad[0] + width / 16), good[0] - width / 16)
        found = excess(size)
        side = -1.0 if found <= 0.0 else 1.0
        bad, good = (bad, (size, found)) if found <= 0.0 else ((size, found), good)
        halve = good[0] - bad[0] > width / 2
    return good[0]
