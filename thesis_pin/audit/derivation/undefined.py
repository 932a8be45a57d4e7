"""Lines that can't be judged, as a symbol in them is said nowhere."""

from __future__ import annotations

from dataclasses import replace

from thesis_pin.audit.residuals import TROUBLES, residual
from thesis_pin.audit.rows import HOLDS, Row
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment, evaluate
from thesis_pin.equations.formula import Undefined


def undefined(equation: Equation, equations: Catalogue, environment: Environment) -> str:
    """Which symbols of a line nobody says the meaning of; empty if it fails without them, too."""
    without, known = [], []
    for text in dict.fromkeys((equation.left, *equation.printed)):
        told = _undefined(text, equations, environment)
        if told:
            without.append(told)
        else:
            known.append(text)
    if not without:
        return ""
    left, *others = known or [""]
    if others and residual(equations, equation, others, environment, left).value >= HOLDS:
        return ""
    return "; ".join(dict.fromkeys(without))


def _undefined(text: str, equations: Catalogue, environment: Environment) -> str:
    node = equations.parse(text)
    try:
        for indices in equations.indices(node):
            evaluate(node, environment, indices)
    except Undefined as error:
        return error.what
    except TROUBLES:
        pass
    return ""


def undecided(row: Row, symbols: str) -> Row:
    """A failing row as one that says nothing of the print."""
    return replace(
        row,
        verdict="not checkable",
        reason=f"stated, not checkable: {symbols}",
        check="",
        residual_printed=None,
        kinds=(),
        places=(),
        slips=(),
        effect={},
        no_effect="",
        severity="",
    )
