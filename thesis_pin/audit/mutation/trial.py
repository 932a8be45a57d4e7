"""Slips tried on the lines of a thesis: caught, an identity, or missed."""

from __future__ import annotations

import itertools
import random
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from thesis_pin.audit.judging.residuals import TROUBLES, difference, residual
from thesis_pin.audit.judging.verdicts import judge
from thesis_pin.audit.mutation.exchange import exchanged, replaced
from thesis_pin.audit.mutation.random_symbols import RandomSymbols
from thesis_pin.audit.mutation.slips import SLIPS, Planted, planted
from thesis_pin.audit.rows import HOLDS
from thesis_pin.audit.thesis import Ground
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment, evaluate
from thesis_pin.equations.formula import FormulaError, Node, Number, Symbol, symbols

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
            that the line is as true as before (or, where a line says that something is
            zero, of another thing that is); "missed": none of these.
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

    def __init__(
        self, equations: Catalogue, ground: Ground, each: int = EACH, seed: int = 1
    ) -> None:
        self.equations, self.ground, self.each, self.seed = equations, ground, each, seed
        self._random: dict[int, RandomSymbols] = {}
        self._known = frozenset(_names(equations))

    def of(self, equation: Equation) -> Iterator[Trial]:
        """All trials on one line, which has to hold."""
        if not self._holds(equation):
            return
        for kind in SLIPS:
            for member, slip in self._chosen(equation, kind):
                with np.errstate(all="ignore"):  # a slip may well divide by zero
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
                self.equations.forget(slip.text)
                continue
            strange = node is not None and not set(_symbol_names(node)) <= self._known
            (others if strange else best).append((number, slip))
            if len(best) == self.each:
                break
        chosen = (best + others)[: self.each]
        for _, slip in (best + others)[self.each :]:
            self.equations.forget(slip.text)
        yield from chosen

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
        if member == 0 and self._says_zero(equation):
            return self._of_zero(equation, before, slip)
        if self._identical(equation, before, slip):
            return "identity"
        return "same" if self._renamed(equation, before, slip) else "missed"

    def _says_zero(self, equation: Equation) -> bool:
        """Whether a line says nothing but that its left side is zero."""
        return all(self.equations.parse(text) == Number(0.0) for text in equation.printed)

    def _of_zero(self, equation: Equation, before: str, slip: Planted) -> Answer:
        """What else is zero: a multiple or the rate of what is, and other things by themselves."""
        if any(self._identical(equation, f"{times} ({before})", slip) for times in ("-", "2")):
            return "identity"
        change = exchanged(self.equations.parse(before), self.equations.parse(slip.text))
        if change and change[0].base != "q":  # ∂/∂q̇ says another thing than ∂/∂q
            old, new = change
            if new == replace(old, dots=old.dots + 1):
                return "identity"
            if slip.kind in ("index", "frame"):
                return "same"
        return "missed"

    def _identical(self, equation: Equation, before: str, slip: Planted) -> bool:
        """Whether the formula says the same with the slip, whatever its symbols are."""
        environment = self._at_random(self.ground.references(equation))
        try:
            found = residual(self.equations, equation, (slip.text,), environment, before)
        except TROUBLES:
            return False
        return found.value < HOLDS

    def _renamed(self, equation: Equation, before: str, slip: Planted) -> bool:
        """Whether one symbol gave way to another name of the same thing, which isn't zero.

        Or an index to one of its values, where the line holds for each by itself.

        Also where only the product is the same in which it stands: ω_5 × i_10 = ω_6 × i_10,
        since the axis of joint 6 is i_10 on either side of it.
        """
        sides = self.equations.parse(before), self.equations.parse(slip.text)
        change = exchanged(*sides)
        if not change:
            return False
        if any(change[0].bound(one) == change[1] for one in self.equations.indices(change[0])):
            return True  # the line for one leg or chain alone
        environment = self.ground.references(equation)
        return any(self._equal(*pair, environment) for pair in replaced(*sides))

    def _equal(self, old: Node, new: Node, environment: Environment) -> bool:
        """Whether two formulas are one value at all states, and not zero."""
        try:
            for indices in self.equations.indices(old, new):
                first, second = (evaluate(one, environment, indices) for one in (old, new))
                nothing = float(np.abs(first.array).max(initial=0.0)) < HOLDS  # but for rounding
                if nothing or difference(first, second) >= HOLDS:
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
