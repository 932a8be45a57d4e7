"""Generalized forces as a derivation's file gives them: 0 of a passive joint, friction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from thesis_pin.audit.derivation.moving.driven import Law
from thesis_pin.audit.derivation.moving.states import States
from thesis_pin.audit.derivation.references import References
from thesis_pin.audit.derivation.said.file import DerivationFile
from thesis_pin.audit.derivation.said.glossary import Glossary
from thesis_pin.audit.judging.residuals import TROUBLES, what
from thesis_pin.equations.catalogue import Catalogue
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.errors import BadInput, UnknownName


def forces(
    file: DerivationFile, glossary: Glossary, equations: Catalogue, where: str, states: States
) -> tuple[Sequence[int], Law]:
    """Numbers of the coordinates whose forces a file gives, and these forces.

    Args:
        file: The derivation.
        glossary: What its letters stand for.
        equations: Its equations, which may say what letters of the forces are.
        where: The file, for messages.
        states: Some states, to try the formulas at.

    Raises:
        UnknownName: A key isn't a coordinate.
        BadInput: A formula can't be read, or needs accelerations or forces.
    """
    numbers, nodes = [], []
    for text, said in file.forces.items():
        place = f"{where}: forces.{text}"
        key = _formula(text, equations, place)
        found = glossary.find(key) if isinstance(key, Symbol) else None
        if found is None or found not in glossary.coordinates:
            raise UnknownName("coordinate", text, list(file.coordinates), where=place)
        numbers.append(glossary.coordinates[found])
        nodes.append(_formula(str(said), equations, place))

    def law(here: States) -> np.ndarray:
        known = References(here, glossary, equations)
        found = [evaluate(node, known, {}).array for node in nodes]
        return np.stack([np.broadcast_to(one, here.x.shape[:1]) for one in found], axis=-1)

    for (text, said), node in zip(file.forces.items(), nodes, strict=True):
        place = f"{where}: forces.{text}"
        ends = []
        for one in (states, replace(states, a=-states.a)):
            try:
                value = evaluate(node, References(one, glossary, equations), {})
            except TROUBLES as error:
                raise BadInput(f"{said!r}: {what(error)}", where=place) from None
            if value.rank > 0:
                raise BadInput(f"{said!r} is {value.describe()}", where=place, allowed="a number")
            ends.append(value.array)
        if not np.array_equal(ends[0], ends[1]):
            raise BadInput(
                f"{said!r} depends on accelerations, or on forces that do",
                where=place,
                allowed="a formula of coordinates, rates and constants",
            )
    return numbers, law


def _formula(text: str, equations: Catalogue, where: str) -> Node:
    try:
        (node,) = equations.notation.parse(text.lstrip().removeprefix("="))
    except (FormulaError, ValueError) as error:
        raise BadInput(f"{text!r} can't be read: {error}", where=where) from None
    return node
