"""What following a printed line does in a line that uses it, where the law of motion doesn't.

The symbol that the line defines takes the printed value, all others what they must equal.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from thesis_pin.audit.judging.residuals import change
from thesis_pin.audit.rows import HOLDS, Effect
from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment, Unframed, evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.values import Value, transpose

TRIED = 24
"""Lines with the symbol that are followed, those behind it first."""


@dataclass
class Printed:
    """Symbols as they must be, but for the one that a printed line defines.

    Attributes:
        references: What symbols must equal.
        symbol: What the line defines, or differentiates by q_j.
        derived: Whether it does.
        value: Indices → what the print gives.
        columns: Number of generalized coordinates.
    """

    references: Environment
    symbol: Symbol
    derived: bool
    value: Callable[[dict[str, str]], Value]
    columns: int

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol."""
        if not self.derived and self._same(symbol, indices):
            return self.value(indices)
        return self.references.lookup(symbol, indices)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Value of a derivative."""
        if isinstance(of, Symbol):
            dotted = replace(of, dots=of.dots + 1)
            if self.derived and by == Symbol("q", "j") and self._same(of, indices):
                return self.value(indices)
            if not self.derived and by is None and self._same(dotted, indices):
                return self.value(indices)
        return self.references.partial(of, by, indices)

    def _same(self, symbol: Symbol, indices: dict[str, str]) -> bool:
        own, other = self.symbol.bound(indices), symbol.bound(indices)
        return (own.name, own.dots) == (other.name, other.dots)


class Following:
    """Failing lines followed in lines that use them; what these are without it is kept.

    Args:
        equations: All equations.
        references: Equation → what its symbols must equal.
    """

    def __init__(self, equations: Catalogue, references: Callable[[Equation], Environment]) -> None:
        self.equations, self.references = equations, references
        self._known: dict[str, frozenset[str]] = {}
        self._exact: dict[str, list[tuple[dict[str, str], Value]]] = {}

    def effect(self, equation: Equation) -> Effect:
        """Largest change of a line that uses a failing one, relative to its size.

        Returns:
            The change by the line's number or name; empty if none changes, or the print can't
            be read.
        """
        equations = self.equations
        defined, count = _defined(equations, equation), len(equation.printed)
        failing = min(equation.mending, default=1 if count == 1 else 0)
        if defined is None or not 0 < failing <= count:
            return {}
        left, derived, turned = defined
        try:
            node = equations.parse(equation.printed[failing - 1])
        except FormulaError:
            return {}

        found = {}
        for user in self._behind_first(equation):
            where = Unframed(self.references(user))

            def printed(indices: dict[str, str], where: Environment = where) -> Value:
                value = evaluate(node, where, indices)
                return transpose(value) if turned else value

            followed = Printed(where, left, derived, printed, where.columns)
            try:
                member = equations.parse(user.members("corrected")[-1])
                found[user.id] = max(
                    change(exact, evaluate(member, followed, indices))
                    for indices, exact in self._of(user, member, where)
                )
            except FormulaError:
                continue
        # To six digits, so that of equal changes the first is named on every machine.
        worst = max(found, key=lambda name: float(f"{found[name]:.6g}"), default="")
        if not worst or found[worst] < HOLDS:
            return {}
        number = equations[worst].number
        name = f"({number[0]})" if number else worst.split(":", 1)[1]
        return {f"change of {name}, which uses it, worst [-]": found[worst]}

    def _of(
        self, user: Equation, member: Node, where: Environment
    ) -> list[tuple[dict[str, str], Value]]:
        """What a line that uses failing ones must equal: most are used by several."""
        if user.id not in self._exact:
            each = self.equations.indices(self.equations.parse(user.left), member)
            self._exact[user.id] = [(i, evaluate(member, where, i)) for i in each]
        return self._exact[user.id]

    def _behind_first(self, equation: Equation) -> Iterator[Equation]:
        """Lines with the symbol, from the line on and then from the thesis's start."""
        equations = self.equations
        node = equations.parse(equation.left)
        defined = nt.symbols(node) - {Symbol("q", "j")}
        own = {one.bound(indices).name for one in defined for indices in equations.indices(node)}
        letters = {one.base.rpartition(":")[2] for one in defined}  # behind a font or an accent
        listed = equations.equations
        here = next(k for k, other in enumerate(listed) if other.id == equation.id)
        found = (
            other
            for other in (*listed[here:], *listed[:here])
            if other.id != equation.id
            and other.printed
            and not other.claim
            and any(one in text for one in letters for text in other.members("corrected"))
            and own & self._names(other)
        )
        yield from itertools.islice(found, TRIED)

    def _names(self, equation: Equation) -> frozenset[str]:
        """Names of the symbols in a line's members, as they should be."""
        if equation.id not in self._known:
            names: set[str] = set()
            for text in equation.members("corrected"):
                try:
                    inside = nt.symbols(self.equations.parse(text))
                except FormulaError:
                    continue
                for symbol in inside:
                    values = self.equations.indices(symbol)
                    names |= {symbol.bound(each).name for each in values}
            self._known[equation.id] = frozenset(names)
        return self._known[equation.id]


def _defined(equations: Catalogue, equation: Equation) -> tuple[Symbol, bool, bool] | None:
    """Symbol that a line defines; whether it is its derivative by q_j, and whether transposed."""
    try:
        node = equations.parse(equation.left)
    except FormulaError:
        return None  # a list of names, say
    derived = isinstance(node, nt.Derivative) and node.by == Symbol("q", "j")
    timed = isinstance(node, nt.Derivative) and node.by is None
    node = node.of if isinstance(node, nt.Derivative) and (derived or timed) else node
    turned = isinstance(node, nt.Transpose)
    node = node.of if isinstance(node, nt.Transpose) else node
    if not isinstance(node, Symbol):
        return None
    return (replace(node, dots=node.dots + 1) if timed else node), derived, turned
