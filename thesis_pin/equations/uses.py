"""Which lines of a thesis a line uses, and which lines use it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError, Node, Symbol

Uses = Mapping[str, tuple[str, ...]]
"""Id of a line → ids of other lines, in the thesis's order."""


def uses(catalogue: Catalogue, only: Iterable[str] | None = None) -> dict[str, tuple[str, ...]]:
    """The lines that define what each line's members are made of.

    A symbol's first definition counts. Of a rate that no line defines it is that of the
    symbol itself, and of a derivative by q_j likewise.

    Args:
        catalogue: The equations.
        only: Ids of the lines asked for; None for all.
    """
    order = {equation.id: k for k, equation in enumerate(catalogue.equations)}
    return {
        equation.id: tuple(sorted({*_used(catalogue, equation)}, key=order.__getitem__))
        for equation in (catalogue.equations if only is None else map(catalogue.__getitem__, only))
    }


def used_by(found: Uses) -> dict[str, tuple[str, ...]]:
    """The lines that use each line, from what each uses."""
    turned: dict[str, list[str]] = {name: [] for name in found}
    for user, names in found.items():
        for name in names:
            turned[name].append(user)
    return {name: tuple(users) for name, users in turned.items()}


def _used(catalogue: Catalogue, equation: Equation) -> Iterator[str]:
    for text in (*equation.printed, *equation.mending.values()):
        try:
            node = catalogue.parse(text)
        except FormulaError:
            continue  # the print can't be read; what it should be can
        for indices in catalogue.indices(node):
            for kind, symbol in _named(node):
                name, dots = symbol.bound(indices).name, symbol.dots
                ways = [(kind, name, dots), *(("", name, k) for k in range(dots, -1, -1))]
                found = next((way for way in ways if way in catalogue.definitions), None)
                if found:
                    user = catalogue.definitions[found][0].id
                    if user != equation.id:
                        yield user


def _named(node: object) -> Iterator[tuple[str, Symbol]]:
    """All symbols of a formula, "∂" with those that are differentiated by q_j."""
    match node:
        case Symbol():
            yield "", node
        case nt.Derivative(Symbol() as of, by):
            if by is None:
                yield "", _dotted(of)
            else:
                yield ("∂" if by == Symbol("q", "j") else ""), of
                yield from _named(by)
        case tuple() | list():
            for part in node:
                yield from _named(part)
        case Node():
            yield from _named(tuple(vars(node).values()))


def _dotted(symbol: Symbol) -> Symbol:
    return replace(symbol, dots=symbol.dots + 1)
