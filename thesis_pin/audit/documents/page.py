"""An audit as one HTML page in the look of the reports: formulas, filters, no network."""

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from thesis_pin.audit.comparison.kinds import KINDS
from thesis_pin.audit.documents.finger import slip_text, spans
from thesis_pin.audit.documents.formulas import GAP, mathml
from thesis_pin.audit.documents.text import (
    VERDICT_NOTE,
    chapter_table,
    effect_entry,
    kind_table,
    residual_text,
    summary_lines,
    surviving_text,
    used_causes,
)
from thesis_pin.audit.rows import AuditReport, Row, Severity
from thesis_pin.audit.slips import Slip
from thesis_pin.equations.uses import Uses
from thesis_pin.pages.player import render, web_file
from thesis_pin.report.tables import Table

_SEVERITIES: tuple[Severity, ...] = ("changes a result", "notation only")
_PAGES = 1200
"""Characters of LaTeX from which a correction stands as source: it repeats pages of print."""


def page(report: AuditReport, uses: Uses | None = None) -> str:
    """A self-contained page: formulas as MathML, filters, no network.

    Args:
        report: The audit.
        uses: What each line uses, for links; see :mod:`thesis_pin.equations.uses`.
    """
    from markupsafe import Markup

    titles = {name: cause.title for name, cause in report.causes.items()}
    known = {row.id for row in report.rows}
    links = {} if uses is None else uses

    def articles(rows: Sequence[Row]) -> list[_Article]:
        return [
            _Article.of(row, titles.get(row.cause, ""), _links(row, links, known), Markup)
            for row in rows
        ]

    sections = [(s.name, str(s.rows), str(s.checked)) for s in report.sections]
    shown = [chapter_table(report), kind_table(report)]
    failures = report.failures
    return render(
        "audit.html",
        report=report,
        summary=list(summary_lines(report)),
        gap=GAP,
        reading=" ".join((*VERDICT_NOTE, *report.effects)).replace("*", ""),
        tables=[replace(one, title=one.title.capitalize()) for one in shown if one.rows],
        causes=[(cause, len(rows)) for cause, rows in used_causes(report)],
        index=list(_index(failures)),
        groups=[
            ("Lines that fail, the worst effect first", articles(failures)),
            (
                "All other lines, as in the thesis",
                articles([r for r in report.rows if not r.failed]),
            ),
        ],
        coverage=Table("Section by section", ("section", "lines", "computed"), sections),
        report_style=web_file("report.css"),
        audit_style=web_file("audit.css"),
        script=web_file("audit.js"),
    ).decode()


@dataclass(frozen=True)
class _Article:
    """One equation as the template shows it.

    Attributes:
        id: Its id, which is also its anchor.
        name: The id without the robot.
        about: Numbers printed beside it, line of the text, verdict and what it changes.
        style: Its verdict as a class.
        formula: What is printed.
        entries: Label and content of what is said of it.
        uses: Names of the lines it uses.
    """

    id: str
    name: str
    about: str
    style: str
    formula: str
    entries: list[tuple[str, object]]
    uses: list[str]

    @classmethod
    def of(cls, row: Row, cause: str, uses: list[str], markup: type[str]) -> _Article:
        return cls(
            row.id,
            _name(row.id),
            " ".join(_about(row)),
            row.verdict.replace(" ", "-"),
            markup(" ".join(_printed(row))),
            list(_entries(row, cause, markup)),
            uses,
        )


def _about(row: Row) -> Iterator[str]:
    """What the heading of a line says beside its name."""
    yield from (f"({number})" for number in row.number)
    if row.line:
        yield f"line {row.line}:"
    yield f"{row.verdict}, {row.severity}" if row.severity else row.verdict


def _name(identity: str) -> str:
    return identity.split(":", 1)[1]


def _links(row: Row, uses: Uses, known: set[str]) -> list[str]:
    return [_name(name) for name in uses.get(row.id, ()) if name in known]


def _index(failures: Sequence[Row]) -> Iterator[tuple[str, list[tuple[str, str]]]]:
    """Failing lines by severity and by kind of slip: titles, ids and names of the lines."""
    groups: list[tuple[str, list[Row]]] = [
        (name, [r for r in failures if r.severity == name]) for name in _SEVERITIES
    ]
    for kind, what in KINDS.items():
        groups.append((f"{kind}: {what}", [row for row in failures if kind in row.kinds]))
    for title, rows in groups:
        if rows:
            yield title, [(row.id, _name(row.id)) for row in rows]


def _printed(row: Row) -> Iterator[str]:
    """The printed equation, member by member."""
    members = ((k, text) for k, text in enumerate((row.left, *row.printed)) if text)
    for count, (number, text) in enumerate(members):
        yield ("<math><mo>=</mo></math> " if count else "") + mathml(text, spans(row, number))


def _correction(text: str) -> str:
    """A correction as a formula, or as its source where that takes pages."""
    if len(text) < _PAGES:
        return mathml(text)
    said = f"its source, {len(text)} characters"
    return f"<details><summary>{said}</summary><code>{html.escape(text)}</code></details>"


def _piece(formula: str) -> str:
    """A piece of a formula that has a slip; one that can't be set alone as its source."""
    cells = any(mark in formula for mark in ("&", r"\\", "begin", "end", "left", "right"))
    return f"<code>{html.escape(formula)}</code>" if cells else mathml(formula)


def _alone(slip: Slip) -> str:
    """What one slip alone does to the corrected line."""
    if slip.residual is None:
        return "<small>(can’t be told apart from the others)</small>"
    return f"<small>(alone: residual {residual_text(slip.residual)})</small>"


def _entries(row: Row, cause: str, markup: type[str]) -> Iterator[tuple[str, object]]:
    """Labels and contents; what comes as markup isn't escaped again."""
    for k, text in enumerate(row.rebuilt, start=1):
        label = f"rebuilt, member {k}" if len(row.rebuilt) > 1 else "rebuilt"
        yield label, markup(_correction(text))
    for text in row.surviving:
        yield "survives", markup(f"<code>{html.escape(surviving_text(text))}</code>")
    for number, text in sorted(row.corrected.items()):
        label = "left side" if number == 0 else f"member {number}"
        yield f"corrected, {label}", markup(_correction(text)) if text else "(nothing)"
    if row.failed or row.residual_corrected is not None:
        mended = "rebuilt" if row.rebuilt else "corrected"
        residuals = {"as printed": row.residual_printed, mended: row.residual_corrected}
        said = [f"{k} {residual_text(v)}" for k, v in residuals.items() if v is not None]
        yield "residual", ", ".join(said)
    for slip in row.slips:
        yield "where", markup(f"{slip_text(row, slip, quote=_piece)} {_alone(slip)}")
    texts = (
        *(("kind", ", ".join(row.kinds)), ("cause", cause)),
        *effect_entry(row),
        *(("finding", row.reason), ("note", row.note)),
        ("guess", f"{row.attribution}: {row.why}" if row.attribution else ""),
    )
    yield from ((label, text) for label, text in texts if text)
