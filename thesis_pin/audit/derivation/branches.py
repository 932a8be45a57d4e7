"""Lines that hold on one branch: an inverse function or a root gives one of several angles."""

from __future__ import annotations

import numpy as np

from thesis_pin.audit.derivation.references import References
from thesis_pin.audit.judging.residuals import TROUBLES
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import functions
from thesis_pin.equations.values import Value, apart

_BRANCHED = frozenset({"atan2", "arctan", "arcsin", "arccos", "sqrt"})
_TOLD = (
    "it holds at {some} of {all} states: its inverse function or root gives one of several "
    "branches, or expects another sign of a length"
)


def branch(equation: Equation, catalogue: Catalogue, references: References) -> str:
    """That a failing line holds at some states, in words; empty if at none, or nothing branches.

    States that move a single coordinate don't count: much vanishes there.
    """
    states = references.states
    count = len(states.x) - states.coordinates.count
    holds = np.ones(count, dtype=bool)
    try:
        left, *members = (catalogue.parse(text) for text in (equation.left, *equation.printed))
        if not functions(members) & _BRANCHED:
            return ""
        for member in members:
            for indices in catalogue.indices(left, member):
                first = evaluate(left, references, indices)
                holds &= _holding(first, evaluate(member, references, indices), count)
    except TROUBLES:
        return ""
    return _TOLD.format(some=holds.sum(), all=count) if 0 < holds.sum() < count else ""


def _holding(first: Value, second: Value, count: int) -> np.ndarray:
    """Where two values agree, shape ``(count,)``."""
    gap = np.abs(apart(first, second))
    size = max(float(np.nanmax(np.abs(one.array), initial=0.0)) for one in (first, second))
    axes = tuple(range(gap.ndim - max(first.rank, second.rank, 0), gap.ndim))
    off = np.broadcast_to(gap.max(axis=axes), (max(count, *gap.shape[:1]),))[:count]
    return np.asarray(off <= HOLDS * size)
