"""The smallest motors with which a path is done in a time, and the laws for them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from pollard_pin.study.smallest.along import Found
from pollard_pin.study.smallest.free import AnyLaw
from thesis_pin.errors import BadInput, Infeasible
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
_FINE = 1.02  # least first step from what is known to do
_BEYOND = 1.5  # how much further it goes than a time that falls as torque grows asks for
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
    near: Law | None = None

    def make(size: float, grid: Grid) -> Law:
        # Motors differ little from one to the next, so that their laws do.
        nonlocal near
        near = fastest(grid, path.limits(size * shape, family).tightened(SPARE), near)
        return near

    def excess(size: float, grid: Grid) -> float:
        try:
            return min(math.log(make(size, grid).duration / within), _FAR)
        except Infeasible:
            return _FAR

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
    if high > 0.0:
        bad, low = good, high
        for k in range(1, _STEPS):
            # Where speed falls with torque, the sizes that do may be smaller ones.
            more, less = start * _STEP**k, start / _STEP**k
            if (high := excess(more)) <= 0.0:
                return _between(excess, (bad, low), (more, high))
            bad, low = more, high
            if (high := excess(less)) <= 0.0:
                good = less
                break
        else:
            raise BadInput(
                "no motors of this kind do the path in that time, however strong",
                remedy="Allow more time, a greater speed or power, or a lighter rotor",
            )
    # Time falls about as torque grows: a step as long as that is seldom too short.
    step = max(_FINE, min(math.exp(-_BEYOND * high), _STEP))
    bad, low = good / step, excess(good / step)
    while low <= 0.0:
        good, high, step = bad, low, min(step**2, _STEP)
        bad = good / step
        low = excess(bad)
    return _between(excess, (bad, low), (good, high))


def _between(
    excess: Callable[[float], float], bad: tuple[float, float], good: tuple[float, float]
) -> float:
    """The border between two sizes, on the good side: by secants, none of whose ends stays.

    Source: M. Dowell and P. Jarratt, A modified regula falsi method for computing the root of an
    equation, 1971: the value at an end that stays counts half.
    """
    side, near = 0.0, TOLERANCES.motor_torque / 3
    low, high = bad[1], good[1]
    while (width := good[0] - bad[0]) > TOLERANCES.motor_torque * good[0]:
        # Once a little to the good side, once to the other, so that the bracket closes from both.
        size = bad[0] + width * low / (low - high) + (-side or 1.0) * near * good[0]
        size = min(max(size, bad[0] + width / 16), good[0] - width / 16)
        found = excess(size)
        if found <= 0.0:
            good, high = (size, found), found
            low = low / 2 if side > 0.0 else low
            side = 1.0
        else:
            bad, low = (size, found), found
            high = high / 2 if side < 0.0 else high
            side = -1.0
    return good[0]
