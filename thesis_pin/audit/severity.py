"""How much a failing line matters: whether following it changes a result, and if not, why."""

from __future__ import annotations

import math

from thesis_pin.audit.rows import HOLDS, Effect, Row, Severity
from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError, Symbol


def without_effect(equations: Catalogue, equation: Equation, row: Row, effect: Effect) -> str:
    """Why following a failing line changes nothing that is measured; "" if it does.

    Args:
        equations: All equations of the thesis.
        equation: The failing one.
        row: The audit's answer on it.
        effect: What following its print does.
    """
    if any(isinstance(value, str) or value > 0 for value in effect.values()):
        return ""
    if equation.no_effect:
        return equation.no_effect
    if effect:
        return "the law of motion rests on it, and comes out the same with the line as printed"
    if equation.claim:
        return "a check in code decides it, which measures no effect"
    using = users(equations, equation)
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
    """Whether a failing line gives another number to who follows it, or none at all."""
    if not nothing and effect:
        return "changes a result"
    finite = row.residual_printed is not None and HOLDS <= row.residual_printed < math.inf
    return "changes a result" if finite else "notation only"


def users(equations: Catalogue, equation: Equation) -> list[str]:
    """Ids of the other lines with the symbol that a line defines."""
    try:
        left = equations.parse(equation.left)
    except FormulaError:
        return []
    node = left.of if isinstance(left, nt.Derivative) else left
    node = node.of if isinstance(node, nt.Transpose) else node
    if not isinstance(node, Symbol):
        return []
    own = {node.bound(indices).name for indices in equations.indices(node)}
    found = []
    for other, names in equations.used_names.items():
        if other != equation.id and own & names:
            found.append(other)
    return found
