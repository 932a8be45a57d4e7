"""How much a failing line matters: whether following it changes a result, and if not, why."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from thesis_pin.audit.comparison.places import pieces
from thesis_pin.audit.rows import HOLDS, Effect, Row, Severity
from thesis_pin.equations.catalogue import Equation


def without_effect(
    equation: Equation, row: Row, effect: Effect, users: Callable[[], Sequence[str]]
) -> str:
    """Why following a failing line changes nothing that is measured; "" if it does.

    Args:
        equation: The failing one.
        row: The audit's answer on it.
        effect: What following its print does.
        users: Ids of the lines that use it.
    """
    if any(isinstance(value, str) or value > 0 for value in effect.values()):
        return ""
    if equation.no_effect:
        return equation.no_effect
    if effect:
        return "the law of motion rests on it, and comes out the same with the line as printed"
    if equation.claim:
        return "a check in code decides it, and measures no effect"
    using = users()
    if not using:
        return "no other line uses what it defines"
    if row.residual_printed == math.inf:
        return "it can't be computed as printed, and what uses it is measured by no effect"
    named = ", ".join(name.split(":", 1)[1] for name in using[:_NAMED])
    more = f" and {len(using) - _NAMED} more" if len(using) > _NAMED else ""
    return f"the law of motion takes no value from it; {named}{more} do"


_NAMED = 3
"""Lines that a reason names; the rest are counted."""


def severity(row: Row, effect: Effect, nothing: str) -> Severity:
    """Whether a failing line gives another number to who follows it, or none at all.

    A right formula under a wrong name gives the right number. A line that can't be computed
    gives another one where, with what can't be read mended, a slip of it remains that does.
    """
    if not nothing and effect:
        return "changes a result"
    if set(row.corrected) == {0} and len(pieces(row.left)[0]) == 1:
        return "notation only"
    alone = [slip.residual for slip in row.slips if slip.member]
    found = [value for value in (row.residual_printed, *alone) if value is not None]
    finite = any(HOLDS <= value < math.inf for value in found)
    return "changes a result" if finite else "notation only"
