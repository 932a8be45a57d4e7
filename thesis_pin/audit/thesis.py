"""The audit of a thesis: what a robot tells of its thesis, and the run over its equations."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path

from thesis_pin.audit.judging.residuals import TROUBLES, Free, what
from thesis_pin.audit.judging.severity import severity, without_effect
from thesis_pin.audit.judging.verdicts import Claims, judge
from thesis_pin.audit.rows import AuditReport, Effect, Row, Severity
from thesis_pin.audit.slips import Cause
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment
from thesis_pin.equations.uses import used_by, uses
from thesis_pin.numeric.checks import whole
from thesis_pin.numeric.workers import shared

Progress = Callable[[Iterable[Equation], int], Iterable[Equation]]
"""Wraps a loop over so many equations, for a progress bar."""


@dataclass(frozen=True)
class Ground:
    """What a thesis's lines are judged by.

    Attributes:
        states: The states they are judged at, in words.
        references: Equation → what its symbols must equal, where it has to hold.
        claims: The checks in code, by name.
        effect: Failing equation → what following its print does, by quantity.
        substituted: Equation → what its symbols are where those that it takes as given are
            free, so that nothing vanishes; nothing for a line that is no substitution.
    """

    states: str
    references: Callable[[Equation], Environment]
    claims: Claims
    effect: Callable[[Equation], Effect]
    substituted: Callable[[Equation], Sequence[Free]] = lambda equation: ()


@dataclass(frozen=True)
class Thesis:
    """A thesis, ready to be audited.

    Attributes:
        name: What it is called: "Scout thesis".
        robot: First part of its equations' ids: "scout".
        numbers: All its equation numbers.
        catalogue: Reads its equations.
        ground: Equations → what they are judged by.
        causes: Each slip that several lines share, by its name in the data.
        beyond: Equations → what lies outside the audit, and why.
        effects: What the effects are, as lines for the document.
        spanish: File with its texts in Spanish; see :mod:`thesis_pin.audit.languages.phrases`.
        command: What runs the audit, where it isn't ``ROBOT-pin audit``.
    """

    name: str
    robot: str
    numbers: tuple[str, ...]
    catalogue: Callable[[], Catalogue]
    ground: Callable[[Catalogue], Ground]
    causes: Mapping[str, Cause]
    beyond: Callable[[Catalogue], tuple[tuple[str, str], ...]]
    effects: tuple[str, ...]
    spanish: Path | None = None
    command: str = ""

    @property
    def audit_command(self) -> str:
        """What runs the audit."""
        return self.command or f"{self.robot}-pin audit"

    @property
    def document_command(self) -> str:
        """What regenerates the checked-in document."""
        if self.command:
            return f"{self.command} --markdown FILE"
        return f"{self.audit_command} --markdown docs/audit/{self.robot}.md"

    def errata_command(self, language: str) -> str:
        """What regenerates the checked-in errata, in English ("en") or Spanish ("es")."""
        if self.command:
            return f"{self.command} --language {language} --errata FILE"
        file = f"{self.robot}_errata.md" if language == "en" else f"{self.robot}_erratas.es.md"
        return f"{self.audit_command} --language {language} --errata docs/audit/{file}"

    def audit(
        self,
        equations: Catalogue | None = None,
        *,
        only: Iterable[str] | None = None,
        with_effects: bool = True,
        jobs: int = 1,
        progress: Progress | None = None,
    ) -> AuditReport:
        """Audit the thesis.

        Args:
            equations: The equations; None for the thesis's own.
            only: Ids to audit; None for all.
            with_effects: Follow each failing line to see what it does.
            jobs: Processes that share the work; the rows are the same. With more than one, a
                script has to call this below ``if __name__ == "__main__"``.
            progress: Wraps the loop over equations.
        """
        jobs = whole("jobs", jobs, 1)
        given, equations = equations, equations or self.catalogue()
        chosen = equations.equations if only is None else [equations[name] for name in only]
        here = _Judge(self, equations, with_effects)
        workers = min(jobs, len(chosen) // _TOGETHER)
        rows: dict[str, Row] = {}

        def judged() -> Generator[Equation]:
            if workers < 2:
                for equation in chosen:
                    yield equation
                    rows[equation.id] = here.followed(here.row(equation))
                return
            begin = functools.partial(_begin, self, given, with_effects)
            tasks = _tasks(chosen, with_effects, workers)
            with closing(shared(_done, tasks, workers, begin)) as results:
                for done in results:
                    here.effects.update(done.effects)
                    here.uses.update(done.uses)
                    for row in done.rows:
                        rows[row.id] = row
                        yield equations[row.id]

        with closing(judged()) as each:
            for _ in progress(each, len(chosen)) if progress else each:
                pass
        if with_effects:
            rows = {name: here.weighed(here.followed(row)) for name, row in rows.items()}
        return AuditReport(
            self.name,
            tuple(rows[equation.id] for equation in chosen),
            self.numbers,
            here.ground.states,
            self.causes,
            self.beyond(equations),
            self.effects,
        )


class _Judge:
    """Judges lines of a thesis; what their checks and effects share is worked out once.

    Attributes:
        uses: Lines that a line uses, of those that are known to it already.
        effects: What following a line's print does, likewise.
    """

    def __init__(self, thesis: Thesis, equations: Catalogue, with_effects: bool) -> None:
        self.name, self.equations, self.with_effects = thesis.name, equations, with_effects
        self.ground = thesis.ground(equations)
        self.uses: dict[str, tuple[str, ...]] = {}
        self.effects: dict[str, Effect] = {}

    def row(self, equation: Equation) -> Row:
        """The audit's answer on one equation, all but what a failing one does."""
        environment = self.ground.references(equation)
        ground, free = self.ground, self._free(equation)
        return judge(self.equations, equation, environment, ground.claims, self.name, free)

    def followed(self, row: Row) -> Row:
        """A failing row with what following its print does, where its check hasn't said so."""
        if not row.failed or not self.with_effects or row.effect:
            return row
        return replace(row, effect=self.effect(self.equations[row.id]))

    def weighed(self, row: Row) -> Row:
        """A failing row with how much it matters, and why where nothing changes."""
        if not row.failed:
            return row
        equation, effect = self.equations[row.id], row.effect
        nothing = without_effect(equation, row, effect, lambda: self._users[row.id])
        if not effect and row.residual_printed == math.inf and not equation.no_effect:
            effect = {"this line": "can't be computed"}
        weight: Severity = "notation only"
        if not equation.notation:
            weight = severity(row, effect, nothing)
        return replace(row, effect=effect, no_effect=nothing, severity=weight)

    @functools.cached_property
    def _users(self) -> Mapping[str, tuple[str, ...]]:
        unknown = [e.id for e in self.equations.equations if e.id not in self.uses]
        found = {**self.uses, **uses(self.equations, unknown)}
        return used_by({e.id: found[e.id] for e in self.equations.equations})

    def _free(self, equation: Equation) -> Sequence[Free]:
        try:
            return self.ground.substituted(equation)
        except TROUBLES:
            return ()  # a line that can't be read fails at the references as well

    def effect(self, equation: Equation) -> Effect:
        """What following a line's print does, by quantity."""
        if equation.id not in self.effects:
            try:
                found = self.ground.effect(equation)
                said = dict(_said(name, value) for name, value in found.items())
            except TROUBLES as error:
                said = {"the law of motion": f"can't be computed, {what(error)}"}
            self.effects[equation.id] = said
        return self.effects[equation.id]


def _said(name: str, value: float | str) -> tuple[str, float | str]:
    """A quantity's change, in words where it is no number."""
    if isinstance(value, str) or math.isfinite(value):
        return name, value
    return name.partition(" [")[0], "can't be computed"


# -- several processes ------------------------------------------------------------------

_TOGETHER = 64
"""Lines a process takes at most at once: neighbours, which share most of what they need."""
_FEWEST = 8
"""Lines it takes towards the end, so that all processes end together."""


@dataclass(frozen=True)
class _Task:
    """Lines to judge, or lines to follow: what following needs is shared by all of them."""

    names: tuple[str, ...]
    follow: bool = False


@dataclass
class _Done:
    """What a process found: rows, what their lines use, or what following lines does."""

    rows: tuple[Row, ...] = ()
    uses: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    effects: Mapping[str, Effect] = field(default_factory=dict)


_here: list[_Judge] = []
"""The judge of a process that shares an audit; empty in all others."""


def _tasks(chosen: Sequence[Equation], with_effects: bool, workers: int) -> list[_Task]:
    """Lines in the order in which processes take them: what takes longest first.

    A single process follows those that have a correction, which all but a few failing ones
    have. Lines of one check stay together, as it is run once.
    """
    claims: dict[str, list[str]] = {}
    for equation in chosen:
        claims.setdefault(equation.claim, []).append(equation.id)
    lines = claims.pop("", [])
    tasks = [_Task(tuple(names)) for names in claims.values()]
    mended = tuple(e.id for e in chosen if e.mending or e.left_printed)
    if with_effects and mended:
        tasks.insert(0, _Task(mended, follow=True))
    while lines:
        count = min(max(len(lines) // (2 * workers), _FEWEST), _TOGETHER)
        tasks.append(_Task(tuple(lines[:count])))
        del lines[:count]
    return tasks


def _begin(thesis: Thesis, equations: Catalogue | None, with_effects: bool) -> None:
    _here[:] = [_Judge(thesis, equations or thesis.catalogue(), with_effects)]


def _done(task: _Task) -> _Done:
    """A task's answers; a process that has read lines to judge them says what they use."""
    (judge,) = _here
    equations = [judge.equations[name] for name in task.names]
    if task.follow:
        return _Done(effects={equation.id: judge.effect(equation) for equation in equations})
    rows = tuple(map(judge.row, equations))
    return _Done(rows, uses(judge.equations, task.names) if judge.with_effects else {})
