"""What stands in a formula only while it is read: waiting functions, brackets, slashes."""

from __future__ import annotations

from dataclasses import dataclass

from thesis_pin.equations.formula import Matrix, Node, Number, Power, Quotient


@dataclass(frozen=True)
class Mark(Node):
    """Something waiting for the factor after it: a function, an operator, δ."""

    kind: str
    name: str = ""
    by: Node | None = None
    exponent: int = 1


@dataclass(frozen=True)
class Group(Node):
    """A bracketed expression; tells an argument from a factor."""

    inside: Node


@dataclass(frozen=True)
class Arguments(Node):
    """What a symbol depends on, as (q, t) after M, or the entries of a vector."""

    of: tuple[Node, ...]


@dataclass(frozen=True)
class Slash(Quotient):
    """A fraction on one line, of which the factors beside it may be parts."""


def column(listed: Arguments) -> Matrix:
    """The column of some entries."""
    return Matrix(tuple((one,) for one in listed.of))


def diagonal(entries: tuple[Node, ...]) -> Matrix:
    """The diagonal matrix of some entries."""
    zero = Number(0.0)
    numbers = range(len(entries))
    return Matrix(tuple(tuple(entries[i] if i == j else zero for j in numbers) for i in numbers))


def opened(node: Node) -> Node:
    """The node inside a bracket."""
    while isinstance(node, Group):
        node = node.inside
    if isinstance(node, Power) and isinstance(node.base, Group):
        return Power(opened(node.base), node.exponent)
    return node
