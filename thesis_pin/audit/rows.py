"""An audit's answers: a row for each printed equation, a report of all of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from thesis_pin.audit.comparison.kinds import KINDS
from thesis_pin.audit.slips import Cause, Slip
from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell

Verdict = Literal[
    "holds", "misprint", "wrong", "illegible", "rebuilt", "not checkable", "unexplained"
]
VERDICTS: tuple[Verdict, ...] = (
    *("holds", "misprint", "wrong", "illegible", "rebuilt", "not checkable", "unexplained"),
)
"""``misprint``: the print fails and its correction holds; ``wrong``: the printed
statement is physically wrong and the right one holds; ``rebuilt``: the print is lost
and what follows from the rest holds, which says nothing of the print; ``unexplained``: it fails
and nothing given in its place holds. No finished audit has one of the last."""

NO_VERDICT: tuple[Verdict, ...] = ("illegible", "rebuilt", "not checkable")
"""Verdicts that say nothing of the print."""

HOLDS = 3e-8
"""Residual below which two sides are equal. It stands in the middle (in powers of ten) of
the gap that both audits leave: rounding stays under 1e-9 on every processor tried, the
smallest slip found is above 1e-6; tests hold the gap open on both sides."""


Severity = Literal["changes a result", "notation only", ""]

Effect = dict[str, float | str]
"""What following a printed line does: a number, or why there is none, by quantity."""


@dataclass(frozen=True)
class Row(Brief):
    """The audit's answer on one equation.

    Attributes:
        id: ``robot:section:number or symbol``.
        source: Thesis, section and number, in words.
        left, printed: As printed.
        corrected: The members that replace failing ones, by number.
        verdict: One of :data:`VERDICTS`.
        attribution: "thesis" or "scan", where somebody slipped.
        why: Reason for the attribution.
        residual_printed, residual_corrected: See
            :class:`thesis_pin.audit.judging.residuals.Residual`; None where there is nothing
            to evaluate.
        places: Where the correction differs from the print.
        kinds: What kind of slip that is, of :data:`thesis_pin.audit.comparison.kinds.KINDS`.
        reason: Why the print can't be evaluated, or isn't checked.
        effect: What following the print does; by quantity.
        note: What a reader should know.
        cause: Slip shared by several equations.
        check: How it was decided: "identity" at the audit's states, or the claim's name.
        line: Line of the thesis's source text where it begins; 0 if the data don't say.
        severity: "changes a result" or "notation only" for a failing line, else "".
        slips: Every difference of print and correction, each with what it alone does.
        no_effect: Why a failing line has no effect; "" if it has one.
        surviving: What of an illegible line can still be read.
        rebuilt: What follows for it from the rest.
    """

    id: str
    source: str
    number: tuple[str, ...]
    left: str
    printed: tuple[str, ...]
    corrected: dict[int, str]
    verdict: Verdict
    attribution: str = ""
    why: str = ""
    residual_printed: float | None = None
    residual_corrected: float | None = None
    places: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    reason: str = ""
    effect: Effect = field(default_factory=dict)
    note: str = ""
    cause: str = ""
    check: str = ""
    line: int = 0
    severity: Severity = ""
    slips: tuple[Slip, ...] = ()
    no_effect: str = ""
    surviving: tuple[str, ...] = ()
    rebuilt: tuple[str, ...] = ()

    @property
    def failed(self) -> bool:
        """Whether the print can't be followed."""
        return self.verdict in ("misprint", "wrong", "unexplained")

    @property
    def section(self) -> str:
        """Section of the thesis."""
        return self.id.split(":")[1]

    @property
    def chapter(self) -> str:
        """Chapter or appendix: what stands before the section's first point."""
        return self.section.partition(".")[0]

    @property
    def weight(self) -> float:
        """For sorting: the largest effect; infinite if following isn't possible.

        To six digits: equal effects, such as both legs', keep one order on every machine.
        """
        numbers = [v for v in self.effect.values() if isinstance(v, float)]
        blocked = any(isinstance(v, str) for v in self.effect.values())
        return math.inf if blocked else float(f"{max(numbers, default=0.0):.6g}")


@dataclass(frozen=True)
class Section:
    """Coverage of one section.

    Attributes:
        name: Section of the thesis.
        rows: Equations in the audit.
        checked: Of these, the ones with a computed verdict.
        gaps: Id and reason of each that has none.
    """

    name: str
    rows: int
    checked: int
    gaps: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class AuditReport(Brief):
    """A finished audit.

    Attributes:
        thesis: Its name.
        rows: One a printed equation.
        numbers: All equation numbers of the thesis.
        states: The states it was made at, in words.
        causes: Each shared slip, by its name in the rows.
        beyond: What lies outside the audit, and why.
        effects: What the rows' effects are, as lines for the document.
    """

    thesis: str
    rows: tuple[Row, ...]
    numbers: tuple[str, ...]
    states: str
    causes: Mapping[str, Cause]
    beyond: tuple[tuple[str, str], ...] = ()
    effects: tuple[str, ...] = ()

    def _cell(self) -> Cell:
        chapters = self.by_chapter
        rows = [(name, *map(str, counts.values())) for name, counts in chapters.items()]
        rows.append(("all", *map(str, self.counts.values())))
        said = [f"{self.counts['holds']} of {len(self.rows)} printed equations hold."]
        return Cell(f"Audit of the {self.thesis}", said, None, ("chapter", *VERDICTS), rows)

    @property
    def counts(self) -> dict[str, int]:
        """Number of rows by verdict."""
        return {v: sum(row.verdict == v for row in self.rows) for v in VERDICTS}

    @property
    def failures(self) -> tuple[Row, ...]:
        """Failing rows, worst effect first."""
        failed = [row for row in self.rows if row.failed]
        return tuple(sorted(failed, key=lambda row: (-row.weight, row.id)))

    @property
    def missing_numbers(self) -> tuple[str, ...]:
        """Numbered equations without a row."""
        covered = {number for row in self.rows for number in row.number}
        return tuple(number for number in self.numbers if number not in covered)

    @property
    def by_chapter(self) -> dict[str, dict[str, int]]:
        """Number of rows by chapter, chapters before appendices, and verdict."""
        zeros: dict[str, int] = {verdict: 0 for verdict in VERDICTS}
        names = sorted({row.chapter for row in self.rows}, key=lambda name: (name.isalpha(), name))
        table = {name: zeros.copy() for name in names}
        for row in self.rows:
            table[row.chapter][row.verdict] += 1
        return table

    @property
    def by_kind(self) -> dict[str, dict[str, int]]:
        """Number of mended rows by kind and verdict; one of several kinds counts under each."""
        found = {kind for row in self.rows for kind in row.kinds}
        table = {k: {"misprint": 0, "wrong": 0} for k in KINDS if k in found}
        for row in self.rows:
            for kind in row.kinds:
                table[kind][row.verdict] += 1
        return table

    @property
    def sections(self) -> tuple[Section, ...]:
        """Coverage section by section, in the rows' order."""
        names = dict.fromkeys(row.section for row in self.rows)
        result = []
        for name in names:
            rows = [row for row in self.rows if row.section == name]
            open_ = [row for row in rows if row.verdict in NO_VERDICT]
            gaps = tuple((row.id, row.reason) for row in open_)
            result.append(Section(name, len(rows), len(rows) - len(open_), gaps))
        return tuple(result)
