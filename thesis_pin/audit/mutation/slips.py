"""All slips of a kind that a hand could make in a formula."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from thesis_pin.audit.comparison.tokens import Token, sums, tokens


@dataclass(frozen=True)
class Planted:
    """A formula with one slip.

    Attributes:
        kind: One of :data:`SLIPS`.
        text: The formula with the slip.
        said: What became what, in words.
    """

    kind: str
    text: str
    said: str


def planted(formula: str, kind: str) -> list[Planted]:
    """Every slip of a kind in a formula, from its left to its right."""
    pieces = tokens(formula)
    found = [
        Planted(kind, formula[:start] + new + formula[end:], _said(formula, start, end, new))
        for start, end, new in SLIPS[kind](formula, pieces)
    ]
    return list({one.text: one for one in found if one.text != formula}.values())


def _said(formula: str, start: int, end: int, new: str) -> str:
    before = formula[max(0, start - 20) : start]
    return f"…{before}[{formula[start:end]} → {new}]{formula[end : end + 20]}…"


Change = tuple[int, int, str]
"""From, to, and what stands there instead."""


def _signs(formula: str, pieces: list[Token]) -> Iterator[Change]:
    for token in pieces:
        if token.kind == "sign":
            yield token.start, token.end, "-" if token.text == "+" else "+"
    for terms in sums(pieces):
        first = terms[0]
        if first.start == first.body and formula[first.body : first.end].strip() != "0":
            yield first.start, first.start, "- "


def _indices(formula: str, pieces: list[Token]) -> Iterator[Change]:
    for token in pieces:
        if token.kind == "script" and token.text.startswith("_"):
            yield from _digits_moved(token, r"\d")
            for match in re.finditer(r"(?<![a-zA-Z\\])[in](?![a-zA-Z])|(?<=\d)i", token.text):
                at = token.start + match.start()
                yield at, at + 1, "2" if match[0] == "i" else "3"


def _frames(formula: str, pieces: list[Token]) -> Iterator[Change]:
    for k, token in enumerate(pieces):
        if token.kind != "script" or not token.text.startswith("^") or "T" in token.text:
            continue
        if not re.search(r"[0-9B]", token.text) or not _bold(pieces, k):
            continue
        yield from _digits_moved(token, r"\d")
        for match in re.finditer("B", token.text):
            at = token.start + match.start()
            yield at, at + 1, "0"


def _bold(pieces: list[Token], k: int) -> bool:
    """Whether a script belongs to a bold letter: one of the tokens just before is its font."""
    return any(token.kind == "font" for token in pieces[max(0, k - 6) : k])


def _digits_moved(token: Token, pattern: str) -> Iterator[Change]:
    for match in re.finditer(pattern, token.text):
        at, digit = token.start + match.start(), int(match[0])
        for other in dict.fromkeys((digit + 1, digit - 1, 0, 1, 2, 3)):
            if 0 <= other <= 9 and other != digit:
                yield at, at + 1, str(other)


def _dots(formula: str, pieces: list[Token]) -> Iterator[Change]:
    for k, token in enumerate(pieces):
        if token.kind == "accent":
            yield token.start, token.end, "" if token.text == r"\dot" else r"\dot"
            if token.text == r"\dot":
                yield token.start, token.end, r"\ddot"
        elif _free(pieces, k) and (end := _letter_end(pieces, k)):
            yield token.start, end, rf"\dot{{{formula[token.start : end]}}}"


_GREEK = frozenset(
    {
        r"\theta",
        r"\phi",
        r"\psi",
        r"\varphi",
        r"\omega",
        r"\alpha",
        r"\beta",
        r"\lambda",
        r"\tau",
        r"\xi",
    }
)


def _letter_end(pieces: list[Token], k: int) -> int:
    """Where the letter that begins at a token ends; 0 if none does."""
    token = pieces[k]
    if token.kind == "letter" or token.text in _GREEK:
        return token.end
    if token.kind != "font":
        return 0
    depth = 0
    for other in pieces[k + 1 :]:
        depth += (other.kind == "open") - (other.kind == "close")
        if depth == 0 and other.kind != "layout":
            return other.end
    return 0


def _free(pieces: list[Token], k: int) -> bool:
    """Whether a letter stands in no braces of a font or a dot."""
    before = [token for token in pieces[:k] if token.kind != "layout"][-2:]
    kinds = [token.kind for token in before]
    braced = len(before) == 2 and before[1].text == "{" and kinds[0] in ("font", "accent")
    return not (braced or (kinds and kinds[-1] in ("font", "accent")))


def _factors(formula: str, pieces: list[Token]) -> Iterator[Change]:
    for terms in sums(pieces):
        for term in terms:
            if formula[term.body : term.end].strip() != "0":
                yield term.body, term.body, " 2 "


def _swapped(formula: str, pieces: list[Token]) -> Iterator[Change]:
    pairs = {r"\cos": r"\sin", r"\sin": r"\cos", "c": "s", "s": "c"}
    for k, token in enumerate(pieces):
        if token.text not in pairs or not _free(pieces, k):
            continue
        following = next((t for t in pieces[k + 1 :] if t.kind != "layout"), None)
        angle = following is not None and (following.text in _ANGLES or following.text in "([")
        if token.kind == "command" or angle:
            yield token.start, token.end, pairs[token.text]


_ANGLES = frozenset({r"\theta", r"\phi", r"\psi", r"\beta", r"\alpha", r"\gamma"})


def _dropped(formula: str, pieces: list[Token]) -> Iterator[Change]:
    for terms in sums(pieces):
        if len(terms) > 1:
            for term in terms:
                if formula[term.body : term.end].strip() != "0":
                    yield term.start, term.end, " "


def _digits(formula: str, pieces: list[Token]) -> Iterator[Change]:
    for token in pieces:
        if token.kind != "number":
            continue
        for k, character in enumerate(token.text):
            if not character.isdigit():
                continue
            at = token.start + k
            yield at, at + 1, str((int(character) + 1) % 10)
            following = token.text[k + 1 : k + 2]
            if following.isdigit() and following != character:
                yield at, at + 2, following + character


SLIPS: dict[str, Callable[[str, list[Token]], Iterator[Change]]] = {
    "sign": _signs,
    "index": _indices,
    "dot": _dots,
    "factor": _factors,
    "sine for cosine": _swapped,
    "term dropped": _dropped,
    "frame": _frames,
    "digit": _digits,
}
"""Kinds of slips: what each changes in a formula."""
