"""Numbers, vectors, matrices and pieces of functions as the thesis prints them.

A text is read whole or not at all, so that whatever is changed in it is either
another number or no longer readable.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from thesis_pin.audit.judging.verdicts import ClaimResult, difference
from thesis_pin.equations.catalogue import Catalogue, Equation, index_values
from thesis_pin.equations.evaluation import Environment, evaluate
from thesis_pin.equations.formula import FormulaError

_DIGITS = r"\d+(?:\.\d*)?"
_POWER = r"(?:\s*\\times\s*10\^\{(?P<power>-?\d+)\})?"
_UNIT = r"(?:\s*\[(?:\\text\{)?(?:mm|m|kg)\}?\]|\s*\^\\circ)?"
_QUANTITY = re.compile(rf"\s*(?P<number>[+-]?\s*{_DIGITS}){_POWER}{_UNIT}\s*")
_COMPONENT = re.compile(rf"\s*([+-]?)\s*({_DIGITS}){_POWER}\s*(?:\\,\s*)?\\mathbf\{{([ijk])\}}")
_LABEL = re.compile(r"_\{?(?P<label>\w+)\}?\s*")
# A term of a printed polynomial: sign, coefficient (decimal or \frac), power of t.
_TERM = re.compile(rf"\s*([+-]?)\s*(?:\\frac\{{(\d+)\}}\{{(\d+)\}}|({_DIGITS}))?\s*(t\^2|t)?")
_INTERVAL = re.compile(r"\s*(\d+)\s*(<|\\leq)\s*t(?:\s*(<|\\leq)\s*(\d+))?\s*")

Check = Callable[[Equation], ClaimResult]


def unreadable(what: str) -> FormulaError:
    """The error for a text that isn't what its check can evaluate."""
    return FormulaError(f"can't be read: {what!r}")


def half_digit(text: str) -> float:
    """Half the last printed digit of a decimal number."""
    return 0.5 * 10.0 ** -len(text.partition(".")[2])


def quantity(text: str) -> tuple[float, float]:
    """A number with its unit, ``44.54 \\times 10^{-3} [m]``: its value and half its last digit."""
    found = _QUANTITY.fullmatch(text)
    if not found:
        raise unreadable(text)
    number = found["number"].replace(" ", "")
    scale = 10.0 ** int(found["power"] or 0)
    return float(number) * scale, half_digit(number) * scale


def components(text: str, label: str) -> np.ndarray:
    """A vector in the axes of a frame: ``2 \\times 10^{-3} \\mathbf{i}_1 - …``, shape ``(3,)``.

    Args:
        text: The sum, each axis at most once.
        label: Subscript of the axes; "" for none.
    """
    values, at = np.zeros(3), 0
    while at < len(text.rstrip()):
        found = _COMPONENT.match(text, at)
        if not found or (at and not found[1]):
            raise unreadable(text)
        at = found.end()
        if label:
            frame = _LABEL.match(text, at)
            if not frame or frame["label"] != label:
                raise unreadable(text)
            at = frame.end()
        k = "ijk".index(found[4])
        if values[k]:
            raise unreadable(text)
        value = float(found[2]) * 10.0 ** int(found["power"] or 0)
        values[k] = -value if found[1] == "-" else value
    return values


def array(text: str) -> np.ndarray:
    """A matrix of numbers in ``bmatrix``."""
    inside = re.fullmatch(r"\s*\\begin\{bmatrix\}(.*)\\end\{bmatrix\}\s*", text)
    if not inside:
        raise unreadable(text)
    rows = [[quantity(cell)[0] for cell in row.split("&")] for row in inside[1].split(r"\\")]
    if len({len(row) for row in rows}) > 1:
        raise unreadable(text)
    return np.array(rows)


def points(text: str) -> np.ndarray:
    """Points of a plane, ``(44.33, 83.33), (15.7, 83.33), …``, shape ``(N, 2)``."""
    pair = rf"\(\s*(-?{_DIGITS})\s*,\s*(-?{_DIGITS})\s*\)"
    if not re.fullmatch(rf"\s*{pair}(?:\s*,\s*{pair})*\s*", text):
        raise unreadable(text)
    return np.array([[float(x), float(y)] for x, y in re.findall(pair, text)])


# -- functions by pieces ----------------------------------------------------------


@dataclass(frozen=True)
class Piece:
    """One piece of a printed function of t.

    Attributes:
        start, end: Its interval; the end may be infinite.
        closed: Whether the interval has its start and its end.
        coefficients: Of t², t, 1.
        half: Half their last digit; 0 of a fraction or a whole number.
    """

    start: float
    end: float
    closed: tuple[bool, bool]
    coefficients: np.ndarray
    half: np.ndarray

    def has(self, t: np.ndarray) -> np.ndarray:
        """Which instants the interval has."""
        after = t >= self.start if self.closed[0] else t > self.start
        return np.asarray(after & (t <= self.end if self.closed[1] else t < self.end))

    def value(self, t: np.ndarray) -> np.ndarray:
        """The polynomial at instants, inside the interval or not."""
        return np.asarray(np.polyval(self.coefficients, t))

    def rounding(self, t: np.ndarray) -> np.ndarray:
        """What the digits left out can change."""
        return np.asarray(np.polyval(self.half, np.abs(t)))


def pieces(formula: str) -> list[Piece]:
    """The pieces of a function in ``cases``: ``2t + 1; & 0 \\leq t < 15 \\\\ …``."""
    inside = re.fullmatch(r"\s*\\begin\{cases\}(.*)\\end\{cases\}\s*", formula)
    if not inside:
        raise unreadable(formula)
    found = []
    for line in inside[1].split(r"\\"):
        text, separator, interval = line.partition(r"; &")
        bounds = _INTERVAL.fullmatch(interval)
        if not separator or not bounds:
            raise unreadable(line)
        closed = bounds[2] == r"\leq", bounds[3] == r"\leq"
        end = float(bounds[4]) if bounds[4] else np.inf
        found.append(Piece(float(bounds[1]), end, closed, *polynomial(text)))
    return found


def polynomial(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of t², t, 1 and half their last digit."""
    values, half, at, seen = np.zeros(3), np.zeros(3), 0, set()
    text = text.strip()
    while at < len(text):
        found = _TERM.match(text, at)
        if not found or not (found[2] or found[4] or found[5]) or (at and not found[1]):
            raise unreadable(text)
        sign, above, below, decimal, power = found.groups()
        k = {"t^2": 0, "t": 1, None: 2}[power]
        if k in seen:
            raise unreadable(text)
        seen.add(k)
        value = float(above) / float(below) if above else float(decimal or 1)
        values[k] = -value if sign == "-" else value
        half[k] = half_digit(decimal) if decimal and "." in decimal else 0.0
        at = found.end()
    if not seen:
        raise unreadable(text)
    return values, half


def at(found: list[Piece], t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A function by pieces at instants, and what its rounding can change.

    Not-a-number where no piece has the instant; where two have it, the first.
    """
    value, rounding = np.full(t.shape, np.nan), np.zeros(t.shape)
    for piece in reversed(found):
        inside = piece.has(t)
        value[inside], rounding[inside] = piece.value(t[inside]), piece.rounding(t[inside])
    return value, rounding


def beyond(error: np.ndarray | float, allowed: np.ndarray | float, scale: float) -> float:
    """What an error exceeds rounding by, relative to a scale."""
    return float(np.max(np.maximum(np.abs(error) - allowed, 0.0), initial=0.0)) / scale


# -- verdicts from texts ----------------------------------------------------------


def identity(catalogue: Catalogue, left: str, member: str, environment: Environment) -> float:
    """Largest difference of two formulas at an environment's states, relative."""
    sides = catalogue.parse(left), catalogue.parse(member)
    return max(
        difference(*(evaluate(side, environment, indices) for side in sides))
        for indices in index_values(*sides)
    )


def both(equation: Equation, residual: Callable[[str, str], float], note: str = "") -> ClaimResult:
    """The result of a check that gives a residual for each member's text.

    The correction, if there is one, goes through the same check.

    Args:
        equation: The equation.
        residual: Text of a member and of the left side → the member's residual.
        note: The finding in words.
    """
    reasons: list[str] = []

    def largest(texts: tuple[str, ...], left: str) -> float:
        worst = 0.0
        for text in texts:
            try:
                worst = max(worst, residual(text, left))
            except FormulaError as error:
                worst = np.inf
                reasons.append(error.what)
        return worst

    mended = None
    if equation.mending or equation.left_printed:
        mended = largest(equation.members("corrected"), equation.left)
        reasons.clear()
    printed = largest(equation.printed, equation.left_printed or equation.left)
    return ClaimResult(printed, mended, "; ".join([*reasons, note] if note else reasons))


def statements(check: Callable[[], ClaimResult], wrong: str, right: str) -> Check:
    """A check of a statement in words: whichever of two it is, its residual was worked out.

    Args:
        check: Finds the residuals of both; run once.
        wrong: Pattern of the thesis's statement.
        right: Pattern of the one that holds.
    """
    once = functools.cache(check)

    def judged(equation: Equation) -> ClaimResult:
        result = once()

        def residual(text: str, left: str) -> float:
            if re.fullmatch(wrong, text):
                return result.printed
            if not re.fullmatch(right, text) or result.corrected is None:
                raise unreadable(text)
            return result.corrected

        found = both(equation, residual, result.note)
        return replace(found, effect=result.effect)

    return judged
