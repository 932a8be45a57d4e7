"""The audit of a thesis: what a robot tells of its thesis, and the run over its equations."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace

from thesis_pin.audit.rows import AuditReport, Effect
from thesis_pin.audit.slips import Cause
from thesis_pin.audit.verdicts import Claims, judge
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment

Progress = Callable[[Iterable[Equation], int], Iterable[Equation]]
"""Wraps a loop over so many equations, for a progress bar."""


@dataclass(frozen=True)
class Ground:
    """What a thesis's lines are judged by.

    Attributes:
        states: The states they are judged at, in words.
        references: Equation → what its symbols must equal, where it has to hold.
        claims: The checks in code, by name; each is run once, several equations may share it.
        effect: Failing equation → what following its print does, by quantity.
    """

    states: str
    references: Callable[[Equation], Environment]
    claims: Claims
    effect: Callable[[Equation], Effect]


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
    """

    name: str
    robot: str
    numbers: tuple[str, ...]
    catalogue: Callable[[], Catalogue]
    ground: Callable[[Catalogue], Ground]
    causes: Mapping[str, Cause]
    beyond: Callable[[Catalogue], tuple[tuple[str, str], ...]]
    effects: tuple[str, ...]

    @property
    def document_command(self) -> str:
        """What regenerates the checked-in document."""
        return f"{self.robot}-pin audit --markdown docs/audit/{self.robot}.md"

    def audit(
        self,
        equations: Catalogue | None = None,
        *,
        only: Iterable[str] | None = None,
        with_effects: bool = True,
        progress: Progress | None = None,
    ) -> AuditReport:
        """Audit the thesis.

        Args:
            equations: The equations; None for the thesis's own.
            only: Ids to audit; None for all.
            with_effects: Follow each failing line to see what it does.
            progress: Wraps the loop over equations.
        """
        equations = equations or self.catalogue()
        chosen = equations.equations if only is None else [equations[name] for name in only]
        ground = self.ground(equations)
        claims = {name: functools.cache(claim) for name, claim in ground.claims.items()}
        rows = []
        for equation in progress(chosen, len(chosen)) if progress else chosen:
            row = judge(equations, equation, ground.references(equation), claims, self.name)
            if row.failed and not row.effect:
                effect = ground.effect(equation) if with_effects else {}
                if not effect and row.residual_printed == math.inf:
                    effect = {"this line": "can't be computed"}
                row = replace(row, effect=effect)
            rows.append(row)
        return AuditReport(
            self.name,
            tuple(rows),
            self.numbers,
            ground.states,
            self.causes,
            self.beyond(equations),
            self.effects,
        )
