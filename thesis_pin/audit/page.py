"""An audit as one HTML page in the look of the reports: formulas, filters, no network."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from thesis_pin.audit.rows import AuditReport, Row
from thesis_pin.audit.text import (
    VERDICT_NOTE,
    chapter_table,
    effect_text,
    kind_table,
    place_text,
    residual_text,
    summary_lines,
    used_causes,
)
from thesis_pin.pages.player import render, web_file
from thesis_pin.report.tables import Table


def page(report: AuditReport) -> str:
    """A self-contained page: formulas as MathML, filters, no network."""
    from markupsafe import Markup

    order = {row.id: k for k, row in enumerate(report.failures)}
    titles = {name: cause.title for name, cause in report.causes.items()}
    articles = [
        _Article.of(row, titles.get(row.cause, ""), Markup)
        for row in sorted(report.rows, key=lambda row: order.get(row.id, len(order)))
    ]
    sections = [(s.name, str(s.rows), str(s.checked)) for s in report.sections]
    shown = [chapter_table(report), kind_table(report)]
    return render(
        "audit.html",
        report=report,
        summary=list(summary_lines(report)),
        reading=" ".join((*VERDICT_NOTE, *report.effects)).replace("*", ""),
        tables=[replace(one, title=one.title.capitalize()) for one in shown if one.rows],
        causes=[(cause, len(rows)) for cause, rows in used_causes(report)],
        rows=articles,
        coverage=Table("Section by section", ("section", "lines", "computed"), sections),
        report_style=web_file("report.css"),
        audit_style=web_file("audit.css"),
        script=web_file("audit.js"),
    ).decode()


@dataclass(frozen=True)
class _Article:
    """One equation as the template shows it."""

    id: str
    source: str
    verdict: str
    style: str
    search: str
    entries: list[tuple[str, object]]

    @classmethod
    def of(cls, row: Row, cause: str, markup: type[str]) -> _Article:
        searched = (row.id, row.note, row.reason, row.why, cause, *row.places, *row.kinds)
        return cls(
            row.id,
            row.source,
            row.verdict,
            row.verdict.replace(" ", "-"),
            " ".join(searched).lower(),
            list(_entries(row, cause, markup)),
        )


def _entries(row: Row, cause: str, markup: type[str]) -> Iterator[tuple[str, object]]:
    """Labels and contents; what comes as markup isn't escaped again."""
    yield "printed", markup(" = ".join(mathml(text) for text in (row.left, *row.printed) if text))
    for number, text in sorted(row.corrected.items()):
        label = "left side" if number == 0 else f"member {number}"
        yield f"corrected, {label}", markup(mathml(text)) if text else "(nothing)"
    for label, value in (
        ("residual printed", row.residual_printed),
        ("residual corrected", row.residual_corrected),
    ):
        if value is not None:
            yield label, residual_text(value)
    for place in row.places:
        yield "where", markup(f"<code>{html.escape(place_text(place))}</code>")
    texts = (
        *(("kind", ", ".join(row.kinds)), ("cause", cause), ("effect", effect_text(row))),
        *(("finding", row.reason), ("note", row.note)),
        ("guess", f"{row.attribution}: {row.why}" if row.attribution else ""),
    )
    yield from ((label, text) for label, text in texts if text)


_ROW = re.compile(r"<mrow>(<(m[ions])(?: [^>]*)?>[^<]*</\2>)</mrow>")


def _shortened(markup: str) -> str:
    """The same formula in three quarters of the bytes: a page has thousands of them."""
    markup = markup.replace(' xmlns="http://www.w3.org/1998/Math/MathML" display="inline"', "")

    def character(match: re.Match[str]) -> str:
        found = chr(int(match[1], 16))
        return match[0] if found in "<>&" else found

    return _ROW.sub(r"\1", re.sub(r"&#x([0-9A-Fa-f]+);", character, markup))


def mathml(formula: str) -> str:
    """A formula as MathML; one that is broken in print is shown as its source."""
    from latex2mathml.converter import convert

    loose = re.sub(r"\\(left|right)\s*\.|\\[bB]igg?[lr]?|\\(left|right)(?![a-z])", "", formula)
    for text in (formula, loose):
        try:
            return _shortened(convert(text))
        except Exception:  # the converter has no common base class of its errors
            continue
    return f"<code>{html.escape(formula)}</code>"
