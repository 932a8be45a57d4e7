"""Printed equations as data: one table a printed equation, in TOML files.

A file is read beside the thesis: each entry has the left side, every member of
the chain of equalities as printed, and, only where the print fails, what should
stand there instead. Nothing in a file says whether an equation is right; that
is computed (:mod:`thesis_pin.audit.judging.verdicts`).
"""

from __future__ import annotations

import copy
import functools
import itertools
import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from thesis_pin.equations import formula as nt
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.parsing.brackets import balanced
from thesis_pin.equations.parsing.layout import plain
from thesis_pin.model.specification import Key, Strict, read_toml

Edition = Literal["corrected", "printed"]


def _as_tuple(value: object) -> object:
    return (value,) if isinstance(value, str) else value


def _as_members(value: object) -> object:
    if isinstance(value, str):
        return {1: value}
    return {int(k): v for k, v in value.items()} if isinstance(value, dict) else value


Members = Annotated[tuple[str, ...], BeforeValidator(_as_tuple)]
Replacements = Annotated[dict[int, str], BeforeValidator(_as_members)]


class Equation(Strict):
    """One printed equation: a left side and the members it is set equal to.

    Attributes:
        id: ``robot:section:number or symbol``.
        number: Numbers printed beside it; empty for most definitions.
        left: Left side, LaTeX.
        printed: Members as printed, LaTeX, in order.
        corrected: Member number → what should be printed there.
        right: The same, where the printed statement is physically wrong and not
            just misprinted.
        attribution: Who made the slip, as far as one can guess.
        why: Reason of the guess.
        note: What a reader should know.
        left_printed: The left side as printed, where it isn't ``left``.
        imposes: Members that are conditions to be met ("= 0"), not identities.
        claim: Name of the check in code that decides, where no identity can.
        cause: Name of the slip that several equations share.
        kind: Kind of the slip, where the difference of the formulas doesn't show it;
            see :data:`thesis_pin.audit.comparison.kinds.KINDS`.
        illegible: What is missing in the text, if it can't be read.
        surviving: What of an illegible line can still be read, LaTeX.
        rebuilt: What follows for an illegible line from the rest of the thesis, LaTeX.
        line: Line of the thesis's source text where the statement begins, from 1; 0 if not said.
        misread: Member number → the member with all slips mended but those of its statement,
            where ``right`` says another statement.
        no_effect: Why following the print changes nothing, where that can't be computed.
        notation: Whether its notation alone fails, where a check in code gives no number that
            a reader would compute from it.
        not_checkable: Why nothing can be computed, if so.
        closed: Whether it holds only where the mechanism's loops are closed.
        defines: Symbol that stands for the first factor of the member before the last, as
            J in ``ḃ = [i j k …] q̇ = J q̇``.
        special: What of the robot's own shape it rests on, where it doesn't hold on one built
            alike whose axes point anywhere.
        free: Kind of states where nothing vanishes → numbers of the members that hold there.
    """

    id: Annotated[str, Field(pattern=r"^[a-z]+:[\w.]+:\S+$")]
    number: Members = ()
    left: str = ""
    printed: Members = ()
    corrected: Replacements = Field(default_factory=dict)
    right: Replacements = Field(default_factory=dict)
    attribution: Literal["thesis", "scan", ""] = ""
    why: str = ""
    note: str = ""
    left_printed: str = ""
    imposes: tuple[int, ...] = ()
    claim: str = ""
    cause: str = ""
    kind: Literal["frame", ""] = ""
    illegible: str = ""
    surviving: Members = ()
    rebuilt: Members = ()
    line: Annotated[int, Field(ge=0)] = 0
    misread: Replacements = Field(default_factory=dict)
    no_effect: str = ""
    notation: bool = False
    not_checkable: str = ""
    closed: bool = False
    defines: str = ""
    special: str = ""
    free: dict[str, tuple[int, ...]] = Field(default_factory=dict)

    @property
    def section(self) -> str:
        """Section of the thesis."""
        return self.id.split(":")[1]

    @property
    def mending(self) -> dict[int, str]:
        """Members to read differently, whether misprinted or wrong."""
        return {**self.corrected, **self.right}

    def members(self, edition: Edition) -> tuple[str, ...]:
        """Members as printed or as they should be.

        A number beyond the last member adds one; a member mended to "" is left out. Of a
        line that is lost, what follows for it from the rest.
        """
        if edition == "printed":
            return self.printed
        if self.rebuilt:
            return self.rebuilt
        count = max(len(self.printed), *self.mending, 0) if self.mending else len(self.printed)
        listed = [
            self.mending.get(k, self.printed[k - 1] if k <= len(self.printed) else "")
            for k in range(1, count + 1)
        ]
        return tuple(member for member in listed if member)


class EquationFile(Strict):
    """A file of equations."""

    equation: tuple[Equation, ...]

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Unique ids; mendings of members that exist; reasons for every mending."""
        seen: set[str] = set()
        for k, equation in enumerate(self.equation):
            key: Key = ("equation", k)
            if equation.id in seen:
                yield (*key, "id"), "used twice", equation.id
            seen.add(equation.id)
            silent = equation.illegible or equation.not_checkable
            if not equation.printed and not silent:
                yield (*key, "printed"), "missing, and neither illegible nor not_checkable", None
            if (equation.mending or equation.left_printed) and not (
                equation.attribution and equation.why
            ):
                yield key, "a correction needs attribution and why", equation.id
            if equation.kind and not equation.mending:
                yield (*key, "kind"), "there is no correction to be of a kind", equation.id
            if (equation.rebuilt or equation.surviving) and not equation.illegible:
                yield key, "only an illegible line is rebuilt", equation.id
            if not set(equation.misread) <= set(equation.right):
                yield (*key, "misread"), "belongs to members that `right` mends", equation.id
            if equation.notation and not (equation.claim and equation.corrected):
                yield (*key, "notation"), "is said of misprints that a check decides", equation.id
            if equation.corrected and equation.right:
                yield key, "either misprinted (corrected) or wrong (right), not both", equation.id


Definition = tuple[Equation, dict[str, str]]


class Catalogue:
    """All equations of a thesis, parsed.

    Args:
        equations: The equations in the thesis's order.
        notation: How its formulas are read.
    """

    def __init__(self, equations: Sequence[Equation], notation: Notation) -> None:
        self.equations = tuple(equations)
        self.notation = notation
        self._parsed: dict[str, Node | FormulaError] = {}

    @classmethod
    def read(cls, paths: Sequence[Path], notation: Notation) -> Catalogue:
        """Read files.

        Raises:
            SpecificationError: A file breaks the schema; lists every problem.
        """
        files = [read_toml("equations", EquationFile, path) for path in paths]
        return cls([equation for file in files for equation in file.equation], notation)

    def __getitem__(self, name: str) -> Equation:
        return self.by_id[name]

    @cached_property
    def by_id(self) -> dict[str, Equation]:
        """Equations by id."""
        return {equation.id: equation for equation in self.equations}

    def indices(self, *nodes: Node) -> Iterator[dict[str, str]]:
        """All values of the index letters that some formulas share."""
        ranges = self.notation.ranges
        if ranges is None:
            yield from index_values(*nodes)
            return
        found = {
            letter for one in nt.symbols(nodes) for letter in set(one.sub + one.sup) - set(one.kept)
        } - nt.summed(nodes)
        used = [(letter, values) for letter, values in ranges if letter in found]
        for chosen in itertools.product(*(values for _, values in used)):
            yield dict(zip((letter for letter, _ in used), chosen, strict=True))

    def with_equation(self, changed: Equation) -> Catalogue:
        """The same catalogue with one equation replaced by another of its id."""
        listed = [changed if e.id == changed.id else e for e in self.equations]
        other = Catalogue(listed, self.notation)
        other._parsed = self._parsed  # a formula reads the same everywhere
        return other

    def parse(self, formula: str) -> Node:
        """A single expression, read once."""
        if formula not in self._parsed:
            self._parsed[formula] = self._read(formula)
        found = self._parsed[formula]
        if isinstance(found, FormulaError):
            raise copy.copy(found)  # the one that is kept would keep all frames it passed
        return found

    def reads(self, formula: str) -> bool:
        """Whether a formula is a single expression, where nobody asks why it isn't."""
        if formula not in self._parsed and not balanced(plain(formula)):
            return False
        try:
            self.parse(formula)
        except FormulaError:
            return False
        return True

    def _read(self, formula: str) -> Node | FormulaError:
        try:
            sides = self.notation.parse(formula)
        except FormulaError as error:
            return copy.copy(error)  # without its traceback, which holds the parser's stack
        if len(sides) > 1:
            return FormulaError("is an equation where an expression belongs")
        return sides[0]

    def forget(self, formula: str) -> None:
        """Keep no longer what a formula was read into: long ones take megabytes."""
        self._parsed.pop(formula, None)

    @cached_property
    def definitions(self) -> dict[tuple[str, str, int], Definition]:
        """First definition of each symbol: ("" or "∂", name, dots) → equation and indices."""
        found: dict[tuple[str, str, int], Definition] = {}
        for equation in self.equations:
            if equation.claim or equation.not_checkable:
                continue
            if not (equation.printed or equation.mending or equation.rebuilt):
                continue
            for text in filter(None, (equation.left, equation.defines)):
                try:
                    node = self.parse(text)
                except FormulaError:
                    continue
                kind, symbol = "", node
                if isinstance(node, nt.Derivative) and node.by == Symbol("q", "j"):
                    kind, symbol = "∂", node.of
                if isinstance(symbol, nt.Transpose):
                    symbol = symbol.of
                if not isinstance(symbol, Symbol):
                    continue
                for indices in self.indices(node):
                    key = (kind, symbol.bound(indices).name, symbol.dots)
                    own = {k: v for k, v in indices.items() if k not in symbol.kept}
                    found.setdefault(key, (equation, own))
        return found

    def chained(self, equation: Equation) -> Iterator[tuple[str, Symbol]]:
        """Symbols that a line sets equal to its left side on the way to its last member."""
        for text in equation.members("corrected")[:-1]:
            try:
                node = self.parse(text)
            except FormulaError:
                continue
            if isinstance(node, Symbol):
                yield text, node

    @cached_property
    def _chained(self) -> dict[tuple[str, int], Definition]:
        found: dict[tuple[str, int], Definition] = {}
        for equation in self.equations:
            if equation.claim or equation.not_checkable:
                continue
            for _, symbol in self.chained(equation):
                for own in self.indices(symbol):
                    found.setdefault((symbol.bound(own).name, symbol.dots), (equation, own))
        return found

    def defined(self, symbol: Symbol) -> Definition | None:
        """First definition of a symbol whose indices are bound; None if there is none.

        A line defines what stands on its left, and what it sets equal to that on its way to its
        last member, as d_21 in d_12 = d_21 = 0.
        """
        name, dots = symbol.name, symbol.dots
        both = self.definitions.get(("", name, dots)), self._chained.get((name, dots))
        known = [one for one in both if one is not None]
        return min(known, key=lambda one: self._order[one[0].id], default=None)

    @cached_property
    def _order(self) -> dict[str, int]:
        return {equation.id: k for k, equation in enumerate(self.equations)}


_LETTERS = re.compile(r"theta|phi|psi|tau|times|ZMP|LDn")


def free_indices(*nodes: Node) -> set[str]:
    """Index letters among i and n that occur in subscripts or superscripts."""
    found: set[str] = set()
    for symbol in nt.symbols(tuple(nodes)):
        found |= _index_letters(symbol.sub) | _index_letters(symbol.sup)
    return found


@functools.cache
def _index_letters(text: str) -> frozenset[str]:
    """Index letters in one subscript or superscript."""
    return frozenset(_LETTERS.sub("", text)) & {"i", "n", "k"}


def index_values(*nodes: Node, also: str = "") -> Iterator[dict[str, str]]:
    """All values of free indices: leg i, link n (m is 2n − 1, its frame), interval k."""
    letters = free_indices(*nodes) | set(also)
    for i in ("1", "2") if "i" in letters else ("",):
        for n in "123456" if "n" in letters else ("",):
            for k in "123" if "k" in letters else ("",):
                yield {
                    **({"i": i} if i else {}),
                    **({"n": n, "m": str(2 * int(n) - 1)} if n else {}),
                    **({"k": k} if k else {}),
                }
