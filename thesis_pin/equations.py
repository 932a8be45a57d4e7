"""Printed equations as data: one table a printed equation, in TOML files.

A file is read beside the thesis: each entry has the left side, every member of
the chain of equalities as printed, and, only where the print fails, what should
stand there instead. Nothing in a file says whether an equation is right; that
is computed (:mod:`thesis_pin.audit`).
"""

from __future__ import annotations

import difflib
import itertools
import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from thesis_pin import notation as nt
from thesis_pin.evaluation import Movable, Value, evaluate, imaginary
from thesis_pin.notation import FormulaError, Node, Notation, Symbol
from thesis_pin.specification import Key, Strict, read_toml

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
        illegible: What is missing in the text, if it can't be read.
        not_checkable: Why nothing can be computed, if so.
        defines: Symbol that stands for the first factor of the member before the last, as
            J in ``ḃ = [i j k …] q̇ = J q̇``.
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
    illegible: str = ""
    not_checkable: str = ""
    defines: str = ""

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

        A number beyond the last member adds one; a member mended to "" is left out.
        """
        if edition == "printed":
            return self.printed
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
        self._parsed: dict[str, Node] = {}

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

    def with_equation(self, changed: Equation) -> Catalogue:
        """The same catalogue with one equation replaced by another of its id."""
        listed = [changed if e.id == changed.id else e for e in self.equations]
        other = Catalogue(listed, self.notation)
        other._parsed = self._parsed  # a formula reads the same everywhere
        return other

    def parse(self, formula: str) -> Node:
        """A single expression, read once."""
        if formula not in self._parsed:
            sides = self.notation.parse(formula)
            if len(sides) > 1:
                raise FormulaError("is an equation where an expression belongs")
            self._parsed[formula] = sides[0]
        return self._parsed[formula]

    def places(self, before: str, after: str) -> list[str]:
        """Where two formulas differ, symbol by symbol, each place in words."""
        (*cut,) = (_pieces(text)[0] for text in (before, after))
        unit = _pieces(before)[1]
        found = []
        for kind, a, b, c, d in difflib.SequenceMatcher(None, *cut, autojunk=False).get_opcodes():
            if kind == "equal":
                continue
            old, new = (
                _counted(cut[0][a:b]) if unit == "column" else " ".join(cut[0][a:b]),
                _counted(cut[1][c:d]) if unit == "column" else " ".join(cut[1][c:d]),
            )
            where = f"{unit} {a + 1}"
            if kind == "insert":
                beside = f" after {cut[0][a - 1]}" if a else " at the start"
                found.append(f"{where}: {new} is missing{beside}")
            elif kind == "delete":
                found.append(f"{where}: {old} should not be there")
            else:
                found.append(f"{where}: {old} should be {new}")
        return found

    @cached_property
    def definitions(self) -> dict[tuple[str, str, int], Definition]:
        """First definition of each symbol: ("" or "∂", name, dots) → equation and indices."""
        found: dict[tuple[str, str, int], Definition] = {}
        for equation in self.equations:
            if equation.claim or not (equation.printed or equation.mending):
                continue
            for text in filter(None, (equation.left, equation.defines)):
                try:
                    node = self.parse(text)
                except FormulaError:
                    continue
                kind, symbol = "", node
                if isinstance(node, nt.Derivative) and node.by == Symbol("q", "j"):
                    kind, symbol = "∂", node.of
                if not isinstance(symbol, Symbol):
                    continue
                for indices in index_values(node):
                    key = (kind, symbol.bound(indices).name, symbol.dots)
                    found.setdefault(key, (equation, indices))
        return found


_LETTERS = re.compile(r"theta|phi|psi|tau|ZMP")


def free_indices(*nodes: Node) -> set[str]:
    """Index letters among i and n that occur in subscripts or superscripts."""
    found: set[str] = set()
    for symbol in nt.symbols(tuple(nodes)):
        for text in (symbol.sub, symbol.sup):
            found |= set(_LETTERS.sub("", text)) & {"i", "n", "k"}
    return found


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


_SCRIPT = r"(?:\s*[_^]\s*(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\?\w))"
_PIECE = re.compile(
    rf"∂[^ ]+/∂[^ ]+|(?:\\d?dot\{{[^{{}}]*\}}|\\[a-zA-Z]+|[A-Za-z]\d?|\d+(?:\.\d+)?)'*{_SCRIPT}*|\\\\|\S"
)
_LAYOUT = re.compile(
    r"\\(?:begin|end)\{\w+\}(?:\{[clr| ]*\})?|\\(?:left|right|[bB]igg?[lr]?|c?l?dots)\b\.?"
)


def _pieces(formula: str) -> tuple[list[str], str]:
    """A formula cut for comparison: into columns if it is a row, else into symbols.

    Fonts and layout are left out; what a piece is called comes with them.
    """
    text = re.sub(r"\\(?:mathbf|boldsymbol)\s*\{((?:[^{}]|\{[^{}]*\})*)\}", r"\1", formula)
    simple = (
        r"\\frac\{\\partial ([^{} ]*(?:\{[^{}]*\}[^{} ]*)*)\}\{\\partial ([^{} ]*(?:\{[^{}]*\})?)\}"
    )
    text = _LAYOUT.sub(" ", re.sub(simple, r"∂\1/∂\2", text))
    cells = re.split(r"&|\\quad", text.replace("\\\\", "&"))
    if len(cells) > 4:
        return [" ".join(re.sub(r"[\[\]]", "", cell).split()) for cell in cells], "column"
    return _PIECE.findall(text), "symbol"


def _counted(cells: Sequence[str]) -> str:
    """Cells in words, runs of equal ones counted: ``0, 0, 0`` → ``3 × 0``."""
    runs = [(cell, len(list(group))) for cell, group in itertools.groupby(cells)]
    return ", ".join(f"{count} × {cell}" if count > 1 else cell for cell, count in runs)


Slot = tuple[str, str, int, str]
"""A symbol's place in a cache: "" or "∂", name, dots, leg."""


class EditionEnvironment:
    """Symbols as the thesis defines them, all the way down.

    Args:
        catalogue: The equations.
        references: What isn't defined by an equation: coordinates and constants.
        edition: Follow the print, or the corrections.
        printed_only: Ids to follow as printed although the edition is corrected.
        substituted: Where to note the lines that had to be replaced.

    Attributes:
        substituted: Ids of printed lines that can't be evaluated, with the reason;
            their corrected form stood in.
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
        waiting = [slot for slot in self._values if definitions[slot[:3]][0].id == identity]
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
        return other

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol from its definition, or the reference if it has none."""
        found = self._defined("", symbol, indices)
        if found is not None:
            return found
        if symbol.dots and ("", symbol.name, symbol.dots - 1) in self.catalogue.definitions:
            below = Symbol(
                symbol.base, symbol.sub, symbol.sup, symbol.dots - 1, symbol.primes, symbol.bold
            )
            return self.partial(below, None, indices)
        return self.references.lookup(symbol, indices)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative from its definition, else by a complex step through all definitions."""
        if by is not None and by.name == "q_j" and not by.dots and isinstance(of, Symbol):
            found = self._defined("∂", of.bound(indices), indices)
            if found is not None:
                return found
        if by is None and isinstance(of, Symbol):
            dotted = of.bound(indices)
            dotted = Symbol(
                dotted.base, dotted.sub, dotted.sup, dotted.dots + 1, dotted.primes, dotted.bold
            )
            found = self._defined("", dotted, indices)
            if found is not None:
                return found
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
        if self._busy:
            self._users.setdefault(key, set()).add(self._busy[-1])
        if key in self._values:
            return self._values[key]
        if key in self._busy:  # defined by itself somewhere down the line
            return None
        self._busy.append(key)
        try:
            inner = {**{k: v for k, v in indices.items() if k in "ij"}, **bound}
            if "j" in inner and kind == "∂":
                inner.pop("j")
            self._values[key] = self._evaluate(equation, symbol, inner)
        finally:
            self._busy.pop()
        return self._values[key]

    def _evaluate(self, equation: Equation, symbol: Symbol, indices: dict[str, str]) -> Value:
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
                    raise
                self.substituted[equation.id] = error.what
        return self._last(equation, equation.members("corrected"), symbol, indices)

    def _check_shape(self, equation: Equation, value: Value, indices: dict[str, str]) -> None:
        node = self.catalogue.parse(equation.defines or equation.left)
        expected = evaluate(node, self.references, indices)
        if min(value.rank, expected.rank) >= 0 and value.tail != expected.tail:
            raise FormulaError(f"is {value.describe()} where {expected.describe()} belongs")

    def _last(
        self, equation: Equation, members: tuple[str, ...], symbol: Symbol, indices: dict[str, str]
    ) -> Value:
        if not members:
            raise FormulaError("nothing is printed")
        node = self.catalogue.parse(members[-1])
        if (
            equation.defines
            and symbol.name == self.catalogue.notation.symbol(equation.defines).bound(indices).name
        ):
            node = self.catalogue.parse(members[-2])
            if isinstance(node, nt.Product):
                node = node.factors[0]
        return evaluate(node, self, indices)
