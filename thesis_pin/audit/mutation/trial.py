"""Slips tried on the lines of a thesis: caught, an identity, or missed."""

from __future__ import annotations

import itertools
import random
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, get_args

from thesis_pin.audit.mutation.random_symbols import RandomSymbols
from thesis_pin.audit.mutation.slips import SLIPS, Planted, planted
from thesis_pin.audit.residuals import TROUBLES, difference, residual
from thesis_pin.audit.rows import HOLDS
from thesis_pin.audit.thesis import Ground
from thesis_pin.audit.verdicts import judge
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment, evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol, symbols

EACH = 5
"""Slips of a kind tried in the members of a line, and as many on its left side."""

_LOOKED_AT = 8
"""Times as many slips are looked at for those of symbols in use: long lines have hundreds."""

Answer = Literal["caught", "identity", "same", "missed"]
ANSWERS: tuple[Answer, ...] = get_args(Answer)


@dataclass(frozen=True)
class Trial:
    """A slip put into a line that holds, and whether the audit noticed.

    Attributes:
        id: The line's.
        member: Number of the member with the slip; 0 is the left side.
        kind: Kind of the slip, of :data:`thesis_pin.audit.mutation.slips.SLIPS`.
        said: What became what.
        answer: "caught": the line doesn't hold with it; "identity": it says the same, shown
            at the audit's states and at random symbols; "same": the symbol that came is
            another name of what the one that went is, at every state of every robot, so
            that the line is as true as before; "missed": none of these.
    """

    id: str
    member: int
    kind: str
    said: str
    answer: Answer


class Trials:
    """Slips tried on lines of a thesis.

    Args:
        equations: The equations.
        ground: What they are judged by.
        each: Slips of a kind for the members, and for the left side, of a line.
        seed: Of the choice of slips.
    """

    def __init__(self, equations: Catalogue, ground: Ground, each: int = EACH, seed: int = 1):
        self.equations, self.ground, self.each, self.seed = equations, ground, each, seed
        self._random: dict[int, RandomSymbols] = {}
        self._known = frozenset(_names(equations))

    def of(self, equation: Equation) -> Iterator[Trial]:
        """All trials on one line, which has to hold."""
        if not self._holds(equation):
            return
        for kind in SLIPS:
            for member, slip in self._chosen(equation, kind):
                answer = self._answer(equation, member, slip)
                self.equations.forget(slip.text)
                yield Trial(equation.id, member, kind, slip.said, answer)

    def _chosen(self, equation: Equation, kind: str) -> Iterator[tuple[int, Planted]]:
        """Slips of a kind, drawn by the line's name, so that no other line changes them."""
        drawn = random.Random(zlib.crc32(f"{self.seed} {equation.id} {kind}".encode()))
        members = [
            (number, slip)
            for number, text in enumerate(equation.printed, start=1)
            if number not in equation.imposes
            for slip in planted(text, kind)
        ]
        left = [(0, slip) for slip in planted(equation.left_printed or equation.left, kind)]
        for pool in (members, left):
            drawn.shuffle(pool)
            yield from self._readable(equation, pool)

    def _readable(
        self, equation: Equation, pool: Iterable[tuple[int, Planted]]
    ) -> Iterator[tuple[int, Planted]]:
        """As many as are asked for that read as formulas, those of symbols in use first."""
        best: list[tuple[int, Planted]] = []
        others: list[tuple[int, Planted]] = []
        for number, slip in itertools.islice(pool, self.each * _LOOKED_AT):
            node = None if equation.claim else self._parsed(slip.text)
            if not equation.claim and node is None:
                continue
            strange = node is not None and not set(_symbol_names(node)) <= self._known
            (others if strange else best).append((number, slip))
            if len(best) == self.each:
                break
        yield from (best + others)[: self.each]

    def _parsed(self, text: str) -> Node | None:
        try:
            return self.equations.parse(text)
        except FormulaError:
            return None

    def _holds(self, equation: Equation) -> bool:
        ground = self.ground
        grounds = ground.references(equation), ground.substituted(equation)
        row = judge(self.equations, equation, grounds[0], ground.claims, "", grounds[1])
        return row.verdict == "holds"

    def _answer(self, equation: Equation, member: int, slip: Planted) -> Answer:
        if not self._holds(with_slip(equation, member, slip)):
            return "caught"
        before = equation.printed[member - 1] if member else equation.left_printed or equation.left
        if equation.claim:
            return "missed"
        if self._identical(equation, before, slip):
            return "identity"
        return "same" if self._renamed(equation, before, slip) else "missed"

    def _identical(self, equation: Equation, before: str, slip: Planted) -> bool:
        """Whether the formula says the same with the slip, whatever its symbols are."""
        environment = self._at_random(self.ground.references(equation))
        try:
            found = residual(self.equations, equation, (slip.text,), environment, before)
        except TROUBLES:
            return False
        return found.value < HOLDS

    def _renamed(self, equation: Equation, before: str, slip: Planted) -> bool:
        """Whether one symbol gave way to another name of the same thing, which isn't zero."""
        first, second = (Counter(occurrences(self.equations.parse(t))) for t in (before, slip.text))
        gone, come = list((first - second).elements()), list((second - first).elements())
        if len(gone) != 1 or len(come) != 1:
            return False
        environment = self.ground.references(equation)
        try:
            for indices in self.equations.indices(*gone, *come):
                old, new = (evaluate(symbol, environment, indices) for symbol in (*gone, *come))
                if not old.array.any() or difference(old, new) >= HOLDS:
                    return False
        except TROUBLES:
            return False
        return True

    def _at_random(self, environment: Environment) -> RandomSymbols:
        if id(environment) not in self._random:
            self._random[id(environment)] = RandomSymbols(environment)
        return self._random[id(environment)]


def with_slip(equation: Equation, member: int, slip: Planted) -> Equation:
    """The line with a slip in one of its members, or its left side if ``member`` is 0."""
    if member == 0:
        field = "left_printed" if equation.left_printed else "left"
        return equation.model_copy(update={field: slip.text})
    printed = list(equation.printed)
    printed[member - 1] = slip.text
    return equation.model_copy(update={"printed": tuple(printed)})


def occurrences(node: object) -> Iterator[Symbol]:
    """The symbols of a formula, each as often as it stands there."""
    if isinstance(node, Symbol):
        yield node
    elif isinstance(node, tuple):
        for part in node:
            yield from occurrences(part)
    elif isinstance(node, Node):
        yield from occurrences(tuple(vars(node).values()))


def _names(equations: Catalogue) -> Iterator[str]:
    """The names of all symbols in use."""
    for equation in equations.equations:
        for text in (equation.left, *equation.members("corrected")):
            try:
                node = equations.parse(text)
            except FormulaError:
                continue
            yield from _symbol_names(node)


def _symbol_names(node: Node) -> Iterator[str]:
    for symbol in symbols(node):
        yield _name(symbol)


def _name(symbol: Symbol) -> str:
    return symbol.name + "˙" * symbol.dots + "*" * symbol.bold
