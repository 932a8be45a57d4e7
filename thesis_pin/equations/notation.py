"""From a printed formula to a tree: one grammar for both theses, and for other derivations.

The grammar (``notation.lark``) knows LaTeX; the rooms of ``parsing`` know what the
theses mean by it: ``c θ`` and ``s(α + β)`` are cosine and sine, ``c θ^2`` is the
square of a cosine, ``R_x(θ)`` is a rotation and ``k(q_j(t))`` is just ``k``,
a superscript is a frame on a vector and a power on a scalar.
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from pathlib import Path

from lark import Lark, Token, UnexpectedInput

from thesis_pin.equations.formula import FormulaError, Node, Symbol, Unreadable
from thesis_pin.equations.parsing.brackets import Brackets
from thesis_pin.equations.parsing.builder import builder
from thesis_pin.equations.parsing.conventions import Conventions
from thesis_pin.equations.parsing.layout import plain

_GRAMMAR = Path(__file__).parent / "parsing" / "notation.lark"


@dataclass(frozen=True)
class Notation(Conventions):
    """What the letters of one thesis mean, and the reading of its formulas."""

    def parse(self, formula: str) -> tuple[Node, ...]:
        """Read a formula.

        Args:
            formula: LaTeX, one or more expressions joined by "=".

        Returns:
            The expressions.

        Raises:
            FormulaError: The formula isn't in the notation; says where.
        """
        parser = _parser(self)
        text = plain(formula).replace("\0", "\1")  # \0 marks brackets that are read already
        try:
            return _read(parser.lark, parser.brackets.shortened(text))
        except (UnexpectedInput, ValueError):
            pass  # read whole, it says what is wrong and where
        try:
            return _read(parser.lark, text)
        except UnexpectedInput as error:
            at = error.pos_in_stream or 0
            place = formula[max(0, at - 25) : at + 25]
            raise Unreadable(
                f"the formula can't be read near '{place}'",
                # After the last character lark counts from the last token.
                len(formula) if getattr(error, "token", Token("", "")).type == "$END" else at,
            ) from None
        except ValueError as error:
            raise FormulaError(f"the formula can't be read: {error}") from None

    def symbol(self, text: str) -> Symbol:
        """Read a formula that is a single symbol."""
        (node,) = self.parse(text)
        if not isinstance(node, Symbol):
            raise FormulaError(f"{text!r} isn't a symbol")
        return node


@dataclass(frozen=True)
class _Parser:
    lark: Lark
    brackets: Brackets


def _read(lark: Lark, text: str) -> tuple[Node, ...]:
    # Nodes are built while it is parsed: a tree in between took half as long again.
    found: object = lark.parse(text)
    assert isinstance(found, tuple)
    return found


@functools.cache
def _parser(notation: Notation) -> _Parser:
    text = _GRAMMAR.read_text(encoding="utf-8")
    listed = "|".join(sorted(map(re.escape, notation.words), key=len, reverse=True))
    grammar = text.replace("__WORDS__", f"{listed}|" if listed else "")

    def inside(part: str) -> Node | None:
        try:
            sides = _read(lark, part)
        except (UnexpectedInput, ValueError):
            return None
        return sides[0] if len(sides) == 1 else None

    brackets = Brackets(inside)
    lark = Lark(grammar, parser="lalr", transformer=builder(notation, brackets))
    return _Parser(lark, brackets)
