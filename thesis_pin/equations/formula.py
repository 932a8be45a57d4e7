"""The parts of a formula: what the notation is read into."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass, replace

from thesis_pin.errors import BadInput


class FormulaError(BadInput):
    """A formula can't be read or evaluated."""


class Unreadable(FormulaError):
    """A formula isn't in the notation.

    Attributes:
        position: Number of the character at which that shows, from 0.
    """

    def __init__(self, what: str, position: int) -> None:
        self.position = position
        super().__init__(what, allowed="the notation of notation.lark")


class FrameError(FormulaError):
    """A formula puts together what is seen from different frames."""


class Node:
    """Base of all parts of a formula."""

    @functools.cached_property
    def symbols(self) -> frozenset[Symbol]:
        """All symbols in it."""
        found: set[Symbol] = set()
        waiting: list[object] = [self]
        while waiting:
            part = waiting.pop()
            if isinstance(part, Symbol):
                found.add(part)
            elif isinstance(part, tuple | list):
                waiting += part
            elif isinstance(part, Node):
                waiting += vars(part).values()
        return frozenset(found)


@dataclass(frozen=True)
class Number(Node):
    """A number; 0 stands for a zero of any shape."""

    value: float


@dataclass(frozen=True)
class Symbol(Node):
    """A letter with its marks: ``\\dot{\\mathbf{e}}_{9i}^0`` has one dot, "9i" and "0".

    Attributes:
        base: Letter, Greek ones by name ("theta"), fonts other than bold in front ("bb:D").
        sub, sup: Flattened sub- and superscript; frames and labels only, no powers.
        dots: Number of dots.
        primes: Number of primes.
        bold: Whether it is printed bold.
        kept: Index letters that stay in its name when others are replaced; see
            :class:`thesis_pin.equations.notation.Notation`.
    """

    base: str
    sub: str = ""
    sup: str = ""
    dots: int = 0
    primes: int = 0
    bold: bool = False
    kept: str = ""

    @property
    def symbols(self) -> frozenset[Symbol]:
        """Itself."""
        return frozenset({self})

    @functools.cached_property
    def name(self) -> str:
        """Key for look-ups: the symbol in plain characters, without its dots."""
        text = self.base + "'" * self.primes
        return text + (f"_{self.sub}" if self.sub else "") + (f"^{self.sup}" if self.sup else "")

    def bound(self, indices: dict[str, str]) -> Symbol:
        """The symbol with index letters replaced, for instance i by 1."""
        if self._letters.isdisjoint(indices):
            return self
        key = tuple(indices.items())
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = _bound(self, key)
        return found

    @functools.cached_property
    def _known(self) -> dict[tuple[tuple[str, str], ...], Symbol]:
        """What it was bound to before: indices → symbol."""
        return {}

    @functools.cached_property
    def _letters(self) -> frozenset[str]:
        """What may be index letters."""
        return frozenset(self.sub + self.sup) - set(self.kept)


@functools.lru_cache(maxsize=65536)
def _bound(symbol: Symbol, pairs: tuple[tuple[str, str], ...]) -> Symbol:
    indices = {letter: value for letter, value in pairs if letter not in symbol.kept}

    def put(text: str) -> str:
        # A name inside a subscript ("thetaB", "3times3") isn't a run of indices.
        parts = re.split(r"(theta|phi|psi|times)", text)
        return "".join(
            part if k % 2 else "".join(indices.get(letter, letter) for letter in part)
            for k, part in enumerate(parts)
        )

    return replace(symbol, sub=put(symbol.sub), sup=put(symbol.sup))


@dataclass(frozen=True)
class Sum(Node):
    """Terms with their signs."""

    terms: tuple[tuple[str, Node], ...]


@dataclass(frozen=True)
class Product(Node):
    """Factors multiplied from the left."""

    factors: tuple[Node, ...]


@dataclass(frozen=True)
class Cross(Node):
    """Vector product."""

    left: Node
    right: Node


@dataclass(frozen=True)
class Dot(Node):
    """Scalar product of vectors, or a product with a scalar."""

    left: Node
    right: Node


@dataclass(frozen=True)
class Quotient(Node):
    """Numerator over denominator."""

    above: Node
    below: Node


@dataclass(frozen=True)
class Power(Node):
    """A scalar to an integer power (or an index letter's), a matrix to the power −1."""

    base: Node
    exponent: int | str


@dataclass(frozen=True)
class Transpose(Node):
    """Transpose of a vector or matrix."""

    of: Node


@dataclass(frozen=True)
class Call(Node):
    """A function of the notation: "cos", "R_x", "T_z4" …, with dots if it has any.

    That of two numbers, "atan2", is of the column of them.
    """

    function: str
    argument: Node
    dots: int = 0


@dataclass(frozen=True)
class Derivative(Node):
    """Partial derivative by a symbol; by None: d/dt."""

    of: Node
    by: Symbol | Node | None


@dataclass(frozen=True)
class Series(Node):
    """Sum over an index."""

    index: str
    first: int
    last: int
    body: Node


@dataclass(frozen=True)
class Matrix(Node):
    """Rows of blocks."""

    rows: tuple[tuple[Node, ...], ...]


@dataclass(frozen=True)
class Norm(Node):
    """Euclidean length; between single bars also a number's size or a matrix's determinant."""

    of: Node
    single: bool = False


def symbols(node: object) -> frozenset[Symbol]:
    """All symbols in a formula, or in several."""
    if isinstance(node, Node):
        return node.symbols
    if isinstance(node, tuple | list):
        return frozenset().union(*(symbols(part) for part in node))
    return frozenset()


def functions(node: object) -> set[str]:
    """Names of all functions in a formula."""
    if isinstance(node, tuple | list):
        return set().union(*(functions(part) for part in node)) if node else set()
    if isinstance(node, Node):
        own = {node.function} if isinstance(node, Call) else set()
        return own | functions(tuple(vars(node).values()))
    return set()


def summed(node: object) -> set[str]:
    """Index letters that sums in a formula run over."""
    if isinstance(node, tuple | list):
        return set().union(*(summed(part) for part in node)) if node else set()
    if isinstance(node, Node):
        own = {node.index} if isinstance(node, Series) else set()
        return own | summed(tuple(vars(node).values()))
    return set()
