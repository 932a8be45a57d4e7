"""A thesis followed all the way down: every symbol from its own definition."""

from __future__ import annotations

from dataclasses import replace

from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import Catalogue, Edition, Equation
from thesis_pin.equations.evaluation import Movable, evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.frames import ANY
from thesis_pin.equations.symbols import refuse_accelerations
from thesis_pin.equations.values import Value, imaginary, transpose

Slot = tuple[str, str, int, str]
"""A symbol's place in a cache: "" or "∂", name, dots, leg."""


REBUILT = "what follows from the rest stands in"
"""Said of a line that is lost and rebuilt."""


class UnusablePrint(FormulaError):
    """The one line that is to be followed as printed can't be evaluated."""


class EditionEnvironment:
    """Symbols as the thesis defines them, all the way down.

    Args:
        catalogue: The equations.
        references: What isn't defined by an equation: coordinates and constants.
        edition: Follow the print, or the corrections.
        printed_only: Ids to follow as printed although the edition is corrected.
        substituted: Where to note the lines that had to be replaced.

    Attributes:
        substituted: Ids of lines that can't be evaluated, with the reason; their
            corrected or rebuilt form stood in, or the reference where there is none.
    """

    def __init__(
        self,
        catalogue: Catalogue,
        references: Movable,
        edition: Edition = "corrected",
        printed_only: frozenset[str] = frozenset(),
        substituted: dict[str, str] | None = None,
    ) -> None:
        self.catalogue, self.references, self.edition = catalogue, references, edition
        self.printed_only = printed_only
        self.columns = references.columns
        self.substituted: dict[str, str] = {} if substituted is None else substituted
        self._values: dict[Slot, Value] = {}
        self._busy: list[Slot] = []
        self._users: dict[Slot, set[Slot]] = {}
        self._moved: dict[tuple[str | None, bool], EditionEnvironment] = {}

    def uses(self, identity: str) -> bool:
        """Whether anything evaluated so far rests on an equation."""
        definitions = self.catalogue.definitions
        return any(definitions[slot[:3]][0].id == identity for slot in self._users)

    def following_print(self, identity: str) -> EditionEnvironment:
        """The same symbols with one equation as printed; what doesn't depend on it is kept."""
        definitions = self.catalogue.definitions
        # Not only the values kept here: a derivative's states keep their own.
        waiting = [slot for slot in self._users if definitions[slot[:3]][0].id == identity]
        changed: set[Slot] = set()
        while waiting:
            slot = waiting.pop()
            if slot not in changed:
                changed.add(slot)
                waiting += self._users.get(slot, ())
        other = EditionEnvironment(
            self.catalogue, self.references, self.edition, frozenset({identity})
        )
        other._values = {k: v for k, v in self._values.items() if k not in changed}
        other._moved = {key: moved.following_print(identity) for key, moved in self._moved.items()}
        return other

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol from its definition, or the reference if it has none.

        A follower of the print computes numbers and keeps no account of frames.
        """
        found = self._defined("", symbol, indices)
        if found is not None:
            return found
        if symbol.dots and ("", symbol.name, symbol.dots - 1) in self.catalogue.definitions:
            return self.partial(replace(symbol, dots=symbol.dots - 1), None, indices)
        return self.references.lookup(symbol, indices).within(ANY)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative from its definition, else by a complex step through all definitions."""
        if by is not None and by.name == "q_j" and not by.dots and isinstance(of, Symbol):
            found = self._defined("∂", of.bound(indices), indices)
            if found is not None:
                return found
        if by is None and isinstance(of, Symbol):
            dotted = replace(of.bound(indices), dots=of.dots + 1)
            found = self._defined("", dotted, indices)
            if found is not None:
                return found
        refuse_accelerations(by)
        key = (None if by is None else by.name, bool(by and by.dots))
        if key not in self._moved:
            self._moved[key] = EditionEnvironment(
                self.catalogue,
                self.references.moved(*key),
                self.edition,
                self.printed_only,
                self.substituted,
            )
            # A derivative by a complex step uses what the symbols above it use.
            self._moved[key]._users, self._moved[key]._busy = self._users, self._busy
        return imaginary(evaluate(of, self._moved[key], indices))

    def _defined(self, kind: str, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        definition = self.catalogue.definitions.get((kind, symbol.name, symbol.dots))
        if definition is None:
            return None
        equation, bound = definition
        key = (kind, symbol.name, symbol.dots, indices.get("i", "") if not bound else "")
        users = self._users.get(key)
        if users is None:
            users = self._users[key] = set()
        if self._busy:
            users.add(self._busy[-1])
        if key in self._values:
            return self._values[key]
        if key in self._busy:  # defined by itself somewhere down the line
            return None
        self._busy.append(key)
        try:
            inner = {**{k: v for k, v in indices.items() if k in "ij"}, **bound}
            if "j" in inner and kind == "∂":
                inner.pop("j")
            value = self._evaluate(equation, symbol, inner)
        finally:
            self._busy.pop()
        if value is not None:
            self._values[key] = value
        return value

    def _evaluate(
        self, equation: Equation, symbol: Symbol, indices: dict[str, str]
    ) -> Value | None:
        literal = self.edition == "printed" or equation.id in self.printed_only
        if literal:
            try:
                if equation.left_printed:
                    raise FormulaError(f"nothing defines {equation.left}")
                value = self._last(equation, equation.printed, symbol, indices)
                self._check_shape(equation, value, indices)
                return value
            except FormulaError as error:
                if equation.id in self.printed_only:
                    raise UnusablePrint(error.what) from error
                rebuilt = f"; {REBUILT}" if equation.rebuilt else ""
                self.substituted[equation.id] = error.what + rebuilt
        try:
            return self._last(equation, equation.members("corrected"), symbol, indices)
        except FormulaError as error:
            if equation.mending or isinstance(error, UnusablePrint):
                raise
            self.substituted[equation.id] = f"{error.what}; the exact value stands in"
            return None

    def _check_shape(self, equation: Equation, value: Value, indices: dict[str, str]) -> None:
        node = self.catalogue.parse(equation.defines or equation.left)
        expected = evaluate(node, self.references, indices)
        if self._gives_transpose(equation):
            expected = transpose(expected)
        if min(value.rank, expected.rank) >= 0 and value.tail != expected.tail:
            raise FormulaError(f"is {value.describe()} where {expected.describe()} belongs")

    def _last(
        self, equation: Equation, members: tuple[str, ...], symbol: Symbol, indices: dict[str, str]
    ) -> Value:
        if not members:
            raise FormulaError(equation.illegible or "nothing is printed")
        node = self.catalogue.parse(members[-1])
        if (
            equation.defines
            and symbol.name == self.catalogue.notation.symbol(equation.defines).bound(indices).name
        ):
            node = self.catalogue.parse(members[-2])
            if isinstance(node, nt.Product):
                node = node.factors[0]
        value = evaluate(node, self, indices)
        return transpose(value) if self._gives_transpose(equation) else value

    def _gives_transpose(self, equation: Equation) -> bool:
        """Whether an equation defines kᵀ, not k."""
        left = self.catalogue.parse(equation.left)
        return isinstance(left.of if isinstance(left, nt.Derivative) else left, nt.Transpose)
