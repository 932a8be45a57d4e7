"""From the grammar's rules to nodes."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from lark import Token, Transformer

from thesis_pin.equations.formula import (
    Call,
    Cross,
    Derivative,
    Dot,
    Matrix,
    Node,
    Norm,
    Number,
    Power,
    Product,
    Quotient,
    Series,
    Sum,
    Symbol,
)
from thesis_pin.equations.parsing.brackets import Brackets
from thesis_pin.equations.parsing.conventions import Conventions
from thesis_pin.equations.parsing.factors import Factors
from thesis_pin.equations.parsing.marks import Arguments, Group, Mark, Slash, column, opened
from thesis_pin.equations.parsing.scripts import INVERTED, with_script

_PREFIX = {"\\mathbb": "bb", "\\mathcal": "cal"}
_NAMES = {"sen": "sin", "arctan2": "atan2"} | {f"a{one}": f"arc{one}" for one in INVERTED}
"""Functions by other names."""


def builder(notation: Conventions, brackets: Brackets) -> Transformer[Token, tuple[Node, ...]]:
    """What makes nodes of the grammar's rules.

    Args:
        notation: What the letters mean.
        brackets: What the brackets say that are read already.
    """
    return _Builder(notation, brackets)


class _Builder(Transformer[Token, tuple[Node, ...]]):
    """Turns the grammar's tree into nodes: a method for each of its rules."""

    def __init__(self, notation: Conventions, brackets: Brackets) -> None:
        super().__init__()
        self.notation, self.brackets, self.factors = notation, brackets, Factors(notation)

    def start(self, parts: list[Node]) -> tuple[Node, ...]:
        return tuple(opened(part) for part in parts)

    def name(self, parts: list[Token]) -> Node:
        return self._letter(str(parts[0]).removeprefix("\\"))

    def _letter(self, base: str) -> Symbol:
        return Symbol(base, kept="i" if base in self.notation.chains else "")

    def number(self, parts: list[Token]) -> Node:
        return Number(float(parts[0]))

    def font(self, parts: list[Any]) -> Node:
        font, inside = str(parts[0]), parts[1]
        node = self.name([inside]) if isinstance(inside, Token) else opened(inside)
        if isinstance(node, Symbol):
            if font in _PREFIX:
                named = self._letter(f"{_PREFIX[font]}:{node.base}")
                return replace(node, base=named.base, kept=named.kept)
            return replace(node, bold=font not in ("\\text", "\\mathrm"))
        return node

    def accent(self, parts: list[Any]) -> Node:
        dots, node = (2 if "dd" in str(parts[0]) else 1), opened(parts[1])
        if "dot" not in parts[0] and isinstance(node, Symbol):
            if "vec" in parts[0]:
                return replace(node, bold=True)
            return replace(node, base=f"{str(parts[0])[1:]}:{node.base}")
        if isinstance(node, Symbol):
            return replace(node, dots=node.dots + dots)
        raise ValueError("a dot above something that isn't a symbol")

    def accent_name(self, parts: list[Token]) -> Node:
        return self.accent([parts[0], self.name([parts[1]])])

    def function(self, parts: list[Token]) -> Node:
        name = re.sub(r"\\(text|operatorname|mathrm)|[\\{}\s_]", "", str(parts[0])).lower()
        return Mark("function", _NAMES.get(name, name))

    def group(self, parts: list[Node]) -> Node:
        return Group(opened(parts[0]))

    def read(self, parts: list[Token]) -> Node:
        return Group(self.brackets.node(parts[0]))

    def row(self, parts: list[Any]) -> Node:
        cells = tuple(opened(part) for part in parts if not isinstance(part, Token))
        return Matrix((cells,))

    def matrix_row(self, parts: list[Any]) -> tuple[Node, ...]:
        return tuple(opened(part) for part in parts if not isinstance(part, Token))

    def matrix(self, parts: list[Any]) -> Node:
        return Matrix(tuple(part for part in parts if isinstance(part, tuple)))

    def norm(self, parts: list[Any]) -> Node:
        return Norm(opened(parts[1]))

    def bars(self, parts: list[Any]) -> Node:
        return Norm(opened(parts[1]), single=True)

    def root(self, parts: list[Node]) -> Node:
        return Call("sqrt", opened(parts[0]))

    def total(self, parts: list[Token]) -> Node:
        return Mark("derivative")

    def partial_operator(self, parts: list[Any]) -> Node:
        return Mark("derivative", by=opened(parts[-1]))

    def partial(self, parts: list[Any]) -> Node:
        above, below = (part for part in parts if not isinstance(part, Token))
        return Derivative(opened(above), opened(below))

    def quotient(self, parts: list[Any]) -> Node:
        above, below = opened(parts[1]), opened(parts[2])
        of, by = _differential(above), _differential(below)
        if "d" in self.notation.declared:
            return Quotient(above, below)
        if of is not None and by is not None:
            return Derivative(of, None if by == Symbol("t") else by)
        of = _differential(above, Power(Symbol("d"), 2))
        if of is not None and by == Power(Symbol("t"), 2):
            return Derivative(Derivative(of, None), None)
        return Quotient(above, below)

    def digits(self, parts: list[Token]) -> Node:
        above, below = (Number(float(one)) for one in re.findall(r"\d", parts[0]))
        return Quotient(above, below)

    def before(self, parts: list[Any]) -> Node:
        """{}^0_1R and {}_1^0R, as R_1^0; also without the braces."""
        node = parts[1]
        if not isinstance(node, Symbol):
            raise ValueError("a superscript before something that isn't a symbol")
        scripts = dict(re.findall(r"([_^])([^_^]*)", re.sub(r"[{}\s]", "", str(parts[0]))))
        above, below = scripts.get("^", ""), scripts.get("_", "")
        return replace(node, sup=above + node.sup, sub=below + node.sub)

    def slash(self, parts: list[Any]) -> Node:
        return Slash(parts[0], parts[2])

    def arguments(self, parts: list[Any]) -> Node:
        return Arguments(tuple(opened(part) for part in parts if not isinstance(part, Token)))

    def scripted(self, parts: list[Any]) -> Node:
        node: Node = parts[0]
        for script in parts[1:]:
            node = with_script(node, str(script), self.notation)
        return node

    def product(self, parts: list[Node | None]) -> Node:
        waiting = [part for part in parts if part is not None]
        if len(waiting) == 1 and isinstance(waiting[0], Arguments):
            return column(waiting[0])  # (x, y), alone
        factors: list[Node] = []
        while waiting:
            factors.append(self.factors.next(waiting))
        return factors[0] if len(factors) == 1 else Product(tuple(opened(f) for f in factors))

    def series(self, parts: list[Any]) -> Node:
        match = re.match(r"\\sum_\{(\w)=(\d+)\}\^\{?(\d+)\}?", str(parts[0]))
        assert match
        return Series(match[1], int(match[2]), int(match[3]), opened(parts[1]))

    def cross(self, parts: list[Any]) -> Node:
        return Cross(opened(parts[0]), opened(parts[2]))

    def dot(self, parts: list[Any]) -> Node:
        return Dot(opened(parts[0]), opened(parts[2]))

    def first_term(self, parts: list[Any]) -> Node:
        first: Node = parts[0]
        return first if len(parts) == 1 else Sum(((str(first), opened(parts[1])),))

    def sum(self, parts: list[Any]) -> Node:
        first: Node = parts[0]
        if len(parts) == 1:
            return first
        terms = list(first.terms) if isinstance(first, Sum) else [("+", opened(first))]
        signs, rest = parts[1::2], parts[2::2]
        terms += [(str(sign), opened(term)) for sign, term in zip(signs, rest, strict=True)]
        return Sum(tuple(terms))


def _differential(node: Node, sign: Node = Symbol("d")) -> Node | None:  # noqa: B008 - frozen
    """x of "dx"; None if it isn't one."""
    if isinstance(node, Product) and node.factors[0] == sign:
        rest = node.factors[1:]
        return rest[0] if len(rest) == 1 else Product(rest)
    return None
