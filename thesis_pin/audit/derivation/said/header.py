"""What a derivation's header says: how formulas are read, and what symbols stand for."""

from __future__ import annotations

from thesis_pin.audit.derivation.said import phrases
from thesis_pin.audit.derivation.said.constants import number
from thesis_pin.audit.derivation.said.file import DerivationFile
from thesis_pin.audit.derivation.said.glossary import Glossary, Key, key
from thesis_pin.audit.derivation.said.phrases import Phrase
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.notation import Notation
from thesis_pin.errors import BadInput

_ROTATIONS = frozenset({"R_x", "R_y", "R_z"})
_GRAVITY_TOLD = 1e-9
"""Difference from which two sizes of gravity count as two [m/s²]."""


def notation(file: DerivationFile, where: str) -> Notation:
    """How a derivation's formulas are read.

    Raises:
        BadInput: A key of the header isn't a symbol, has dots, or is said twice.
    """
    header = file.derivation
    plain = Notation(ranges=(), words=header.words, shorthand=())
    _check_once(file, plain, where)
    given = [*file.coordinates, *file.constants]
    factors = frozenset(_symbol(text, plain, where).name for text in given)
    named = [_symbol(text, plain, where) for text in file.symbols]
    coordinates = [_symbol(text, plain, where).name for text in file.coordinates]
    vectors = [
        symbol.name
        for symbol, words in zip(named, file.symbols.values(), strict=True)
        if words.strip().lower().startswith("coordinates")
    ]
    names = factors | {symbol.name for symbol in named}
    short = [(header.cos, "cos"), (header.sin, "sin")]
    return Notation(
        functions=_ROTATIONS - names,
        words=header.words,
        ignored_arguments=frozenset({"t", *coordinates, *vectors}),
        shorthand=tuple((letter, of) for letter, of in short if letter),
        declared=names,
        factors=factors,
        ranges=tuple(
            (letter, tuple(map(str, values))) for letter, values in header.indices.items()
        ),
    )


def glossary(
    file: DerivationFile, notation: Notation, where: str, gravity: float
) -> tuple[Glossary, set[str]]:
    """What symbols stand for, and what of the robot mustn't change as numbers are typed in.

    Args:
        file: The derivation.
        notation: How it is read.
        where: The file, for messages.
        gravity: Its size [m/s²]; a number that says no more keeps nothing from changing.

    Raises:
        BadInput: Words can't be understood.
    """
    constants: dict[Key, float | Phrase] = {}
    fixed: set[str] = set()
    for text, value in file.constants.items():
        place = f"{where}: constants.{text}"
        found = number(value, place)
        constants[key(_symbol(text, notation, where))] = (
            phrases.parse(str(value), place) if found is None else found[0]
        )
        if found is not None and abs(found[0] - gravity) > _GRAVITY_TOLD:
            fixed |= found[1]
    symbols: dict[Key, Phrase | Node] = {}
    for text, words in file.symbols.items():
        meant = _meaning(words, notation, f"{where}: symbols.{text}")
        symbols[key(_symbol(text, notation, where))] = meant
    said = enumerate(file.coordinates)
    coordinates = {key(_symbol(text, notation, where)): k for k, text in said}
    header = file.derivation
    return Glossary(coordinates, constants, symbols, header.cos, header.sin), fixed


def _check_once(file: DerivationFile, notation: Notation, where: str) -> None:
    """Refuse symbols with dots, and those said twice, by another spelling or in another table."""
    seen: dict[Key, str] = {}
    for table in ("coordinates", "constants", "symbols"):
        for text in getattr(file, table):
            place = f"{table}.{text}"
            symbol = _symbol(text, notation, where)
            if symbol.dots:
                raise BadInput(
                    "has dots",
                    where=f"{where}: {place}",
                    allowed="symbols without: what a dotted one is follows",
                    remedy="Say what the one without dots is",
                )
            if key(symbol) in seen:
                raise BadInput(
                    f"says what {seen[key(symbol)]} says already",
                    where=f"{where}: {place}",
                    allowed="each symbol once",
                )
            seen[key(symbol)] = place


def _symbol(text: str, notation: Notation, where: str) -> Symbol:
    try:
        return notation.symbol(text)
    except (FormulaError, ValueError) as error:
        what = error.what if isinstance(error, FormulaError) else "isn't one"
        raise BadInput(f"{text!r}: {what}", where=f"{where}: a symbol") from None


def _meaning(words: str, notation: Notation, where: str) -> Phrase | Node:
    if not words.lstrip().startswith("="):
        return phrases.parse(words, where)
    try:
        (node,) = notation.parse(words.lstrip()[1:])
    except (FormulaError, ValueError) as error:
        raise BadInput(f"{words!r} can't be read: {error}", where=where) from None
    return node
