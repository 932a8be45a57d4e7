"""From a cycle that keeps its limits to the best of its kind: one limit is tightened step by step.

Each step begins where the last one ended, so that a few iterations do; a step that fails is
halved. Where no step helps any more all starts are tried once for a small one: another valley may
go on. What is found is a local optimum.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from scout_pin.study.plan.cycles.search import Candidate, Search
from scout_pin.study.plan.request import PlanRequest
from thesis_pin.errors import ThesisPinError

STEPS = 40
"""Descents at most."""

_FIRST = 0.12  # what is tried first, relative
_FINE = 0.004  # and when it is given up
_ANEW = 0.02  # what all starts are tried for
_OFTEN = 2  # and how often
_FASTER, _SLOWER = 1.4, 0.5
_MOST = 30  # steps of Gauss–Newton a descent


@dataclass(frozen=True)
class Aim:
    """What is to be tightened.

    Attributes:
        value: Of a request, what is tightened.
        tightened: The request with this value and a share more of it.
    """

    value: Callable[[PlanRequest], float]
    tightened: Callable[[PlanRequest, float], PlanRequest]


def _faster(request: PlanRequest, share: float) -> PlanRequest:
    speed = request.walking_speed * (1.0 + share)
    return request.changed(speed=speed, step_time=None, objective="limits")


def _weaker(request: PlanRequest, share: float) -> PlanRequest:
    left = (1.0 - request.torque_reserve) * (1.0 - share)
    return request.changed(torque_reserve=min(1.0 - left, 0.95))


def _safer(request: PlanRequest, share: float) -> PlanRequest:
    return request.changed(margin=request.margin + 0.02 * share)


AIMS = {
    "fastest": Aim(lambda one: one.walking_speed, _faster),
    "least_torque": Aim(lambda one: 1.0 - one.torque_reserve, _weaker),
    "largest_margin": Aim(lambda one: one.margin, _safer),
}


def improved(search: Search, found: Candidate, objective: str) -> Candidate:
    """The best cycle of an objective that a few steps lead to.

    Args:
        search: Where it is searched.
        found: A cycle that keeps its limits.
        objective: One of :data:`AIMS`.
    """
    aim, share, tried, anew = AIMS[objective], _FIRST, 0, 0
    while tried < STEPS:
        if share <= _FINE:
            anew += 1
            there = _elsewhere(search, found, aim) if anew <= _OFTEN else None
            if there is None:
                break
            found, share = search.noted(there), _ANEW
        tried += 1
        request = aim.tightened(found.request, share)
        try:
            there = search.solved(request, found.known, most=_MOST)
        except (ThesisPinError, ArithmeticError):
            share *= _SLOWER
            continue
        if there.kept:
            found, share = search.noted(there), share * _FASTER
        else:
            share *= _SLOWER
    return found


def _elsewhere(search: Search, found: Candidate, aim: Aim) -> Candidate | None:
    return search.elsewhere(aim.tightened(found.request, _ANEW), found.known.step_length)
