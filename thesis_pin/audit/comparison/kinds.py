"""What kind of slip a correction mends, from how it differs from the print."""

from __future__ import annotations

import difflib
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from thesis_pin.audit.comparison.places import pieces
from thesis_pin.equations.catalogue import Equation

KINDS = {
    "bracket": "a bracket missing, added or misplaced",
    "dot": "a dot or ∂ of a derivative missing, added or misplaced",
    "sign": "plus for minus, or the reverse",
    "index": "the right letter with a wrong sub- or superscript",
    "symbol": "another letter, function or number",
    "term": "a factor or term missing, added or out of place",
    "column": "columns or rows of a matrix missing, added or shifted",
    "frame": "worked out in one frame's axes, used in another's",
    "statement": "the statement itself is wrong",
}
"""Kinds of slips. The last two can't be seen from the formulas' difference: ``frame``
is given by the data, ``statement`` is every other correction of what isn't a misprint."""

_BRACKETS, _SIGNS, _SCRIPTS = frozenset("()[]{}"), frozenset("+-"), frozenset("^_T")
_DOT = re.compile(r"\\d?dot(?:\s*\{([^{}]*)\}|(?![a-zA-Z]))")


def kinds(before: str, after: str) -> tuple[str, ...]:
    """Kinds of the differences of two formulas, in the order of :data:`KINDS`."""
    (first, unit), (second, other) = pieces(before), pieces(after)
    if unit != other:  # one of them is a matrix row
        return ("column",)
    found = in_order(_cells(first, second) if unit == "column" else _symbols(first, second))
    return found or ("symbol",)  # pieces alike in another font


def of_equation(equation: Equation) -> tuple[str, ...]:
    """Kinds of all differences between an equation's print and its correction.

    What is given as right is another statement, whatever else is mended in its formula.
    """
    if equation.right or equation.kind:
        return (equation.kind or "statement",)
    found: list[str] = []
    if equation.left_printed:
        found += kinds(equation.left_printed, equation.left)
    for number, text in equation.corrected.items():
        if number > len(equation.printed) or not text:
            found.append("term")
        else:
            found += kinds(equation.printed[number - 1], text)
    return in_order(found)


def in_order(found: Iterable[str]) -> tuple[str, ...]:
    """Kinds without repetition, in the order of :data:`KINDS`."""
    listed = set(found)
    return tuple(kind for kind in KINDS if kind in listed)


def _changes(
    first: Sequence[str], second: Sequence[str]
) -> Iterator[tuple[Sequence[str], Sequence[str]]]:
    matcher = difflib.SequenceMatcher(None, first, second, autojunk=False)
    for kind, a, b, c, d in matcher.get_opcodes():
        if kind != "equal":
            yield first[a:b], second[c:d]


def _cells(first: Sequence[str], second: Sequence[str]) -> Iterator[str]:
    """Cells of a matrix: their number and places, and what changed inside them."""
    gone: list[str] = []
    come: list[str] = []
    for old, new in _changes(first, second):
        if len(old) == len(new):
            for one, two in zip(old, new, strict=True):
                yield from kinds(one, two) if one and two else ("column",)
        else:
            gone, come = gone + list(old), come + list(new)
            yield "column"
    undotted = {_undotted(cell): cell for cell in come}
    if any(undotted.get(_undotted(cell), cell) != cell for cell in gone):
        yield "dot"


def _symbols(first: Sequence[str], second: Sequence[str]) -> Iterator[str]:
    """Symbols of a formula: replaced in place, or gone here and come there."""
    gone: list[str] = []
    come: list[str] = []
    for old, new in _changes(first, second):
        left, right = _plain(old), _plain(new)
        if _unbalanced(old) != _unbalanced(new) or not (left or right):
            yield "bracket"
        if len(left) == len(right):
            for one, two in zip(left, right, strict=True):
                yield from _replaced(one, two)
        else:
            gone, come = gone + left, come + right
    if gone or come:
        yield from _moved(Counter(gone), Counter(come))


def _plain(run: Sequence[str]) -> list[str]:
    return [piece for piece in run if piece not in _BRACKETS]


def _unbalanced(run: Sequence[str]) -> int:
    return sum(piece in "([{" for piece in run) - sum(piece in ")]}" for piece in run)


def _replaced(old: str, new: str) -> Iterator[str]:
    if old == new:
        return
    if old in _SIGNS and new in _SIGNS:
        yield "sign"
        return
    (of, by), (other, along) = _differential(old), _differential(new)
    if by and along:
        yield from _replaced(of, other)
        yield from _replaced(by, along)
        return
    if _dots(of) + bool(by) != _dots(other) + bool(along):
        yield "dot"
    one, two = _undotted(of), _undotted(other)
    if _base(one) != _base(two):
        yield "symbol"
    elif one != two:
        yield "index"


def _moved(gone: Counter[str], come: Counter[str]) -> Iterator[str]:
    """What runs of unequal length leave when equal pieces are taken off both."""
    left, right = list((gone - come).elements()), list((come - gone).elements())
    if not left and not right:
        yield "term"
        return
    for old in list(left):
        alike = [new for new in right if _base(_undotted(new)) == _base(_undotted(old))]
        if alike and old not in _SIGNS:
            left.remove(old)
            right.remove(alike[0])
            yield from _replaced(old, alike[0])
    rest = {*left, *right}
    if rest:
        yield "sign" if rest <= _SIGNS else "index" if rest <= _SCRIPTS else "term"


def _differential(piece: str) -> tuple[str, str]:
    """x and y of "∂x/∂y"; a piece itself and nothing if it is none."""
    match = re.fullmatch(r"∂(.+)/∂(.+)", piece)
    return (match[1], match[2]) if match else (piece, "")


def _dots(piece: str) -> int:
    return sum(2 if "dd" in match[0] else 1 for match in _DOT.finditer(piece))


def _undotted(piece: str) -> str:
    return _DOT.sub(lambda match: match[1] or "", piece)


def _base(piece: str) -> str:
    return re.split(r"[_^]", piece, maxsplit=1)[0].strip()
