"""A derivation's file and a robot, checked against each other: what its lines are judged by."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from pathlib import Path

import numpy as np

from thesis_pin.audit.derivation import meaning
from thesis_pin.audit.derivation.forces import forces
from thesis_pin.audit.derivation.moving import coordinates as coordinates_of
from thesis_pin.audit.derivation.moving.driven import driven, unforced
from thesis_pin.audit.derivation.moving.states import Frames, States
from thesis_pin.audit.derivation.moving.tree import Tree
from thesis_pin.audit.derivation.moving.varied import KINDS, varied
from thesis_pin.audit.derivation.references import References
from thesis_pin.audit.derivation.said.file import check_formulas, read, two_sided
from thesis_pin.audit.derivation.said.header import glossary, notation
from thesis_pin.audit.derivation.said.phrases import Phrase
from thesis_pin.audit.judging.residuals import TROUBLES
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Symbol, functions
from thesis_pin.errors import BadInput, ModelError
from thesis_pin.loops.closures import ClosedRobot

_MILLI = 1e-3
SMALL = 1e-8
"""Entries of the mass matrix [kg·m²], [kg] from which a slip of half a percent is seen: what counts
as zero is zero against 1e-3 (:mod:`thesis_pin.audit.judging.residuals`)."""


class Derivation:
    """A derivation's file and the robot that it is about, checked against each other.

    Args:
        path: The file.
        robot: The robot.

    Raises:
        BadInput: The file can't be read, a formula isn't readable, or the words of the header
            don't fit the robot.
    """

    def __init__(self, path: str | Path, robot: ClosedRobot) -> None:
        self.where, self.robot = str(path), robot
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
        self.notation = notation(self.file, self.where)
        check_formulas(self.file, text, self.notation, self.where)
        size = float(np.linalg.norm(self.gravity))
        self.glossary, self.fixed = glossary(self.file, self.notation, self.where, size)
        self._check_words()

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
        return self._driven(states)

    def _driven(self, states: States) -> States:
        """The states with the accelerations that follow from the forces that the file gives."""
        if not self.file.forces:
            return states
        numbers, law = forces(self.file, self.glossary, self.plain, self.where, states)
        return driven(states, numbers, law)

    @cached_property
    def unforced(self) -> tuple[tuple[str, References], ...]:
        """Symbols of coordinates, and the references where nothing pushes these: each, then all."""
        if self.file.forces:
            return ()
        every, found = tuple(range(self.coordinates.count)), []
        for chosen in dict.fromkeys((*((k,) for k in every), every)):
            try:
                states = driven(self.states, chosen, unforced(len(chosen)))
            except ModelError:
                continue
            symbols = ", ".join(self.coordinates.symbols[k] for k in chosen)
            found.append((symbols, References(states, self.glossary, self.plain)))
        return tuple(found)

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
        definition, chained = self._defines(one), dict(self.plain.chained(one))
        if not definition or one.mending or len(one.printed) != 1 + len(chained):
            return one
        if not all(self._is_new(one, symbol) for symbol in chained.values()):
            return one
        try:
            with np.errstate(all="ignore"):
                for indices in self.plain.indices(*map(self.plain.parse, (one.left, *one.printed))):
                    evaluate(self.plain.parse(one.printed[-1]), self.references, indices)
        except TROUBLES:
            return one
        names = ", ".join((definition, *(symbol.name for symbol in chained.values())))
        reason = f"stated, not checkable: it defines {names}, of which the file says no more"
        return Equation.made(**dict(one) | {"not_checkable": reason})

    def _defines(self, one: Equation) -> str:
        """Name of the symbol that an equation defines and that has no other meaning."""
        if one.illegible or one.not_checkable or one.left_printed:
            return ""
        left = self.plain.parse(one.left)
        if not isinstance(left, Symbol):
            return ""
        return left.name if self._is_new(one, left) else ""

    def _is_new(self, one: Equation, named: Symbol) -> bool:
        """Whether a line gives a symbol the only meaning that it has."""
        for indices in self.plain.indices(named):
            symbol = named.bound(indices)
            definition = self.plain.defined(symbol)
            if self.references.known(symbol) or definition is None or definition[0] is not one:
                return False
        return True

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
        return References(self._driven(states), self.glossary, self.plain)

    @cached_property
    def points(self) -> References | None:
        """The references of a robot of point masses; None if a given force would move no mass."""
        return self._of(self.states.of_points)

    @cached_property
    def millimetres(self) -> tuple[References | None, ...]:
        """The references of a robot that was said in mm, and of one of half the size."""
        return tuple(self._of(self.states.shrunk(scale)) for scale in (_MILLI, _MILLI / 2))

    def _of(self, states: States) -> References | None:
        try:
            return References(self._driven(states), self.glossary, self.plain)
        except ModelError:
            return None

    def _formulas(self) -> list[object]:
        """All that can be read of the file's formulas."""
        found: list[object] = list(self.glossary.symbols.values())
        for one in self.plain.equations:
            for text in filter(None, (one.left, *one.printed, *one.mending.values())):
                try:
                    found.append(self.plain.parse(text))
                except FormulaError:
                    continue
        return found

    @property
    def described(self) -> str:
        """The states, in words."""
        still = [one for one in self.tree.names if one not in self.coordinates.joints]
        model, n = self.robot.model.name, self.coordinates.count
        told = [
            f"States: {len(self.states.x)}, seeded, of {model}, {n} of them moving a single "
            "coordinate.",
        ]
        if still:
            told.append(f"Joints that stand still at their zero: {', '.join(still)}.")
        if self.file.forces:
            told.append(f"Accelerations follow from the forces of {', '.join(self.file.forces)}.")
        smallest = np.abs(self.references.meanings.mass_matrix()).max(axis=(0, 1)).min()
        if smallest < SMALL:
            told.append(
                f"Its bodies are so light that entries of the mass matrix are below {SMALL:.0e}: "
                "a slip in one of them can go unseen."
            )
        if "atan2" in functions(self._formulas()):
            told.append("Angles that an atan2 gives are compared up to whole turns.")
        if self.changes:
            changed = ", ".join(self.changes)
            told.append(f"What holds is tried with other {changed} of the robot, too.")
        return " ".join(told)
