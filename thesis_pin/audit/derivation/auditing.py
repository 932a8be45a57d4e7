"""A file of anyone's derivation and a robot → an audit."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from thesis_pin.audit.derivation.branches import branch
from thesis_pin.audit.derivation.effects import EFFECTS, Effects
from thesis_pin.audit.derivation.ground import Derivation
from thesis_pin.audit.derivation.mends import mends
from thesis_pin.audit.derivation.points import names_inertia, of_points
from thesis_pin.audit.derivation.references import References
from thesis_pin.audit.judging.residuals import residual
from thesis_pin.audit.rows import HOLDS, AuditReport, Row
from thesis_pin.audit.thesis import Ground, Progress, Thesis
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.loading import load

_ONLY = "holds with this robot's numbers, but not when its {what} change"
_UNFORCED = (
    "it would hold with no generalized force on {what}: if that is meant, say it in [forces]"
)
MOST_GUESSED = 10
"""Failing lines for which a change is looked for that would make them hold; asked for by
themselves, all of them. It takes up to some seconds for each."""
_POINTS = "it would hold for point masses: the robot's bodies have inertia about their centres"
_INERTIAS = "it would hold without the bodies' inertias: look at their terms"
_MILLIMETRES = "it would hold if the robot's lengths were in mm: a URDF is in m, kg·m² and rad"
NEARLY = 1e-4
"""Residual of a line that no single slip explains, below which its numbers are likelier rounded
than its formula wrong [-]: π/2 as 1.5708 makes 4e-6, a length of five digits 1e-5."""
_NEARLY = (
    "it holds to {gap:.0e}: a number may be rounded, in the file or in the robot (1.5708 for π/2)"
)
_COLUMNS = "vectors, and derivatives of a number by all coordinates, are columns here"
_GUESS = ("with one change it would hold: {what}", "with any of these it would hold: {what}")


@dataclass(frozen=True)
class DerivationThesis(Thesis):
    """A derivation, ready to be audited.

    Attributes:
        changes: What of the robot is changed to see whether a line holds for it alone.
        references: What the symbols must equal, for this robot and for changed ones.
        unforced: The same where nothing pushes some coordinates, with their symbols.
        points: The same for a robot of point masses.
        millimetres: The same for a robot whose file was written in millimetres, and for one of half
            the size.
    """

    changes: tuple[str, ...] = ()
    references: tuple[References, ...] = ()
    unforced: Callable[[], tuple[tuple[str, References], ...]] = tuple
    points: References | None = None
    millimetres: Callable[[], tuple[References | None, ...]] = tuple

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
        with np.errstate(all="ignore"):  # what isn't finite is that line's error
            report = super().audit(
                equations, only=only, with_effects=with_effects, jobs=1, progress=progress
            )
            failing = [row.id for row in report.rows if row.verdict == "unexplained"]
            guessed = set(failing[:MOST_GUESSED])
            rows = tuple(self._noted(row, equations, guessed) for row in report.rows)
        noted = (new for new, old in zip(rows, report.rows, strict=True) if new.note != old.note)
        alone = sum(row.verdict == "holds" for row in noted)
        told = f" {alone} hold with this robot's numbers alone." if alone else ""
        return replace(report, rows=rows, states=report.states + told)

    def _noted(self, row: Row, equations: Catalogue, guessed: set[str]) -> Row:
        one = equations[row.id]
        if (
            row.id in guessed
            and row.verdict == "unexplained"
            and not one.mending
            and not one.illegible
        ):
            return replace(
                row, note="; ".join(filter(None, (row.note, self._guess(row, equations))))
            )
        if row.verdict != "holds" or all(
            residual(equations, one, one.printed, other, row.left).value < HOLDS
            for other in self.references[1:]
        ):
            return row
        note = _ONLY.format(what=" and ".join(self.changes))
        return replace(row, note=f"{row.note}; {note}" if row.note else note)

    def _passive(self, row: Row, equations: Catalogue) -> str:
        """That a failing line would hold if nothing pushed some coordinate; empty if not."""
        one = equations[row.id]
        if row.residual_printed is None or not math.isfinite(row.residual_printed):
            return ""
        for symbols, references in self.unforced():
            if residual(equations, one, one.printed, references, row.left).value < HOLDS:
                return _UNFORCED.format(what=symbols)
        return ""

    def _in_millimetres(self, row: Row, one: Equation, equations: Catalogue) -> bool:
        """Whether a line holds if the robot was said in millimetres, and isn't just too small then.

        In a robot of half that size what a slip makes is even smaller, but lengths that the file
        gives differ from it.
        """
        sizes = () if row.reason else self.millimetres()
        holds = [
            size is not None and residual(equations, one, one.printed, size, row.left).value < HOLDS
            for size in sizes
        ]
        return holds == [True, False]

    def _guess(self, row: Row, equations: Catalogue) -> str:
        """What would make a line hold that fails and that nothing is given in the place of."""
        one = equations[row.id]
        if "1×" in row.reason:  # a row somewhere
            turned = [rf"({text})^\top" for text in one.printed]
            found = residual(equations, one, turned, self.references[0], row.left).value < HOLDS
            return f"it would hold transposed: {_COLUMNS}" if found else _COLUMNS
        here = self.references[0]
        points = None if row.reason else self.points
        pointed = points is not None and of_points(one, equations, points, here)
        if self._in_millimetres(row, one, equations):
            return _MILLIMETRES
        if pointed and not names_inertia(one, equations, here.glossary):
            return _POINTS
        if passive := self._passive(row, equations):
            return passive
        if partly := branch(one, equations, here):
            return partly
        if changes := mends(one, equations, self.references):
            return _GUESS[len(changes) > 1].format(what=" | ".join(changes))
        if pointed:
            return _INERTIAS
        gap = math.inf if row.residual_printed is None else row.residual_printed
        return _NEARLY.format(gap=gap) if gap < NEARLY else ""


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
    made = Derivation(file, robot)
    header = made.file.derivation
    return DerivationThesis(
        name=header.title,
        robot=header.name,
        numbers=header.numbers,
        catalogue=lambda: made.catalogue,
        ground=lambda equations: Ground(
            made.described,
            lambda equation: made.references,
            {},
            Effects(made.states, made.glossary, equations).of,
        ),
        causes={},
        beyond=lambda equations: (),
        effects=EFFECTS,
        command=f"thesis-pin audit {file} --model {named}",
        changes=made.changes,
        points=made.points,
        millimetres=lambda: made.millimetres,
        references=tuple(filter(None, (made.references, made.second))),
        unforced=lambda: made.unforced,
    )


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
