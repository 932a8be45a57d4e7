"""Each slip of a line by itself: put back alone into the corrected line, it has to fail."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from thesis_pin.audit.comparison import kinds
from thesis_pin.audit.comparison.differences import (
    Difference,
    differences,
    joined,
    put_back,
    term_of,
)
from thesis_pin.audit.slips import Slip
from thesis_pin.equations.catalogue import Catalogue, Equation

Test = Callable[[Equation], float]
"""Residual of a line's print; infinite if it can't be evaluated."""


def slips(catalogue: Catalogue, equation: Equation, residual: Test) -> Iterator[Slip]:
    """Every difference of an equation's print and its correction, with what it alone does.

    Args:
        catalogue: Reads formulas.
        equation: One that its correction mends.
        residual: Judges a line's print.
    """
    right = mended(equation)
    if equation.left_printed:
        for one in _of_texts(catalogue, equation.left_printed, equation.left):
            alone = _test(residual, right.model_copy(update={"left": one[1]}))
            yield _slip(0, equation.left_printed, equation.left, one, alone)
    for number, text in equation.mending.items():
        yield from _of_member(catalogue, equation, right, number, text, residual)


def mended(equation: Equation) -> Equation:
    """The equation with its corrected members as if they were printed, a member kept for each."""
    members = [
        equation.mending.get(k, equation.printed[k - 1] if k <= len(equation.printed) else "")
        for k in range(1, max(len(equation.printed), *equation.mending, 0) + 1)
    ]
    return equation.model_copy(update={"printed": tuple(members), "left_printed": ""})


def _of_member(
    catalogue: Catalogue, equation: Equation, right: Equation, number: int, text: str, test: Test
) -> Iterator[Slip]:
    if number > len(equation.printed) and not text:
        return
    if number > len(equation.printed) or not text:
        before = "" if number > len(equation.printed) else equation.printed[number - 1]
        whole = _put(right, number, before)
        yield Slip(number, 1, before, text, kind="term", residual=_test(test, whole))
        return
    print_, statement = equation.printed[number - 1], number in equation.right
    if not statement:
        for slip in _of_texts(catalogue, print_, text):
            own = _put(right, number, slip[1]) if equation.claim else _only(right, slip[1])
            yield _slip(number, print_, text, slip, _test(test, own))
        return
    meant = equation.misread.get(number, print_)
    for slip in _of_texts(catalogue, print_, meant) if meant != print_ else ():
        # The statement is another one, so a slip in it is held against the statement itself.
        own = _only(right, slip[1]).model_copy(update={"left": meant})
        yield _slip(number, print_, meant, slip, _test(test, own))
    kind = equation.kind or "statement"
    parts = _parts(catalogue, meant, text)
    for one, changed in parts:
        alone = _test(test, _put(right, number, changed))
        yield _slip(number, meant, text, (one, changed), alone, kind)
    if not parts and meant != text:  # else mending its text says it all
        alone = _test(test, _put(right, number, meant))
        yield Slip(number, 1, meant, text, kind=kind, residual=alone)


def _parts(catalogue: Catalogue, meant: str, text: str) -> list[tuple[Difference, str]]:
    """The few places in which a statement differs; none where it is another one."""
    found = list(differences(meant, text))
    if "\\text" in text or len(found) > _PLACES:
        return []
    changed = sum(max(b - a, d - c) for (a, b), (c, d) in ((x.printed, x.mended) for x in found))
    if len(found) > 1 and changed > _LOCAL * max(len(meant), len(text)):
        return []
    parts = list(_of_texts(catalogue, meant, text))
    if len(parts) == 1 and len(found) == 2 and not (parts[0][0].before or parts[0][0].after):
        # Brackets around all of it: neither reads alone, and what lies between is right.
        return [(one, put_back(meant, text, one)) for one in found]
    touched = sum(one.printed[1] - one.printed[0] for one, _ in parts)
    return parts if len(parts) == 1 or touched <= _LOCAL * len(meant) else []


_LOCAL = 0.45
"""Share of a statement that may differ for its places to say more than the whole."""
_PLACES = 4
"""Places that a reader can keep in mind at once."""


def _only(equation: Equation, text: str) -> Equation:
    """The equation with a single member: its others hold."""
    return equation.model_copy(update={"printed": (text,), "imposes": ()})


def _put(equation: Equation, number: int, text: str) -> Equation:
    """The equation with another member; one that is empty is left out."""
    members = list(equation.printed)
    members[number - 1 : number] = [text] if text else []
    return equation.model_copy(update={"printed": tuple(members)})


def _of_texts(catalogue: Catalogue, print_: str, text: str) -> Iterator[tuple[Difference, str]]:
    """Differences, each with the corrected text in which it alone is as printed.

    Two that only read together are one, where the print itself can be read.
    """
    found = list(differences(print_, text))
    readable = catalogue.reads(print_)
    while found:
        one = found.pop(0)
        while found and readable and not catalogue.reads(put_back(print_, text, one)):
            one = joined(one, found.pop(0))
        yield one, put_back(print_, text, one)


def _test(residual: Test, equation: Equation) -> float:
    return residual(equation) if equation.printed else math.inf


def _slip(
    number: int,
    print_: str,
    text: str,
    found: tuple[Difference, str],
    residual: float,
    kind: str = "",
) -> Slip:
    one, _ = found
    old, new = print_[slice(*one.printed)], text[slice(*one.mended)]
    return Slip(
        number,
        one.number,
        " ".join(old.split()),
        " ".join(new.split()),
        (one.before, one.after),
        _term(print_, text, one),
        kind or _kind(one, old, new),
        residual,
    )


def _term(print_: str, text: str, one: Difference) -> str:
    """Which term a difference is in; of the correction, where the print has others.

    A lost bracket makes more terms, or fewer, of a sum: then a reader can't count in the print.
    """
    term = term_of(text, one.mended[0])
    if not term or term == term_of(print_, one.printed[0]):
        return term
    return f"{term} of the correction"


def _kind(one: Difference, old: str, new: str) -> str:
    """Kind of a difference, seen between its neighbours: formulas can be pages long."""
    if old.count("&") != new.count("&") or old.count(r"\\") != new.count(r"\\"):
        return "column"
    before, after = (f"{one.before} {text} {one.after}" for text in (old, new))
    return kinds.kinds(before, after)[0]
