"""Verdicts on printed equations, computed from residuals.

A member of an equation is evaluated with every symbol taken from the
references, so an error is counted once, where it stands. What the print does
to a reader who follows it is a second number, the effect, and comes from the
robot's own audit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from thesis_pin.audit.comparison import kinds, places
from thesis_pin.audit.judging import single
from thesis_pin.audit.judging.reading import Reading
from thesis_pin.audit.judging.residuals import (
    TROUBLES,
    Free,
    Known,
    Residual,
    residual_as_said,
    what,
)
from thesis_pin.audit.judging.residuals import difference as difference
from thesis_pin.audit.judging.residuals import largest_relative as largest_relative
from thesis_pin.audit.judging.residuals import residual as residual
from thesis_pin.audit.rows import HOLDS, Effect, Row, Verdict
from thesis_pin.audit.slips import Slip
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment
from thesis_pin.equations.formula import FormulaError


@dataclass(frozen=True)
class ClaimResult:
    """What a check in code finds.

    Attributes:
        printed: Residual of the printed statement.
        corrected: Residual of what should stand there; None if it holds as printed.
        note: The finding in words.
        effect: What following the print does.
    """

    printed: float
    corrected: float | None = None
    note: str = ""
    effect: Effect = field(default_factory=dict)


Claims = Mapping[str, Callable[[Equation], ClaimResult]]
"""Checks in code by name; each gets its equation and evaluates what is printed there."""


def verdict(printed: float, mended: float | None, *, physical: bool) -> Verdict:
    """The verdict that residuals give.

    Args:
        printed: Residual of the print.
        mended: Residual of what is given in its place, if anything is.
        physical: Whether the replacement is another statement, not another spelling.
    """
    if printed < HOLDS:
        return "holds"
    if mended is not None and mended < HOLDS:
        return "wrong" if physical else "misprint"
    return "unexplained"


def judge(
    catalogue: Catalogue,
    equation: Equation,
    environment: Environment,
    claims: Claims,
    thesis: str,
    free: Sequence[Free] = (),
) -> Row:
    """The audit's answer on one equation.

    Args:
        catalogue: The equations.
        equation: The one to judge.
        environment: What its symbols must equal.
        claims: Checks in code.
        thesis: What it is called.
        free: What its symbols are where what it takes as given is free, if the line is a
            substitution: it then has to hold there too.
    """
    row = _unjudged(equation, thesis)
    if equation.illegible:
        return _lost(catalogue, equation, environment, row)
    if equation.not_checkable:
        return _with(row, reason=equation.not_checkable)
    if equation.claim:
        return _claimed(catalogue, equation, claims, row)
    return _compared(catalogue, equation, environment, free, row)


def _unjudged(equation: Equation, thesis: str) -> Row:
    """What a row says of its equation, whatever the answer is."""
    number = f" ({', '.join(equation.number)})" if equation.number else ""
    return Row(
        id=equation.id,
        source=f"{thesis}, {equation.section}{number}",
        number=equation.number,
        left=equation.left_printed or equation.left,
        printed=equation.printed,
        corrected={**({0: equation.left} if equation.left_printed else {}), **equation.mending},
        verdict="not checkable",
        attribution=equation.attribution,
        why=equation.why,
        note=equation.note,
        cause=equation.cause,
        line=equation.line,
        surviving=equation.surviving,
        rebuilt=equation.rebuilt,
    )


def _claimed(catalogue: Catalogue, equation: Equation, claims: Claims, row: Row) -> Row:
    """The answer on a line that a check in code decides."""
    row = _with(row, check=equation.claim, verdict="unexplained")
    reading = Reading.of(equation)
    try:
        result = _claim(claims, equation)(reading)
    except TROUBLES as error:
        return _with(row, reason=what(error))
    answer = verdict(result.printed, result.corrected, physical=bool(equation.right))
    if reading.unread and answer == "holds":
        unread = ", ".join(map(str, reading.unread))
        reason = f"the check doesn't read member {unread}, and what isn't read can't hold"
        return _with(row, reason=reason)

    def alone(changed: Equation) -> float:
        try:
            return _claim(claims, equation)(Reading.of(changed)).printed
        except TROUBLES:
            return math.inf

    return _with(
        row,
        verdict=answer,
        kinds=_kinds(equation, answer),
        residual_printed=result.printed,
        residual_corrected=result.corrected,
        reason=result.note,
        effect=result.effect,
        places=tuple(_places(equation)),
        slips=_slips(catalogue, equation, answer, alone),
    )


def _compared(
    catalogue: Catalogue,
    equation: Equation,
    environment: Environment,
    free: Sequence[Free],
    row: Row,
) -> Row:
    """The answer on a line whose sides are evaluated and compared."""

    known: Known = {}

    def found(one: Equation, members: Sequence[str], left: str) -> Residual:
        return residual_as_said(catalogue, one, members, environment, left, free, known)

    printed, mended = found(equation, equation.printed, row.left), None
    if equation.mending or equation.left_printed:
        mended = found(equation, equation.members("corrected"), equation.left)
    answer = verdict(printed.value, mended.value if mended else None, physical=bool(equation.right))

    def alone(changed: Equation) -> float:
        numbered = enumerate(changed.printed, start=1)
        if not all(catalogue.reads(text) for k, text in numbered if k not in changed.imposes):
            return math.inf
        return found(changed, changed.printed, changed.left).value

    return _with(
        row,
        check="identity",
        verdict=answer,
        kinds=_kinds(equation, answer),
        residual_printed=printed.value,
        residual_corrected=mended.value if mended else None,
        reason=printed.reason or (mended.reason if mended else ""),
        places=tuple(_places(equation)),
        slips=_slips(catalogue, equation, answer, alone),
    )


def _slips(
    catalogue: Catalogue, equation: Equation, answer: Verdict, residual: single.Test
) -> tuple[Slip, ...]:
    """What is wrong with a failing line, each slip by itself; none where nothing mends it."""
    if answer not in ("misprint", "wrong"):
        return ()
    return tuple(single.slips(catalogue, equation, residual))


def _claim(claims: Claims, equation: Equation) -> Callable[[Equation], ClaimResult]:
    if equation.claim not in claims:
        raise FormulaError(f"names no check: {equation.claim!r} isn't one of {', '.join(claims)}")
    return claims[equation.claim]


def _lost(catalogue: Catalogue, equation: Equation, environment: Environment, row: Row) -> Row:
    """The answer on a line that can't be read: what follows for it from the rest, if anything."""
    if not equation.rebuilt:
        return _with(row, verdict="illegible", reason=equation.illegible)
    found = residual(catalogue, equation, equation.rebuilt, environment, equation.left)
    return _with(
        row,
        check="identity",
        verdict="rebuilt" if found.value < HOLDS else "unexplained",
        residual_corrected=found.value,
        reason=found.reason or equation.illegible,
    )


def _kinds(equation: Equation, answer: Verdict) -> tuple[str, ...]:
    """Kinds of a mended slip; none where nothing is mended."""
    return kinds.of_equation(equation) if answer in ("misprint", "wrong") else ()


def _with(row: Row, **changes: Any) -> Row:
    return replace(row, **changes)


def _places(equation: Equation) -> Iterator[str]:
    if equation.left_printed:
        for place in places.places(equation.left_printed, equation.left):
            yield f"left side, {place}"
    for number, text in equation.mending.items():
        if number > len(equation.printed):
            yield f"member {number} is missing: {text}"
            continue
        before = equation.printed[number - 1]
        where = f"member {number}, " if len(equation.printed) > 1 else ""
        found = places.places(before, text) if text else ["should not be there"]
        if equation.right and not _local(found, text):
            yield f"{where or 'the whole '}statement: {text}"
        else:
            yield from (where + place for place in found)


def _local(found: Sequence[str], text: str) -> bool:
    """Whether a statement differs in so little that saying where is shorter than it."""
    named = len(found) <= 2 and all(place.startswith("symbol") for place in found)
    return named and "\\text" not in text and sum(map(len, found)) < len(text)
