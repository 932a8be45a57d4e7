"""Long parts of formulas, each read once: lines repeat them, and a slip changes one of many."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable

from thesis_pin.equations.formula import Node

_LONG = 24
"""Characters from which a part is read by itself; reading a shorter one costs no more."""
_KEPT = 16384
_PIECE = re.compile(
    r"(?P<script>[_^]\s*\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\})"
    r"|(?P<open>[(\[{]|\\\{|\\begin\s*\{[a-zA-Z]+\}(?:\s*\{[clr| ]*\})?)"
    r"|(?P<close>[)\]}]|\\\}|\\end\s*\{[a-zA-Z]+\})"
    r"|(?P<between>[-+=,&]|\\\\|\\(?:pm|mp|q?quad)(?![a-zA-Z]))|\\(?:[a-zA-Z]+|.)",
    re.DOTALL,
)
_HOLE = re.compile("\0(\\d+)\0")


def balanced(formula: str) -> bool:
    """Whether as many brackets close as open; a formula where they don't can't be read."""
    depth = 0
    for piece in _PIECE.finditer(formula):
        depth += bool(piece["open"]) - bool(piece["close"])
        if depth < 0:
            return False
    return depth == 0


class Brackets:
    """What the long brackets and the long terms of sums read so far say.

    Args:
        read: Reads a formula; None where what is in a bracket isn't one formula.
    """

    def __init__(self, read: Callable[[str], Node | None]) -> None:
        self._read = read
        self._nodes: dict[str, tuple[str, Node] | None] = {}
        self._numbered: dict[str, Node] = {}
        self._count = itertools.count()

    def shortened(self, formula: str) -> str:
        """The formula with a number in place of each long term and of what long brackets hold."""
        brackets, terms = _parts(formula)
        found, done = "", 0
        for start, end in terms if len(terms) > 1 else brackets:
            if end - start >= _LONG:
                found += formula[done:start] + self._put(formula[start:end])
                done = end
        return found + formula[done:]

    def node(self, number: str) -> Node:
        """What stands in the bracket of a number.

        Raises:
            ValueError: There is none.
        """
        match = _HOLE.fullmatch(number)
        if match is None or match[1] not in self._numbered:
            raise ValueError("a bracket that wasn't read")
        return self._numbered[match[1]]

    def _put(self, inside: str) -> str:
        if inside not in self._nodes:
            self._nodes[inside] = self._numbered_one(inside)
            while len(self._nodes) > _KEPT:
                oldest = self._nodes.pop(next(iter(self._nodes)))
                if oldest:
                    self._numbered.pop(oldest[0], None)
        found = self._nodes[inside]
        return f"\0{found[0]}\0" if found else self.shortened(inside)

    def _numbered_one(self, inside: str) -> tuple[str, Node] | None:
        node = self._read(self.shortened(inside))
        if node is None:
            return None
        number = str(next(self._count))
        self._numbered[number] = node
        return number, node


def _parts(formula: str) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Where what stands in the outermost brackets is, and where the terms are.

    What stands between bars is no term of its own, and can't be read as one.
    """
    inside, terms, start, begin, depth = [], [], 0, 0, 0
    for piece in _PIECE.finditer(formula):
        if piece["open"]:
            start = start if depth else piece.end()
            depth += 1
        elif piece["close"]:
            depth -= 1
            if depth < 0:
                return [], []
            if depth == 0:
                inside.append((start, piece.start()))
        elif piece["between"] and depth == 0:
            terms.append((begin, piece.start()))
            begin = piece.end()
    terms.append((begin, len(formula)))
    return inside, [_stripped(formula, *term) for term in terms]


def _stripped(formula: str, start: int, end: int) -> tuple[int, int]:
    """The same place without the spaces around it."""
    text = formula[start:end]
    return start + len(text) - len(text.lstrip()), end - len(text) + len(text.rstrip())
