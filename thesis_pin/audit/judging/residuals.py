"""How far a printed formula is from what it must equal, at all states of an environment."""

from __future__ import annotations

import math
import weakref
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations import frames
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment, Unframed, evaluate
from thesis_pin.equations.formula import FormulaError, FrameError, Node
from thesis_pin.equations.values import Value, apart
from thesis_pin.errors import BadInput

_FLOOR = 1e-3  # what counts as zero is zero against this
_VANISHED = 1e-12  # of a formula's largest value: what is smaller says nothing of its usual size
_OTHER_FRAME = 1.0
"""Residual of a member seen from another frame whose numbers happen to agree."""

_VANISHES = "holds only because something in it vanishes: not as the substitution that it is"

_ITSELF = "says only that its left side is what it is"

TROUBLES = (BadInput, ValueError, ArithmeticError, LookupError, RecursionError)
"""What a line that can't be read or evaluated raises: it is that line's error alone."""


def what(error: Exception) -> str:
    """Why a line can't be evaluated, in words."""
    return error.what if isinstance(error, BadInput) else f"can't be evaluated: {error}"


Known = dict[tuple[int, str, str], tuple[float, str]]
"""What members of a line came to while its environments live: id of the environment, left side,
member → residual, why it can't be evaluated. A line as printed, as corrected and with one slip
alone has most members in common."""


@dataclass(frozen=True)
class Residual:
    """How far a formula is from what it must equal.

    Attributes:
        value: Largest difference over all states, see :func:`difference`;
            infinity if the formula can't be evaluated, 1 if nothing but its frames differ.
        members: The same for each member.
        reason: Why it can't be evaluated.
    """

    value: float
    members: tuple[float, ...] = ()
    reason: str = ""


def difference(left: Value, right: Value) -> float:
    """Largest difference of two values, relative to the larger of them where it is found.

    Near a singularity a formula grows a millionfold: against that, a term that is missing at all
    other states would look like rounding. Where a formula cancels, rounding alone is as large as
    what is left. So at each state, and for each coordinate, a difference is held against the
    larger value there, or against the median of all where that is larger still.

    Raises:
        FormulaError: They have different shapes, or are seen from different frames.
    """
    gap, size = _apart(left, right)
    there = size[size > _VANISHED * size.max()]
    usual = max(float(np.median(there)) if there.size else 0.0, _FLOOR)
    return float((gap / np.maximum(size, usual)).max())


def change(left: Value, right: Value) -> float:
    """Largest difference of two values, relative to the largest of all: what an effect is.

    Raises:
        FormulaError: They have different shapes, or are seen from different frames.
    """
    gap, size = _apart(left, right)
    return float(gap.max()) / max(float(size.max()), _FLOOR)


def _apart(left: Value, right: Value) -> tuple[np.ndarray, np.ndarray]:
    """Largest difference and largest entry of two values at each state, without their tails."""
    if min(left.rank, right.rank) >= 0 and (left.rank != right.rank or left.tail != right.tail):
        raise FormulaError(f"is {right.describe()} where {left.describe()} belongs")
    if not frames.same(left.frames, right.frames):
        raise FrameError(f"is {right.seen()} where {left.seen()} belongs")
    gap = np.abs(apart(left, right))
    if not np.isfinite(gap).all():
        raise FormulaError("isn't finite")
    tail = tuple(range(-max(left.rank, right.rank, 0), 0))
    size = np.maximum(np.abs(left.array), np.abs(right.array))
    return gap.max(axis=tail), size.max(axis=tail)


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
    only: tuple[int, ...] = (),
    known: Known | None = None,
) -> Residual:
    """How far members, or some of them, are from the left side by an environment's symbols.

    Args:
        catalogue: The equations.
        equation: The line.
        members: Its members.
        environment: What their symbols are.
        left: Its left side.
        only: Numbers of the members to compare; () for all.
        known: Where to note what each member came to, and to look it up.
    """
    values, reasons = [], []
    known = {} if known is None else known
    for number, member in enumerate(members, start=1):
        if number in equation.imposes or (only and number not in only):
            continue
        try:
            if only:
                _refuse_repetition(catalogue, (left, *members[: number - 1]), member)
        except TROUBLES as error:
            value, reason = math.inf, what(error)
        else:
            key = id(environment), left, member
            if key not in known:
                known[key] = _compared(catalogue, left, member, environment)
            value, reason = known[key]
        values.append(value)
        if reason:
            reasons.append(f"member {number} {reason}" if len(members) > 1 else reason)
    return Residual(max(values, default=math.inf), tuple(values), "; ".join(reasons))


def _compared(
    catalogue: Catalogue, left: str, member: str, environment: Environment
) -> tuple[float, str]:
    """Residual of a member, and why it can't be evaluated."""
    try:
        return max(_member(catalogue, left, member, environment)), ""
    except TROUBLES as error:
        return _without_frames(catalogue, left, member, environment, error), what(error)


def _refuse_repetition(catalogue: Catalogue, before: Sequence[str], member: str) -> None:
    """A series that says one thing twice leaves out what should stand there."""
    node = catalogue.parse(member) if member else None
    if any(text and catalogue.parse(text) == node for text in before):
        raise FormulaError("says what the line has said before")


def _says_itself(catalogue: Catalogue, left: str, member: str) -> bool:
    """Whether both sides of a line are one formula: true of anything, so it says nothing."""
    try:
        return catalogue.parse(left) == catalogue.parse(member)
    except FormulaError:
        return False


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
        first = _left(left, sides[0], environment, indices)
        yield difference(first, evaluate(sides[1], environment, indices))


_lefts: dict[tuple[object, ...], tuple[weakref.ref[Environment], Value]] = {}
"""Left sides evaluated last: a line's members and slips are all held against one."""
_KEPT = 24


def _left(text: str, node: Node, environment: Environment, indices: dict[str, str]) -> Value:
    key = (id(environment), text, node, *indices.items())
    kept = _lefts.pop(key, None)
    if kept is None or kept[0]() is not environment:  # another one, where a dead one was
        while len(_lefts) >= _KEPT:
            _lefts.pop(next(iter(_lefts)), None)
        kept = weakref.ref(environment), evaluate(node, environment, indices)
    _lefts[key] = kept
    return kept[1]


@dataclass(frozen=True)
class Free:
    """Where what a line takes as given is free, so that nothing vanishes.

    Attributes:
        environment: What its symbols are there.
        members: Numbers of the members that are the same there as well; () for all.
    """

    environment: Environment
    members: tuple[int, ...] = ()


def residual_as_said(
    catalogue: Catalogue,
    equation: Equation,
    members: Sequence[str],
    environment: Environment,
    left: str,
    free: Sequence[Free] = (),
    known: Known | None = None,
) -> Residual:
    """How far members are from the left side where they have to hold, or else where all is free.

    Args:
        catalogue: The equations.
        equation: The line.
        members: Its members.
        environment: What their symbols are.
        left: Its left side.
        free: What they are where nothing vanishes.
        known: Where to note what each member came to, and to look it up.
    """
    if len(members) == 1 and _says_itself(catalogue, left, members[0]):
        return Residual(math.inf, (math.inf,), _ITSELF)
    found = residual(catalogue, equation, members, environment, left, known=known)
    for ground in free:
        if found.value >= HOLDS:
            break
        other = residual(
            catalogue, equation, members, ground.environment, left, ground.members, known
        )
        if other.members:
            found = (
                other if other.value < HOLDS else replace(other, reason=other.reason or _VANISHES)
            )
    return found
