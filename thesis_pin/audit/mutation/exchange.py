"""What differs in two formulas of which one has a slip: a symbol, and what it stands in."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator

from thesis_pin.equations.formula import Derivative, Matrix, Node, Series, Sum, Symbol


def exchanged(old: Node, new: Node) -> tuple[Symbol, Symbol] | None:
    """The one symbol that gave way to another, and that other; None if more changed, or less."""
    first, second = Counter(_occurrences(old)), Counter(_occurrences(new))
    gone, come = list((first - second).elements()), list((second - first).elements())
    return (gone[0], come[0]) if len(gone) == len(come) == 1 else None


def replaced(old: Node, new: Node) -> list[tuple[Node, Node]]:
    """What differs in two formulas: the symbols, and what they are factors of, up to a sum."""
    path = [(old, new)]
    while not isinstance(path[-1][0], Symbol) and type(path[-1][0]) is type(path[-1][1]):
        parts = zip(*map(_parts, path[-1]), strict=False)
        pairs = [(one, other) for one, other in parts if one != other]
        if len(pairs) != 1:
            return []
        path += pairs
    upwards = reversed(path)
    return list(itertools.takewhile(lambda pair: not isinstance(pair[0], _WHOLE), upwards))


_WHOLE = (Sum, Matrix, Series, Derivative)
"""What has more in it than the factors of one product."""


def _parts(node: Node) -> list[Node]:
    """The formulas that a formula is made of."""

    def within(part: object) -> Iterator[Node]:
        if isinstance(part, Node):
            yield part
        elif isinstance(part, tuple):
            for one in part:
                yield from within(one)

    return list(within(tuple(vars(node).values())))


def _occurrences(node: object) -> Iterator[Symbol]:
    """The symbols of a formula, each as often as it stands there."""
    if isinstance(node, Symbol):
        yield node
    elif isinstance(node, tuple):
        for part in node:
            yield from _occurrences(part)
    elif isinstance(node, Node):
        yield from _occurrences(tuple(vars(node).values()))
