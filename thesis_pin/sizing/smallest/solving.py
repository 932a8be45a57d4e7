"""The least stall torque that carries what it is asked for, where that depends on the motor."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from thesis_pin.sizing.loads import Array, Loads
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.tolerances import TOLERANCES

_DECADES = (-4.0, 4.0)
"""Where a stall torque is looked for, around the load's own peak."""
_A_DECADE = 24


def asked(loads: Loads, family: Family, torque: Array, factor: float = 1.0) -> tuple[Array, Array]:
    """Which stall torques motors of some stall torques would need.

    Args:
        loads: Of ``k`` joints.
        family: Their motors.
        torque: Stall torque of each, which says its speed and its rotor [N·m], shape ``(k,)``.
        factor: Least safety factor.

    Returns:
        To do the motion once, and for long, repeated endlessly [N·m], ``(k,)`` each; infinite
        where a joint turns too fast for any torque.
    """
    needed = loads.torque + family.rotors(torque) * loads.acceleration
    share = np.abs(loads.speed) / family.speeds(torque)
    left = 1.0 - share if family.bound == "line" else np.where(share <= 1.0, 1.0, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        once = factor * np.abs(needed) / left
    # Without load any speed below the free one will do, and none above.
    once = np.where(needed == 0.0, 0.0, once)
    beyond = share > 1.0 if family.bound == "box" else (left < 0.0)
    once = np.where(beyond | np.isnan(once), np.inf, once).max(axis=0)
    return once, np.maximum(once, loads.rms(needed) / family.rating)


def least_torque(need: Callable[[float], float], scale: float, *, fixed: bool) -> float | None:
    """The least torque T with ``need(T) <= T``; None if there is none.

    Args:
        need: Torque that a motor of stall torque T is asked for; infinite where it can't.
        scale: Size of the torques there are.
        fixed: Whether need doesn't depend on T.
    """
    if fixed:
        only = need(scale or 1.0)
        return only if np.isfinite(only) else None
    if not scale > 0.0:
        return 0.0
    low, high = _DECADES
    grid = scale * np.logspace(low, high, round((high - low) * _A_DECADE) + 1)
    ratio = np.array([need(one) / one for one in grid])
    good = np.flatnonzero(ratio <= 1.0)
    if good.size:
        k = int(good[0])
        return float(grid[0]) if k == 0 else _between(need, grid[k - 1], grid[k])
    # A window may lie between two of the grid's torques.
    k = int(np.argmin(ratio))
    if not np.isfinite(ratio[k]):
        return None
    from scipy.optimize import minimize_scalar

    ends = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
    found = minimize_scalar(lambda one: need(one) / one, bounds=ends, method="bounded")
    return _between(need, float(ends[0]), float(found.x)) if found.fun <= 1.0 else None


def _between(need: Callable[[float], float], bad: float, good: float) -> float:
    """The border between a torque that isn't enough and one that is, on the side that is."""
    while good - bad > TOLERANCES.motor_torque * good:
        middle = (bad + good) / 2
        bad, good = (bad, middle) if need(middle) <= middle else (middle, good)
    return good


def smallest_torques(
    loads: Loads, family: Family, groups: Sequence[Sequence[int]], factor: float = 1.0
) -> tuple[Array, Array]:
    """The least stall torque of each joint's motor, those of a group being alike.

    Args:
        loads: Of ``k`` joints.
        family: Their motors.
        groups: Numbers of the joints of each group.
        factor: Least safety factor.

    Returns:
        To do the motion once, and for long [N·m], ``(k,)`` each; NaN where no motor of the kind
        carries it.
    """
    found = np.full((2, len(loads.joints)), np.nan)
    for group in groups:
        joints = list(group)
        some, kind = loads.part(joints), family.part(joints)
        scale = float(
            np.abs(some.torque).max() + np.abs(some.acceleration).max() * kind.armature.max()
        )
        for which in (0, 1):

            def need(torque: float, which: int = which) -> float:
                each = np.full(len(joints), torque)  # noqa: B023 (called here only)
                return float(asked(some, kind, each, factor)[which].max())  # noqa: B023

            value = least_torque(need, scale, fixed=kind.fixed)
            found[which, joints] = np.nan if value is None else value
    return found[0], found[1]
