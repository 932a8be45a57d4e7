"""Differences of two printed formulas as data: what to put where, each by itself."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from thesis_pin.audit.comparison.tokens import outermost, tokens

_NESTED = r"\{(?:[^{}]|\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\})*\}"
_INSIDE = r"(?:[^{}]|\{[^{}]*\})*"
_FONT = rf"\\(?:mathbf|boldsymbol|mathbb|mathcal|bm)\s*(?:{_NESTED}|\\[a-zA-Z]+|\w)"
_SCRIPT = rf"\s*[_^]\s*(?:{_NESTED}|\\[a-zA-Z]+|\w)"
_WORD = rf"\\(?:text|operatorname|mathrm)\s*{_NESTED}"
_LETTER = rf"(?:{_FONT}|{_WORD}|\\d?dot\s*(?:{_NESTED}|\\?[a-zA-Z]+)|\\[a-zA-Z]+|[A-Za-z]\d?)"
_PARTIAL = (
    rf"\\frac\s*\{{\s*\\partial(?:{_NESTED}|[^{{}}])*\}}\s*\{{\s*\\partial(?:{_NESTED}|[^{{}}])*\}}"
)
_LAYOUT = r"\\(?:left|right|[bB]igg?[lr]?|c?l?dots)(?![a-zA-Z])\s*\.?|\\[,;!:> ]|\s+"
_ENVIRONMENT = r"\\(?:begin|end)\s*\{\w+\}(?:\{[clr| ]*\})?"
_PIECE = re.compile(
    rf"(?P<layout>{_LAYOUT}|{_ENVIRONMENT})|{_PARTIAL}|\\\\|{_LETTER}'*(?:{_SCRIPT})*'*"
    rf"|\d+(?:\.\d+)?(?:{_SCRIPT})*|\S"
)
_BOLD = re.compile(rf"\\(?:mathbf|boldsymbol|bm)\s*(?:\{{({_INSIDE})\}}|(\\[a-zA-Z]+|\w))")
_AROUND = 3
"""Symbols on each side that are enough to find a place by."""


@dataclass(frozen=True)
class Piece:
    """A symbol of a formula, with its dots, font and scripts.

    Attributes:
        key: What it is compared by: without layout and spaces.
        start, end: Where it stands.
    """

    key: str
    start: int
    end: int


@dataclass(frozen=True)
class Difference:
    """What stands in one formula where the other has something else.

    Attributes:
        number: Number of the first symbol of the print that differs, from 1.
        printed, mended: From where to where, in each formula.
        before, after: Symbols of the print on both sides.
    """

    number: int
    printed: tuple[int, int]
    mended: tuple[int, int]
    before: str
    after: str


def pieces(formula: str, *, fonts: bool = False) -> list[Piece]:
    """The symbols of a formula, layout left out; compared with or without their fonts."""
    return [
        Piece(_key(match[0], fonts), match.start(), match.end())
        for match in _PIECE.finditer(formula)
        if not match["layout"]
    ]


def _key(text: str, fonts: bool) -> str:
    """A symbol without spaces and without braces around a single character."""
    if text in (r"\quad", r"\qquad"):
        return "&"
    text = re.sub(r"\s+", "", text if fonts else _BOLD.sub(r"{\1\2}", text))
    text = re.sub(r"(?<![_^a-zA-Z])\{(\w|\\[a-zA-Z]+)\}", r"\1", text)
    return re.sub(r"(?<=[_^])\{(\w|\\[a-zA-Z]+)\}", r"\1", text)


def differences(printed: str, mended: str) -> Iterator[Difference]:
    """Where two formulas differ, from left to right."""
    for fonts in (False, True):
        first, second = pieces(printed, fonts=fonts), pieces(mended, fonts=fonts)
        matcher = difflib.SequenceMatcher(
            None, [p.key for p in first], [p.key for p in second], autojunk=False
        )
        changes = [change for change in matcher.get_opcodes() if change[0] != "equal"]
        if changes:
            break
    for _, a, b, c, d in changes:
        yield Difference(
            a + 1,
            _span(first, a, b, len(printed)),
            _span(second, c, d, len(mended)),
            _text(printed, first[max(0, a - _AROUND) : a]),
            _text(printed, first[b : b + _AROUND]),
        )


def joined(first: Difference, second: Difference) -> Difference:
    """Two neighbouring differences as one, with what lies between them."""
    return Difference(
        first.number,
        (first.printed[0], second.printed[1]),
        (first.mended[0], second.mended[1]),
        first.before,
        second.after,
    )


def put_back(printed: str, mended: str, one: Difference) -> str:
    """The mended formula with one difference as it is printed."""
    old = printed[one.printed[0] : one.printed[1]]
    return f"{mended[: one.mended[0]]} {old} {mended[one.mended[1] :]}"


def term_of(formula: str, place: int) -> str:
    """Which term of the outermost sum a place belongs to: "term 3 of 8"; "" if there is one."""
    for terms in outermost(tokens(formula)):
        if len(terms) > 1 and terms[0].start <= place <= terms[-1].end:
            number = sum(term.start <= place for term in terms)
            return f"term {max(1, number)} of {len(terms)}"
    return ""


def _span(listed: Sequence[Piece], a: int, b: int, length: int) -> tuple[int, int]:
    if a < b:
        return listed[a].start, listed[b - 1].end
    at = listed[a].start if a < len(listed) else (listed[-1].end if listed else length)
    return at, at


def _text(formula: str, listed: Sequence[Piece]) -> str:
    return " ".join(formula[listed[0].start : listed[-1].end].split()) if listed else ""
