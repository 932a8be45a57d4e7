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

import numpy as np

from thesis_pin.audit import kinds, places
from thesis_pin.audit.reading import Reading
from thesis_pin.audit.rows import HOLDS, Effect, Row, Verdict
from thesis_pin.equations import frames
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment, Unframed, evaluate
from thesis_pin.equations.formula import FormulaError, FrameError
from thesis_pin.equations.values import Value
from thesis_pin.errors import BadInput

_FLOOR = 1e-3  # what counts as zero is zero against this
_OTHER_FRAME = 1.0
"""Residual of a member seen from another frame whose numbers happen to agree."""

TROUBLES = (BadInput, ValueError, ArithmeticError, LookupError, RecursionError)
"""What a line that can't be read or evaluated raises: it is that line's error alone."""


def what(error: Exception) -> str:
    """Why a line can't be evaluated, in words."""
    return error.what if isinstance(error, BadInput) else f"can't be evaluated: {error}"


@dataclass(frozen=True)
class Residual:
    """How far a formula is from what it must equal.

    Attributes:
        value: Largest difference over all states, relative to the larger side;
            infinity if the formula can't be evaluated, 1 if nothing but its frames differ.
        members: The same for each member.
        reason: Why it can't be evaluated.
    """

    value: float
    members: tuple[float, ...] = ()
    reason: str = ""


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


def difference(left: Value, right: Value) -> float:
    """Largest difference of two values, relative to the larger of them.

    Raises:
        FormulaError: They have different shapes, or are seen from different frames.
    """
    if min(left.rank, right.rank) >= 0 and (left.rank != right.rank or left.tail != right.tail):
        raise FormulaError(f"is {right.describe()} where {left.describe()} belongs")
    if not frames.same(left.frames, right.frames):
        raise FrameError(f"is {right.seen()} where {left.seen()} belongs")
    gap = float(np.abs(left.array - right.array).max())
    if not math.isfinite(gap):
        raise FormulaError("isn't finite")
    return gap / max(float(np.abs(left.array).max()), float(np.abs(right.array).max()), _FLOOR)


def largest_relative(found: np.ndarray, truth: np.ndarray) -> float:
    """Largest error of a state, relative to that state's largest entry; states come first."""
    axes = tuple(range(1, truth.ndim))
    return float((np.abs(found - truth).max(axis=axes) / np.abs(truth).max(axis=axes)).max())


def residual(
    catalogue: Catalogue,
    equation: Equation,
    members: Sequence[str],
    environment: Environment,
    left: str,
) -> Residual:
    """How far members are from the left side, symbols taken from the environment."""
    values, reasons = [], []
    for number, member in enumerate(members, start=1):
        if number in equation.imposes:
            continue
        try:
            values.append(max(_member(catalogue, left, member, environment)))
        except TROUBLES as error:
            values.append(_without_frames(catalogue, left, member, environment, error))
            reasons.append(f"member {number} {what(error)}" if len(members) > 1 else what(error))
    return Residual(max(values, default=math.inf), tuple(values), "; ".join(reasons))


def _without_frames(
    catalogue: Catalogue, left: str, member: str, environment: Environment, error: Exception
) -> float:
    """Residual of a member that raised: of its numbers, if only its frames don't fit."""
    if not isinstance(error, FrameError):
        return math.inf
    try:
        found = max(_member(catalogue, left, member, Unframed(environment)))
    except TROUBLES:
        return math.inf
    return found if found > HOLDS else _OTHER_FRAME


def _member(
    catalogue: Catalogue, left: str, member: str, environment: Environment
) -> Iterator[float]:
    if not member:
        raise FormulaError("is empty")
    sides = catalogue.parse(left), catalogue.parse(member)
    for indices in catalogue.indices(*sides):
        first, second = (evaluate(side, environment, indices) for side in sides)
        yield difference(first, second)


def residual_as_said(
    catalogue: Catalogue,
    equation: Equation,
    members: Sequence[str],
    environments: Sequence[Environment],
    left: str,
) -> Residual:
    """How far members are from the left side in the first environment where they don't hold."""
    found = Residual(math.inf)
    for environment in environments:
        found = residual(catalogue, equation, members, environment, left)
        if found.value >= HOLDS:
            break
    return found


def judge(
    catalogue: Catalogue,
    equation: Equation,
    environment: Environment,
    claims: Claims,
    thesis: str,
    substituted: Environment | None = None,
) -> Row:
    """The audit's answer on one equation.

    Args:
        catalogue: The equations.
        equation: The one to judge.
        environment: What its symbols must equal.
        claims: Checks in code.
        thesis: What it is called.
        substituted: What its symbols are where what it takes as given is free, if the line
            is a substitution: it then has to hold there too.
    """
    number = f" ({', '.join(equation.number)})" if equation.number else ""
    row = Row(
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
    if equation.illegible:
        return _lost(catalogue, equation, environment, row)
    if equation.not_checkable:
        return _with(row, reason=equation.not_checkable)
    if equation.claim:
        reading = Reading.of(equation)
        try:
            result = _claim(claims, equation)(reading)
        except TROUBLES as error:
            return _with(row, check=equation.claim, verdict="unexplained", reason=what(error))
        answer = verdict(result.printed, result.corrected, physical=bool(equation.right))
        if reading.unread and answer == "holds":
            unread = ", ".join(map(str, reading.unread))
            reason = f"the check doesn't read member {unread}, and what isn't read can't hold"
            return _with(row, check=equation.claim, verdict="unexplained", reason=reason)
        return _with(
            row,
            check=equation.claim,
            verdict=answer,
            kinds=_kinds(equation, answer),
            residual_printed=result.printed,
            residual_corrected=result.corrected,
            reason=result.note,
            effect=result.effect,
            places=tuple(_places(equation)),
        )
    grounds = (environment, substituted) if substituted else (environment,)
    printed = residual_as_said(catalogue, equation, equation.printed, grounds, row.left)
    mended = None
    if equation.mending or equation.left_printed:
        members = equation.members("corrected")
        mended = residual_as_said(catalogue, equation, members, grounds, equation.left)
    answer = verdict(printed.value, mended.value if mended else None, physical=bool(equation.right))
    return _with(
        row,
        check="identity",
        verdict=answer,
        kinds=_kinds(equation, answer),
        residual_printed=printed.value,
        residual_corrected=mended.value if mended else None,
        reason=printed.reason or (mended.reason if mended else ""),
        places=tuple(_places(equation)),
    )


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
