"""The file of a derivation: what its letters stand for, and its printed equations."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, NoReturn

from pydantic import Field

from thesis_pin.equations.catalogue import Equation, EquationFile
from thesis_pin.equations.formula import FormulaError, Unreadable
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.parsing.layout import plain
from thesis_pin.errors import BadInput, SpecificationError
from thesis_pin.model.source import read_text
from thesis_pin.model.specification import Key, Strict, Vector3, key_lines, parse_toml

KIND = "derivation"
_ROOM = 30
"""Characters shown on both sides of the place that can't be read."""


class Header(Strict):
    """What the file is about, and how it writes.

    Attributes:
        title: What it is called, as "Two-link arm".
        name: First part of its equations' ids.
        numbers: All equation numbers it has, where it is to be said which are missing.
        gravity: Free fall's acceleration in the world's axes [m/s²]; None for the model's.
        cos, sin: Letters that stand for cosine and sine, as c in ``c_{12}`` and ``c\\theta``.
        indices: Letters in subscripts that are indices, with their values.
        words: Names of several letters.
    """

    title: Annotated[str, Field(min_length=1)]
    name: Annotated[str, Field(pattern=r"^[a-z]+$")]
    numbers: tuple[str, ...] = ()
    gravity: Vector3 | None = None
    cos: Annotated[str, Field(pattern=r"^[a-zA-Z]?$")] = ""
    sin: Annotated[str, Field(pattern=r"^[a-zA-Z]?$")] = ""
    indices: dict[str, tuple[int, ...]] = Field(default_factory=dict)
    words: tuple[str, ...] = ()


class DerivationFile(EquationFile):
    """A derivation as its file says it.

    Attributes:
        derivation: What it is about.
        coordinates: Symbol → the joint it is the coordinate of, or a sum of joints.
        constants: Symbol → a number, one with its unit, or where the model has it.
        symbols: Symbol → what it must be.
        forces: Coordinate's symbol → its generalized force, a formula; all others are free.
    """

    derivation: Header
    coordinates: dict[str, str]
    constants: dict[str, float | str] = Field(default_factory=dict)
    symbols: dict[str, str] = Field(default_factory=dict)
    forces: dict[str, float | str] = Field(default_factory=dict)

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Ids that begin with the name; symbols said once; something to judge."""
        yield from super().cross_check()
        for letter, values in self.derivation.indices.items():
            if not re.fullmatch("[a-zA-Z]", letter) or not values:
                place = ("derivation", "indices", letter)
                yield place, "an index is one letter, with a list of its numbers", list(values)
        for word in self.derivation.words:
            if not re.fullmatch("[a-zA-Z]{2,}", word):
                yield ("derivation", "words"), "a word is made of two letters or more", word
        if not self.coordinates:
            yield ("coordinates",), "no symbol is a joint's coordinate", None
        if not self.equation:
            yield ("equation",), "there is no equation", None
        for k, one in enumerate(self.equation):
            if one.id.partition(":")[0] != self.derivation.name:
                what = f"ids begin with the derivation's name, {self.derivation.name}:"
                yield ("equation", k, "id"), what, one.id
            if one.claim or one.defines or one.closed:
                yield ("equation", k), "claim, defines and closed belong to the two theses", one.id
            if not (one.illegible or one.not_checkable):
                yield from _two_sides(("equation", k), one)
        tables = (self.coordinates, self.constants, self.symbols)
        listed = [symbol for table in tables for symbol in table]
        for symbol in sorted({one for one in listed if listed.count(one) > 1}):
            yield ("symbols", symbol), "said twice", symbol


def _two_sides(place: Key, one: Equation) -> Iterator[tuple[Key, str, object]]:
    whole = two_sided(one)
    if not (whole.left.strip() and whole.printed):
        what = "missing: an equation has two sides, or is printed whole, as a = b"
        yield (*place, "left"), what, one.id
    empty = [n for n, text in enumerate(whole.printed, start=1) if not text.strip()]
    if any(n not in whole.mending for n in empty):
        yield (*place, "printed"), "nothing is printed there", one.id
    every = "".join((one.left, *one.printed))
    if every.strip() and not re.search("[a-zA-Z]", every):
        yield place, "an equation of nothing: there is no symbol in it", every


def read(path: str | Path) -> tuple[DerivationFile, str]:
    """A derivation's file, and its text.

    Raises:
        BadInput: It can't be opened or isn't TOML.
        SpecificationError: It breaks the schema; lists every problem.
    """
    text = read_text(KIND, path)
    try:
        return parse_toml(KIND, DerivationFile, text, where=str(path)), text
    except SpecificationError:
        raise
    except BadInput as error:
        if error.remedy or "\\" not in text:
            raise
        remedy = r"LaTeX stands in single quotes, also before the =: '\theta_1' = 'shoulder'"
        raise BadInput(error.what, where=error.where, remedy=remedy) from None


def two_sided(equation: Equation) -> Equation:
    """An equation that is printed whole, "a = b = c" or a list of its sides, with its left side.

    Its corrections are counted as it is printed: the first side is number 1 of a list. In the
    place of "a = b" stands another whole line, or its right side alone.
    """
    if equation.left or not equation.printed:
        return equation
    sides = list(equation.printed)
    listed = len(sides) > 1
    if not (listed or equation.illegible or equation.not_checkable):
        sides = _sides(sides[0])
    left, *members = sides
    changed = dict(equation) | {"left": left, "printed": tuple(members)}
    for name in ("corrected", "right", "misread"):
        given: dict[int, str] = getattr(equation, name)
        mended = (
            {number - 1: text for number, text in given.items()}
            if listed
            else _mended(sides, given.get(1, ""))
        )
        changed[name] = {number: text for number, text in mended.items() if number}
        if 0 in mended and name != "misread":
            changed |= {"left": mended[0], "left_printed": left}
    return Equation.made(**changed)


def _mended(sides: list[str], text: str) -> dict[int, str]:
    """Number of a side, from 0, → what should stand there; none for no text."""
    right = _sides(text)
    if len(right) == 1:
        return {1: text} if text else {}
    return {
        number: side
        for number, side in enumerate(right)
        if number >= len(sides) or side.split() != sides[number].split()
    }


def _sides(formula: str) -> list[str]:
    """What stands between the = of a formula; those in braces, as below a sum, don't count."""
    depth, start, found = 0, 0, []
    for k, letter in enumerate(formula):
        depth += (letter == "{") - (letter == "}")
        if letter == "=" and depth == 0:
            found.append(formula[start:k].strip())
            start = k + 1
    return [*found, formula[start:].strip()]


def check_formulas(file: DerivationFile, text: str, notation: Notation, where: str) -> None:
    """Refuse formulas that can't be read and that nothing is given in the place of.

    Raises:
        BadInput: With file, line, column, and a mark below the place.
    """
    lines = key_lines(text)
    for k, one in enumerate(map(two_sided, file.equation)):
        here = lines.get(("equation", k), 1)
        mended = set(one.mending)
        printed = [t for n, t in enumerate(one.printed, start=1) if n not in mended]
        for formula in (one.left, *printed, *one.mending.values(), *one.rebuilt):
            if formula and not (one.illegible and formula in one.printed):
                _check(formula, text, notation, where, here, one.id)


def _check(
    formula: str, text: str, notation: Notation, where: str, line: int, identity: str
) -> None:
    try:
        sides = notation.parse(formula)
    except Unreadable as error:
        what = "the formula can't be read"
        _refuse(what, formula, error.position, text, where, line, identity)
    except FormulaError as error:
        _refuse(error.what, formula, None, text, where, line, identity)
    if len(sides) > 1:
        what = "the formula has an = where one side belongs"
        _refuse(what, formula, plain(formula).find("="), text, where, line, identity)


def _refuse(
    what: str, formula: str, at: int | None, text: str, where: str, line: int, identity: str
) -> NoReturn:
    """Raise the error on a formula, with a mark below the place if that is known."""
    start = text.find(formula, sum(map(len, text.split("\n")[: line - 1])) + line - 1)
    place = f"{where}:{line}"
    if start >= 0:
        position = start + (at or 0)
        line = text.count("\n", 0, position) + 1
        place = f"{where}:{line}:{position - text.rfind(chr(10), 0, position)}"
    first = max(0, (at or 0) - _ROOM)
    shown = re.sub(r"\s", " ", formula[first : (at or 0) + _ROOM])
    cut = "…" if first else ""
    mark = "" if at is None else "\n  " + " " * (len(cut) + at - first) + "^"
    raise BadInput(
        f"{what} ({identity})\n  {cut}{shown}{mark}\n"
        "docs/your_derivation.md lists what can be read. If it is printed like that, say in "
        "`corrected` what should stand there",
        where=place,
    )
