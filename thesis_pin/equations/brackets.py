"""Long brackets of formulas, each read once: lines repeat them, and a slip changes one of many."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable

from thesis_pin.equations.formula import Node

_LONG = 24
"""Characters from which a bracket is read by itself; reading a shorter one costs no more."""
_KEPT = 4096
_PIECE = re.compile(r"[_^]\s*\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\}|[()]")
_HOLE = re.compile("\0(\\d+)\0")


class Brackets:
    """What the long brackets read so far say.

    Args:
        read: Reads a formula; None where what is in a bracket isn't one formula.
    """

    def __init__(self, read: Callable[[str], Node | None]) -> None:
        self._read = read
        self._nodes: dict[str, tuple[str, Node] | None] = {}
        self._numbered: dict[str, Node] = {}
        self._count = itertools.count()

    def shortened(self, formula: str) -> str:
        """The formula with a number in place of what each long bracket holds."""
        found, start, depth, done = "", 0, 0, 0
        for piece in _PIECE.finditer(formula):
            if piece[0] == "(":
                start = piece.end() if depth == 0 else start
                depth += 1
            elif piece[0] == ")" and depth:
                depth -= 1
                if depth == 0 and piece.start() - start >= _LONG:
                    found += formula[done:start] + self._put(formula[start : piece.start()])
                    done = piece.start()
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
