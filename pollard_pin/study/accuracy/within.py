"""The other way round: which tolerances keep the spray tip within a distance."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.study.accuracy.parameters import Unit
from pollard_pin.study.accuracy.stacking import stacked
from pollard_pin.study.accuracy.tolerances import UNITS, Tolerances
from thesis_pin.display.brief import Brief

_LOOKED = 64
"""Poses, those with the largest errors, at which exact kinematics confirm a tolerance."""

_TRIED = 10

_CLOSE = 1e-4
"""Share of the distance that a tolerance needn't use, and may pass."""


@dataclass(frozen=True)
class Equal(Brief):
    """An equal tolerance of some numbers, all others being exact.

    Attributes:
        of: A kind, or ``all lengths`` or ``all angles``.
        count: How many numbers have it.
        unit: Of the sizes.
        worst: Size at which the tip is as far off as it may at worst, by exact kinematics.
        root: Size at which the root of the sum of squares is.
    """

    of: str
    count: int
    unit: Unit
    worst: float
    root: float


@dataclass(frozen=True)
class Within(Brief):
    """Tolerances that keep the spray tip within a distance on a path.

    Attributes:
        limit: The distance [m].
        factor: Factor of all tolerances at which the tip is that far off at worst, by exact
            kinematics.
        factor_root: The same of the root of the sum of squares.
        equal: Equal tolerances, of one kind each and of all lengths and all angles.
    """

    limit: float
    factor: float
    factor_root: float
    equal: tuple[Equal, ...]


def within(robot: Pollard, angles: np.ndarray, allowed: Tolerances, limit: float) -> Within:
    """Work out which tolerances keep the spray tip within a distance.

    Args:
        robot: The planned robot.
        angles: Its closed configurations [rad], shape ``(n, 12)``.
        allowed: Tolerances, which are made wider or narrower together; and whose numbers get
            equal ones.
        limit: Distance [m].
    """
    factor, root = _factors(robot, angles, allowed, limit)
    groups: dict[str, list[int]] = {kind: of.tolist() for kind, of in allowed.kinds.items()}
    units: tuple[Unit, ...] = ("mm", "deg")
    for unit, name in zip(units, ("all lengths", "all angles"), strict=True):
        some = [k for k, one in enumerate(allowed.each) if one.parameter.unit == unit]
        if some and all(some != other for other in groups.values()):
            groups[name] = some
    equal = []
    for name, some in groups.items():
        unit = allowed.each[some[0]].parameter.unit
        one = replace(
            allowed, each=tuple(replace(allowed.each[k], size=UNITS[unit] / 10) for k in some)
        )
        sizes = [0.1 * factor for factor in _factors(robot, angles, one, limit)]
        equal.append(Equal(name, len(some), unit, *sizes))
    return Within(limit, factor, root, tuple(equal))


def _factors(
    robot: Pollard, angles: np.ndarray, allowed: Tolerances, limit: float
) -> tuple[float, float]:
    """Factors of tolerances at which worst case and root of squares are as asked for.

    That of the worst case is confirmed by exact kinematics; 0 where none of those tried is.
    """
    stack = stacked(robot, angles, allowed)
    with np.errstate(divide="ignore"):
        root = float(limit / stack.root.max())
        factor = float(limit / stack.worst.max())
    if not np.isfinite(factor):
        return factor, root
    worst = angles[np.argsort(-stack.worst, kind="stable")[:_LOOKED]]
    found = 0.0
    for _ in range(_TRIED):
        exact = float(stacked(robot, worst, allowed.times(factor)).farthest.max())
        if exact <= limit * (1.0 + _CLOSE):
            found = max(found, factor)
            if exact >= limit * (1.0 - _CLOSE):
                break
        factor *= limit / exact if np.isfinite(exact) else 0.5
    return found, root
