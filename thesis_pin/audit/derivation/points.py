"""Lines that would hold if the robot's bodies had no inertia about their centres of mass."""

from __future__ import annotations

import re

import numpy as np

from thesis_pin.audit.derivation.references import References
from thesis_pin.audit.derivation.said.glossary import Glossary
from thesis_pin.audit.derivation.said.phrases import Phrase
from thesis_pin.audit.judging.residuals import TROUBLES, residual
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import Node, Symbol, symbols

_INERTIAS = ("inertia", "inertia tensor")


def of_points(
    equation: Equation, catalogue: Catalogue, points: References, bodies: References
) -> bool:
    """Whether a failing line holds for point masses, and not as 0 = 0.

    Args:
        equation: The line.
        catalogue: The derivation's equations.
        points: References of a robot of point masses.
        bodies: Those of the robot.
    """
    if residual(catalogue, equation, equation.printed, points, equation.left).value >= HOLDS:
        return False
    left = catalogue.parse(equation.left)
    sides = [left, *(catalogue.parse(text) for text in equation.printed)]
    try:
        return any(
            _largest(side, points, indices) > HOLDS * _largest(side, bodies, indices)
            for side in sides
            for indices in catalogue.indices(*sides)
        )
    except TROUBLES:
        return False


def names_inertia(equation: Equation, catalogue: Catalogue, glossary: Glossary) -> bool:
    """Whether a line has a body's inertia in it, by itself or in what it abbreviates."""
    waiting: list[object] = [catalogue.parse(text) for text in equation.printed]
    seen: set[str] = set()
    while waiting:
        for symbol in symbols(waiting.pop()):
            if symbol.name in seen:
                continue
            seen.add(symbol.name)
            key = glossary.find(symbol)
            if key is None and _indexed(symbol, glossary):
                return True
            if key is None:
                definition = catalogue.defined(symbol)
                if definition is not None:
                    waiting += [catalogue.parse(text) for text in definition[0].printed]
                continue
            given = glossary.constants.get(key) or glossary.symbols.get(key)
            if isinstance(given, Phrase):
                if given.quantity in _INERTIAS:
                    return True
            else:
                waiting.append(given)
    return False


def _indexed(symbol: Symbol, glossary: Glossary) -> bool:
    """Whether one of an inertia's letters is an index, as J_i of J_1 and J_2."""
    if not any(map(str.isalpha, symbol.sub)):
        return False
    pattern = "".join(r"\w" if one.isalpha() else re.escape(one) for one in symbol.sub)
    return any(
        isinstance(given, Phrase)
        and given.quantity in _INERTIAS
        and re.fullmatch(rf"{re.escape(symbol.base)}_{pattern}", name)
        for (name, _), given in glossary.constants.items()
    )


def _largest(side: Node, references: References, indices: dict[str, str]) -> float:
    return float(np.abs(evaluate(side, references, indices).array).max())
