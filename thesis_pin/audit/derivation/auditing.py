"""A file of anyone's derivation and a robot → an audit."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from thesis_pin.audit.derivation import coordinates as coordinates_of
from thesis_pin.audit.derivation import meaning, phrases
from thesis_pin.audit.derivation.constants import number
from thesis_pin.audit.derivation.effects import EFFECTS, Effects
from thesis_pin.audit.derivation.file import check_formulas, read, two_sided
from thesis_pin.audit.derivation.phrases import Phrase
from thesis_pin.audit.derivation.references import Glossary, Key, References, key
from thesis_pin.audit.derivation.states import Frames, States
from thesis_pin.audit.derivation.tree import Tree
from thesis_pin.audit.derivation.varied import KINDS, varied
from thesis_pin.audit.residuals import TROUBLES, residual
from thesis_pin.audit.rows import HOLDS, AuditReport, Row
from thesis_pin.audit.thesis import Ground, Progress, Thesis
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.notation import Notation
from thesis_pin.errors import BadInput
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.loading import load

_ROTATIONS = frozenset({"R_x", "R_y", "R_z"})
_ONLY = "holds with this robot's numbers, but not when its {what} change"
_GRAVITY_TOLD = 1e-9
"""Difference from which two sizes of gravity count as two [m/s²]."""


@dataclass(frozen=True)
class DerivationThesis(Thesis):
    """A derivation, ready to be audited.

    Attributes:
        changes: What of the robot is changed to see whether a line holds for it alone.
        second: The references with those changes.
    """

    changes: tuple[str, ...] = ()
    second: References | None = None

    def audit(
        self,
        equations: Catalogue | None = None,
        *,
        only: Iterable[str] | None = None,
        with_effects: bool = True,
        jobs: int = 1,
        progress: Progress | None = None,
    ) -> AuditReport:
        """As :meth:`Thesis.audit`; lines that hold for this robot alone say so in a note."""
        equations = equations or self.catalogue()
        report = super().audit(
            equations, only=only, with_effects=with_effects, jobs=1, progress=progress
        )
        rows = tuple(self._noted(row, equations) for row in report.rows)
        alone = sum(row.note != old.note for row, old in zip(rows, report.rows, strict=True))
        told = f" {alone} hold with this robot's numbers alone." if alone else ""
        return replace(report, rows=rows, states=report.states + told)

    def _noted(self, row: Row, equations: Catalogue) -> Row:
        if row.verdict != "holds" or self.second is None:
            return row
        one = equations[row.id]
        if residual(equations, one, one.printed, self.second, row.left).value < HOLDS:
            return row
        note = _ONLY.format(what=" and ".join(self.changes))
        return replace(row, note=f"{row.note}; {note}" if row.note else note)


def thesis(file: str | Path, model: str | Path | ClosedRobot) -> DerivationThesis:
    """A derivation, ready to be audited.

    Args:
        file: Path of its TOML file.
        model: The robot it is about, or the path of its description: a tree of joints of one
            degree of freedom each.

    Raises:
        BadInput: A file can't be read, a formula isn't readable, or the words of the header
            don't fit the robot.
    """
    robot = model if isinstance(model, ClosedRobot) else load(model)
    named = robot.model.name if isinstance(model, ClosedRobot) else str(model)
    return _Made(file, robot, named).thesis


def audit_derivation(
    file: str | Path,
    model: str | Path | ClosedRobot,
    *,
    only: Iterable[str] | None = None,
    with_effects: bool = True,
    progress: Progress | None = None,
) -> AuditReport:
    """Hold every equation of a derivation against a robot.

    Args:
        file: Path of the derivation's TOML file.
        model: The robot it is about, or the path of its description: a tree of joints of one
            degree of freedom each.
        only: Ids to audit; None for all.
        with_effects: Follow each failing line to see what it does.
        progress: Wraps the loop over equations.

    Raises:
        BadInput: A file can't be read, a formula isn't readable, or the words of the header
            don't fit the robot.
    """
    found = thesis(file, model)
    return found.audit(only=only, with_effects=with_effects, progress=progress)


class _Made:
    """What is made of a file and a robot, step by step."""

    def __init__(self, path: str | Path, robot: ClosedRobot, model: str) -> None:
        self.where, self.robot, self.model = str(path), robot, model
        self.file, text = read(path)
        if robot.loops:
            raise BadInput(
                f"{robot.model.name} has closed loops",
                where=self.where,
                allowed="a tree: a derivation of a robot with loops needs references of its own",
            )
        self.tree, self.frames = Tree.of(robot.model), Frames.of(robot.model)
        if not self.tree.names:
            raise BadInput(f"{robot.model.name} has no joint that moves", where=self.where)
        said = self.file.coordinates
        self.coordinates = coordinates_of.read(said, self.tree.names, self.where)
        for coupling in robot.couplings:
            if tied := set(coupling.coefficients) & set(self.coordinates.joints):
                raise BadInput(
                    f"{', '.join(sorted(tied))} can't have a coordinate of its own: it follows "
                    f"another joint ({coupling.name})",
                    where=f"{self.where}: coordinates",
                )
        self.notation = self._notation()
        check_formulas(self.file, text, self.notation, self.where)
        self.fixed: set[str] = set()
        self.glossary = self._glossary()
        self._check_words()

    # -- the header ------------------------------------------------------------------------

    def _notation(self) -> Notation:
        header = self.file.derivation
        plain = Notation(ranges=(), words=header.words, shorthand=())
        given = [*self.file.coordinates, *self.file.constants]
        factors = frozenset(self._symbol(text, plain).name for text in given)
        named = [self._symbol(text, plain) for text in self.file.symbols]
        coordinates = [self._symbol(text, plain).name for text in self.file.coordinates]
        vectors = [
            symbol.name
            for symbol, words in zip(named, self.file.symbols.values(), strict=True)
            if words.strip().lower().startswith("coordinates")
        ]
        names = factors | {symbol.name for symbol in named}
        short = [(header.cos, "cos"), (header.sin, "sin")]
        return Notation(
            functions=_ROTATIONS - names,
            words=header.words,
            ignored_arguments=frozenset({"t", *coordinates, *vectors}),
            shorthand=tuple((letter, of) for letter, of in short if letter),
            declared=names,
            factors=factors,
            ranges=tuple(
                (letter, tuple(map(str, values))) for letter, values in header.indices.items()
            ),
        )

    def _symbol(self, text: str, notation: Notation) -> Symbol:
        try:
            return notation.symbol(text)
        except FormulaError as error:
            raise BadInput(f"{text!r}: {error.what}", where=f"{self.where}: a symbol") from None

    def _glossary(self) -> Glossary:
        header, names = self.file.derivation, self.notation
        constants: dict[Key, float | Phrase] = {}
        for text, value in self.file.constants.items():
            constants[key(self._symbol(text, names))] = self._constant(text, value)
        symbols: dict[Key, Phrase | Node] = {}
        for text, words in self.file.symbols.items():
            symbols[key(self._symbol(text, names))] = self._meaning(text, words)
        said = enumerate(self.file.coordinates)
        coordinates = {key(self._symbol(text, names)): k for k, text in said}
        return Glossary(coordinates, constants, symbols, header.cos, header.sin)

    def _constant(self, text: str, value: float | str) -> float | Phrase:
        where = f"{self.where}: constants.{text}"
        found = number(value, where)
        if found is None:
            return phrases.parse(str(value), where)
        size, fixed = found
        if abs(size - float(np.linalg.norm(self.gravity))) > _GRAVITY_TOLD:
            self.fixed |= fixed
        return size

    def _meaning(self, text: str, words: str) -> Phrase | Node:
        where = f"{self.where}: symbols.{text}"
        if not words.lstrip().startswith("="):
            return phrases.parse(words, where)
        try:
            (node,) = self.notation.parse(words.lstrip()[1:])
        except (FormulaError, ValueError) as error:
            raise BadInput(f"{words!r} can't be read: {error}", where=where) from None
        return node

    def _check_words(self) -> None:
        """Refuse what the robot doesn't have, and constants that change."""
        glossary = self.glossary
        said = (
            ("constants", self.file.constants, glossary.constants),
            ("symbols", self.file.symbols, glossary.symbols),
        )
        for table, texts, meant in said:
            for text, words in zip(texts, meant.values(), strict=True):
                where = f"{self.where}: {table}.{text}"
                if not isinstance(words, Phrase):
                    continue
                meaning.check(words, self.states, where)
                try:
                    value = self.references.meanings.of(words)
                except FormulaError as error:
                    raise BadInput(f"{words.quantity} {error.what}", where=where) from None
                if table == "constants" and np.ptp(value.array) > HOLDS:
                    raise BadInput(
                        f"the {words.quantity} isn't constant",
                        where=where,
                        remedy="Say it under [symbols]",
                    )

    # -- what judges -------------------------------------------------------------------------

    @cached_property
    def gravity(self) -> np.ndarray:
        """Free fall's acceleration [m/s²]."""
        said = self.file.derivation.gravity
        return np.array(self.robot.model.gravity.linear if said is None else said, dtype=float)

    @cached_property
    def states(self) -> States:
        """The states at which the lines are judged."""
        states = States.random(self.tree, self.frames, self.coordinates, self.gravity)
        states.check(self.robot.model)
        return states

    @cached_property
    def plain(self) -> Catalogue:
        """The equations as the file gives them."""
        return Catalogue([two_sided(one) for one in self.file.equation], self.notation)

    @cached_property
    def references(self) -> References:
        """What the symbols must equal."""
        return References(self.states, self.glossary, self.plain)

    @cached_property
    def catalogue(self) -> Catalogue:
        """The equations; those that only define a symbol are known to."""
        return Catalogue([self._told(one) for one in self.plain.equations], self.notation)

    def _told(self, one: Equation) -> Equation:
        definition = self._defines(one)
        if not definition or one.mending or len(one.printed) > 1:
            return one
        try:
            for indices in self.plain.indices(*map(self.plain.parse, (one.left, *one.printed))):
                evaluate(self.plain.parse(one.printed[0]), self.references, indices)
        except TROUBLES:
            return one
        reason = f"stated, not checkable: it defines {definition}, of which the file says no more"
        return Equation.made(**dict(one) | {"not_checkable": reason})

    def _defines(self, one: Equation) -> str:
        """Name of the symbol that an equation defines and that has no other meaning."""
        if one.illegible or one.not_checkable or one.left_printed:
            return ""
        left = self.plain.parse(one.left)
        if not isinstance(left, Symbol):
            return ""
        for indices in self.plain.indices(left):
            symbol = left.bound(indices)
            if self.references.known(symbol):
                return ""
            if self.plain.definitions[("", symbol.name, symbol.dots)][0] is not one:
                return ""
        return left.name

    @cached_property
    def changes(self) -> tuple[str, ...]:
        """What of the robot can be changed: what no number of the file says."""
        return tuple(kind for kind in KINDS if kind not in self.fixed)

    @cached_property
    def second(self) -> References | None:
        """The references with another robot's numbers."""
        if not self.changes:
            return None
        count = len(self.states.x)
        tree, frames = varied(self.tree, self.frames, self.changes, count)
        states = replace(self.states, tree=tree, frames=frames)
        return References(states, self.glossary, self.plain)

    @cached_property
    def thesis(self) -> DerivationThesis:
        """The derivation, ready to be audited."""
        header = self.file.derivation
        return DerivationThesis(
            name=header.title,
            robot=header.name,
            numbers=header.numbers,
            catalogue=lambda: self.catalogue,
            ground=lambda equations: Ground(
                self._described(),
                lambda equation: self.references,
                {},
                Effects(self.states, self.glossary, equations).of,
            ),
            causes={},
            beyond=lambda equations: (),
            effects=EFFECTS,
            command=f"thesis-pin audit {self.where} --model {self.model}",
            changes=self.changes,
            second=self.second,
        )

    def _described(self) -> str:
        still = [one for one in self.tree.names if one not in self.coordinates.joints]
        model, n = self.robot.model.name, self.coordinates.count
        told = [
            f"States: {len(self.states.x)}, seeded, of {model}, {n} of them moving a single "
            "coordinate.",
        ]
        if still:
            told.append(f"Joints that stand still at their zero: {', '.join(still)}.")
        if self.changes:
            changed = ", ".join(self.changes)
            told.append(f"What holds is tried with other {changed} of the robot, too.")
        return " ".join(told)
