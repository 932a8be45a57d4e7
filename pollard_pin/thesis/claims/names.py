"""Checks of sentences that name symbols: whether they are the ones meant."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace

from pollard_pin.thesis.claims.given import Check, names_in
from pollard_pin.thesis.references import References
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError

_OTHER = math.inf  # a name that isn't the one meant is no value that is off by so much


def _named(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """Each name stands in the numbered line that its sentence speaks of, and once in the list."""
    number = equation.claim.split(":")[1]
    spoken_of = [one for one in catalogue.equations if number in one.number]
    if not spoken_of:
        raise FormulaError(f"speaks of ({number}), which isn't transcribed")
    there = {
        replace(symbol, kept="").name + "." * symbol.dots
        for line in spoken_of
        for member in line.members("corrected")
        for symbol in nt.symbols(catalogue.parse(member))
    }

    def residual(text: str) -> float:
        counted = Counter(names_in(catalogue, text))
        right = set(counted) <= there and max(counted.values()) == 1
        return 0.0 if right else _OTHER

    printed = max(residual(text) for text in equation.printed)
    mended = [residual(text) for text in equation.members("corrected")] if equation.mending else []
    note = f"({number}) has these names, each is said once" if not printed else ""
    return ClaimResult(printed, max(mended, default=None), note=note)


CHECKS: Mapping[str, Check] = {"named": _named}
"""Checks by the first part of a claim's name."""
