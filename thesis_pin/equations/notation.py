"""From a printed formula to a tree: one grammar for both theses, and for other derivations.

The grammar (``notation.lark``) knows LaTeX; this module knows what the theses
mean by it: ``c θ`` and ``s(α + β)`` are cosine and sine, ``c θ^2`` is the
square of a cosine, ``R_x(θ)`` is a rotation and ``k(q_j(t))`` is just ``k``,
a superscript is a frame on a vector and a power on a scalar.
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, cast

from lark import Lark, Token, Transformer, UnexpectedInput

from thesis_pin.equations.brackets import Brackets
from thesis_pin.equations.formula import (
    Call,
    Cross,
    Derivative,
    Dot,
    FormulaError,
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
    Transpose,
    Unreadable,
)
from thesis_pin.equations.layout import plain


@dataclass(frozen=True)
class _Mark(Node):
    """Something waiting for the factor after it: a function, an operator, δ."""

    kind: str
    name: str = ""
    by: Node | None = None
    exponent: int = 1


@dataclass(frozen=True)
class _Group(Node):
    """A bracketed expression; tells an argument from a factor."""

    inside: Node


@dataclass(frozen=True)
class _Arguments(Node):
    """What a symbol depends on, as (q, t) after M."""

    of: tuple[Node, ...]


@dataclass(frozen=True)
class _Slash(Quotient):
    """A fraction on one line, of which the factors beside it may be parts."""


@dataclass(frozen=True)
class Notation:
    """What the letters of one thesis mean.

    Attributes:
        functions: Symbols that are functions of the bracket after them ("R_x", "T_z4").
        words: Names of several letters ("ZMP").
        labelled: Bases whose numeric superscript is a label even when not bold.
        ignored_arguments: Brackets after a symbol that say only what it depends on.
        chains: Bases whose index i stays in the name: with i = 1 the vector k_{2i} of a
            side chain would become k_21, which is another vector of chain 0.
        shorthand: Letters that stand for a function of the angle after them.
        declared: Letters that are symbols wherever they stand, though d and δ otherwise are
            differentials, and c and s functions.
        factors: Names of symbols that a bracket after them multiplies, where any other symbol
            depends on what it holds, as M(q, t); None where only
            ``ignored_arguments`` say so.
        ranges: Letters in subscripts that are indices, with their values; None for those of
            both theses.
    """

    functions: frozenset[str] = frozenset()
    words: tuple[str, ...] = ()
    labelled: frozenset[str] = frozenset()
    ignored_arguments: frozenset[str] = frozenset({"t", "q_j"})
    chains: frozenset[str] = frozenset()
    shorthand: tuple[tuple[str, str], ...] = (("c", "cos"), ("s", "sin"))
    declared: frozenset[str] = frozenset()
    factors: frozenset[str] | None = None
    ranges: tuple[tuple[str, tuple[str, ...]], ...] | None = None

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
    text = (Path(__file__).parent / "notation.lark").read_text(encoding="utf-8")
    listed = "|".join(sorted(map(re.escape, notation.words), key=len, reverse=True))
    grammar = text.replace("__WORDS__", f"{listed}|" if listed else "")

    def inside(part: str) -> Node | None:
        try:
            sides = _read(lark, part)
        except (UnexpectedInput, ValueError):
            return None
        return sides[0] if len(sides) == 1 else None

    brackets = Brackets(inside)
    lark = Lark(grammar, parser="lalr", transformer=_Builder(notation, brackets))
    return _Parser(lark, brackets)


_INVERTED = ("sin", "cos", "tan")
_TRANSPOSED = ("top", "intercal", "mathsfT", "rmT")
_PREFIX = {"\\mathbb": "bb", "\\mathcal": "cal"}
_NAMES = {"sen": "sin", "arctan2": "atan2"} | {f"a{one}": f"arc{one}" for one in _INVERTED}
"""Functions by other names."""
_FONTS = re.compile(r"\\(mathbf|boldsymbol|mathrm|text|bm)(?![a-zA-Z])")


def flatten(script: str) -> str:
    """Sub- or superscript as plain characters: ``{\\theta_{1i}}`` → ``theta1i``."""
    text = _FONTS.sub("", script)
    text = re.sub(r"\\(dot|ddot)(?![a-zA-Z])|\\[!,;: ]", "", text)
    return re.sub(r"[\\{}_\s,]", "", text)


class _Builder(Transformer[Token, tuple[Node, ...]]):
    """Turns the grammar's tree into nodes."""

    def __init__(self, notation: Notation, brackets: Brackets) -> None:
        super().__init__()
        self.notation, self.brackets = notation, brackets

    def start(self, parts: list[Node]) -> tuple[Node, ...]:
        return tuple(_open(part) for part in parts)

    def name(self, parts: list[Token]) -> Node:
        return self._letter(str(parts[0]).removeprefix("\\"))

    def _letter(self, base: str) -> Symbol:
        return Symbol(base, kept="i" if base in self.notation.chains else "")

    def number(self, parts: list[Token]) -> Node:
        return Number(float(parts[0]))

    def font(self, parts: list[Any]) -> Node:
        font, inside = str(parts[0]), parts[1]
        node = self.name([inside]) if isinstance(inside, Token) else _open(inside)
        if isinstance(node, Symbol):
            if font in _PREFIX:
                named = self._letter(f"{_PREFIX[font]}:{node.base}")
                return replace(node, base=named.base, kept=named.kept)
            return replace(node, bold=font not in ("\\text", "\\mathrm"))
        return node

    def accent(self, parts: list[Any]) -> Node:
        dots, node = (2 if "dd" in str(parts[0]) else 1), _open(parts[1])
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
        return _Mark("function", _NAMES.get(name, name))

    def group(self, parts: list[Node]) -> Node:
        return _Group(_open(parts[0]))

    def read(self, parts: list[Token]) -> Node:
        return _Group(self.brackets.node(parts[0]))

    def row(self, parts: list[Any]) -> Node:
        cells = tuple(_open(part) for part in parts if not isinstance(part, Token))
        return Matrix((cells,))

    def matrix_row(self, parts: list[Any]) -> tuple[Node, ...]:
        return tuple(_open(part) for part in parts if not isinstance(part, Token))

    def matrix(self, parts: list[Any]) -> Node:
        return Matrix(tuple(part for part in parts if isinstance(part, tuple)))

    def norm(self, parts: list[Any]) -> Node:
        return Norm(_open(parts[1]))

    def root(self, parts: list[Node]) -> Node:
        return Call("sqrt", _open(parts[0]))

    def total(self, parts: list[Token]) -> Node:
        return _Mark("derivative")

    def partial_operator(self, parts: list[Any]) -> Node:
        return _Mark("derivative", by=_open(parts[-1]))

    def partial(self, parts: list[Any]) -> Node:
        above, below = (part for part in parts if not isinstance(part, Token))
        return Derivative(_open(above), _open(below))

    def quotient(self, parts: list[Any]) -> Node:
        above, below = _open(parts[1]), _open(parts[2])
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
        """{}^0_1R, as R_1^0."""
        node = parts[1]
        if not isinstance(node, Symbol):
            raise ValueError("a superscript before something that isn't a symbol")
        above, _, below = re.sub(r"[{}\s^]", "", str(parts[0])).partition("_")
        return replace(node, sup=above + node.sup, sub=below + node.sub)

    def slash(self, parts: list[Any]) -> Node:
        return _Slash(parts[0], parts[2])

    def arguments(self, parts: list[Any]) -> Node:
        return _Arguments(tuple(_open(part) for part in parts if not isinstance(part, Token)))

    def scripted(self, parts: list[Any]) -> Node:
        node: Node = parts[0]
        for script in parts[1:]:
            node = self._with_script(node, str(script))
        return node

    def _with_script(self, node: Node, script: str) -> Node:
        if "prime" in script or script.startswith("'"):
            if isinstance(node, Symbol):
                return replace(node, primes=node.primes + max(1, script.count("'")))
            raise ValueError("a prime on something that isn't a symbol")
        text = flatten(script[1:])
        if script.startswith("_"):
            if isinstance(node, _Group) and isinstance(_open(node), Symbol):  # {\rm s}_1
                node = _open(node)
            if isinstance(node, Symbol):
                kept = self._not_indices(script) or node.kept
                return replace(node, sub=node.sub + text, kept=kept)
            raise ValueError("a subscript on something that isn't a symbol")
        text = "T" if text in _TRANSPOSED else text
        transposed = text.endswith("T")
        label = text.removesuffix("T") if transposed else text
        if isinstance(node, _Group) and label.isdigit() and not transposed:
            return Power(node, int(label))  # still an argument: c(α + β)^2 is a squared cosine
        if not isinstance(node, _Mark):
            node = _open(node)
        if label == "-":  # J^{-T}
            label = "-1"
        if isinstance(node, _Mark) and label.startswith("-"):
            if node.name not in _INVERTED or label != "-1":
                raise ValueError(f"{node.name} with a negative exponent: write a fraction")
            return replace(node, name=f"arc{node.name}")
        if re.fullmatch(r"-\d", label):
            node = Power(node, int(label))
        elif label:
            if isinstance(node, _Mark):
                node = replace(node, exponent=int(label))
            elif isinstance(node, Symbol) and self._is_label(node, label):
                node = replace(node, sup=node.sup + label)
            elif label.isdigit() or label in ("i", "n"):
                node = Power(node, int(label) if label.isdigit() else label)
            else:
                raise ValueError(f"a superscript {label!r} that is neither a frame nor a power")
        return Transpose(node) if transposed else node

    def _not_indices(self, script: str) -> str:
        """Letters of a subscript that aren't indices, where there is a word in it."""
        if self.notation.ranges is None:
            return ""
        letters = "".join(letter for letter, _ in self.notation.ranges)
        words = re.findall(r"[a-zA-Z]{3,}", _FONTS.sub(" ", script))
        return letters if any(set(word) - set(letters) for word in words) else ""

    def _is_label(self, node: Symbol, label: str) -> bool:
        return (
            node.bold
            or label == "0"
            or not label.isdigit()
            or (node.base in self.notation.labelled)
        )

    def product(self, parts: list[Node | None]) -> Node:
        waiting = [part for part in parts if part is not None]
        factors: list[Node] = []
        while waiting:
            factors.append(self._next_factor(waiting))
        return factors[0] if len(factors) == 1 else Product(tuple(_open(f) for f in factors))

    def _next_factor(self, waiting: list[Node]) -> Node:
        node = waiting.pop(0)
        if isinstance(node, _Slash):
            return self._slashed(node, waiting)
        if isinstance(node, _Arguments):
            raise ValueError("a list in brackets after something that isn't a symbol")
        if isinstance(node, Symbol):
            follower = waiting[0] if waiting else None
            differs = node.base == "delta" and "delta" not in self.notation.declared
            if differs and isinstance(follower, Symbol | Derivative):
                follower = self._next_factor(waiting)
                if isinstance(follower, Symbol):
                    return replace(follower, base=f"delta:{follower.base}")
            plain = not (node.sub or node.sup or node.dots or node.bold)
            short = dict(self.notation.shorthand)
            if plain and node.base in short and self._is_angle(follower):
                node = _Mark("function", short[node.base])
        following = waiting[0] if waiting else None
        if isinstance(following, _Slash) and (
            isinstance(node, _Mark) or self._depends(node, following.above)
        ):
            if not isinstance(following.above, _Group | _Arguments):
                raise ValueError("a slash after a function: put brackets where they belong")
            waiting[0] = following.above
            whole = Quotient(self._next_factor([node, waiting.pop(0)]), _open(following.below))
            return self._unambiguous(whole, following, waiting)
        if isinstance(node, _Mark):
            if not waiting:
                raise ValueError(f"nothing follows {node.name or 'the derivative'}")
            return self._apply(node, self._argument(node, waiting))
        if isinstance(node, Power) and isinstance(following, _Group):
            # T^{-1}(θ) is the inverse of T(θ)
            inner = node.base
            if isinstance(inner, Symbol) and inner.name in self.notation.functions:
                waiting.pop(0)
                return Power(Call(inner.name, following.inside, inner.dots), node.exponent)
        if (
            isinstance(node, Symbol)
            and isinstance(following, Transpose)
            and self._says_only_dependence(following.of)
        ):
            waiting.pop(0)
            return Transpose(node)
        called = isinstance(node, Symbol) and node.name in self.notation.functions
        if isinstance(node, Symbol) and called and isinstance(following, _Group):
            waiting.pop(0)
            return Call(node.name, following.inside, node.dots)
        if self._depends(node, following):
            waiting.pop(0)
        return node

    def _argument(self, mark: _Mark, waiting: list[Node]) -> Node:
        """What a function or derivative is of: the factor after it, with a number before it."""
        if mark.name == "diag" and isinstance(waiting[0], _Arguments):
            return _Group(_diagonal(cast(_Arguments, waiting.pop(0)).of))
        if mark.name == "atan2":
            given = waiting.pop(0)
            if not isinstance(given, _Arguments) or len(given.of) != len(("y", "x")):
                raise ValueError("atan2 takes two numbers in brackets: atan2(y, x)")
            return _Group(Matrix(tuple((one,) for one in given.of)))
        first = self._next_factor(waiting)
        more = bool(waiting)
        multiple = mark.kind == "function" and isinstance(first, Number) and more
        if multiple and isinstance(waiting[0], Symbol | Power):  # cos 2θ
            return Product((first, self._next_factor(waiting)))
        loose = isinstance(first, Symbol | Number | Call) and self.notation.factors is not None
        if mark.kind == "derivative" and more and loose:
            raise ValueError("a derivative before several factors: put brackets where they belong")
        return first

    def _slashed(self, node: _Slash, waiting: list[Node]) -> Node:
        """A fraction on one line, of the two factors that its slash stands between."""
        if isinstance(node.above, _Mark) or isinstance(node.below, _Mark):
            raise ValueError("a slash beside a function: put brackets where they belong")
        whole = Quotient(_open(node.above), _open(node.below))
        return self._unambiguous(whole, node, waiting)

    @staticmethod
    def _unambiguous(whole: Quotient, node: _Slash, waiting: list[Node]) -> Node:
        if waiting and not isinstance(node.below, Number | _Group):
            raise ValueError("factors after a slash: put brackets where they belong")
        return whole

    def _depends(self, node: Node, following: Node | None) -> bool:
        """Whether what stands in brackets behind a symbol says only what it depends on."""
        if isinstance(node, Power) and self.notation.factors is not None:
            node = node.base  # M^{-1}(q)
        if not isinstance(node, Symbol):
            return False
        if isinstance(following, _Arguments):
            return all(self._says_only_dependence(one) for one in following.of)
        if not isinstance(following, _Group):
            return False
        inside, factors = following.inside, self.notation.factors
        if factors is not None and node.name in factors:
            return isinstance(inside, Symbol) and inside.name == "t"
        return self._says_only_dependence(inside)

    def _says_only_dependence(self, inside: Node) -> bool:
        return isinstance(inside, Symbol) and inside.name in self.notation.ignored_arguments

    @staticmethod
    def _is_angle(node: Node | None) -> bool:
        if isinstance(node, Power):
            node = node.base
        if isinstance(node, Symbol):
            return node.base in ("theta", "phi", "psi", "beta", "alpha", "gamma") and not node.bold
        return isinstance(node, _Group)

    @staticmethod
    def _apply(mark: _Mark, argument: Node) -> Node:
        if mark.kind == "derivative":
            return Derivative(_open(argument), mark.by)
        if mark.name == "diag":
            inside = _open(argument)
            return inside if isinstance(inside, Matrix) else _diagonal((inside,))
        exponent = mark.exponent
        # c θ^2 is the square of the cosine
        if isinstance(argument, Power) and isinstance(argument.exponent, int):
            exponent, argument = exponent * argument.exponent, argument.base
        call = Call(mark.name, _open(argument))
        return call if exponent == 1 else Power(call, exponent)

    def series(self, parts: list[Any]) -> Node:
        match = re.match(r"\\sum_\{(\w)=(\d+)\}\^\{?(\d+)\}?", str(parts[0]))
        assert match
        return Series(match[1], int(match[2]), int(match[3]), _open(parts[1]))

    def cross(self, parts: list[Any]) -> Node:
        return Cross(_open(parts[0]), _open(parts[2]))

    def dot(self, parts: list[Any]) -> Node:
        return Dot(_open(parts[0]), _open(parts[2]))

    def first_term(self, parts: list[Any]) -> Node:
        first: Node = parts[0]
        return first if len(parts) == 1 else Sum(((str(first), _open(parts[1])),))

    def sum(self, parts: list[Any]) -> Node:
        first: Node = parts[0]
        if len(parts) == 1:
            return first
        terms = list(first.terms) if isinstance(first, Sum) else [("+", _open(first))]
        signs, rest = parts[1::2], parts[2::2]
        terms += [(str(sign), _open(term)) for sign, term in zip(signs, rest, strict=True)]
        return Sum(tuple(terms))


def _differential(node: Node, sign: Node = Symbol("d")) -> Node | None:  # noqa: B008 - frozen
    """x of "dx"; None if it isn't one."""
    if isinstance(node, Product) and node.factors[0] == sign:
        rest = node.factors[1:]
        return rest[0] if len(rest) == 1 else Product(rest)
    return None


def _diagonal(entries: tuple[Node, ...]) -> Matrix:
    """The diagonal matrix of some entries."""
    zero = Number(0.0)
    numbers = range(len(entries))
    return Matrix(tuple(tuple(entries[i] if i == j else zero for j in numbers) for i in numbers))


def _open(node: Node) -> Node:
    """The node inside a bracket."""
    while isinstance(node, _Group):
        node = node.inside
    if isinstance(node, Power) and isinstance(node.base, _Group):
        return Power(_open(node.base), node.exponent)
    return node
