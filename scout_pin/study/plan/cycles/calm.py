"""From a cycle that keeps its limits to a calm one: joints that turn no more than they need to.

Limits alone leave a torso free to fidget. Here the joints' rates count beside the limits, less and
less, and after each search for both the limits alone are pressed again: a few short steps.
A step's length stays as it was found: longer ones turn joints less and jolt servos more.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scout_pin.study.plan.cycles.descending import Descending
from scout_pin.study.plan.cycles.search import Candidate, Search
from scout_pin.study.plan.newton import descend
from thesis_pin.errors import ThesisPinError

EFFORTS = (1.0, 0.3)
"""What the joints' rates count beside the limits: where much is too much, little is tried."""

_MOST = 25  # steps of Gauss–Newton with the rates


def effort(found: Candidate) -> float:
    """Root mean square of the joints' rates over a cycle, relative to no-load speed."""
    problem = found.problem
    return float(np.sqrt(np.mean(problem.limits.rates(problem.robot, found.excess).value ** 2)))


def calmed(search: Search, found: Candidate) -> Candidate:
    """The calmest cycle that a few searches lead to, limits kept.

    Args:
        search: Where it is searched.
        found: A cycle that keeps its limits.
    """
    for weight in EFFORTS:
        search.tick()
        length = found.known.step_length
        paced = found.request
        if paced.free_length:
            paced = paced.changed(step_length=length)
        descending = Descending(search.problem(paced), length, weight)
        try:
            start = descending.problem.packed(found.known)
            there = descend(descending, start, most=_MOST)
            known = descending.problem.unpacked(there.x, length)
            search.iterations += there.iterations
            calm = search.solved(paced, known)
        except (ThesisPinError, ArithmeticError):
            continue
        if calm.kept and effort(calm) < effort(found):
            return search.noted(replace(calm, request=found.request))
    return found
