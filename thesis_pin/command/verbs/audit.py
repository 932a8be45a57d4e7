"""The verb ``audit`` of both commands: run, explain one equation, write documents."""

from __future__ import annotations

import argparse
import difflib
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.text import say
from thesis_pin.errors import BadInput

if TYPE_CHECKING:  # the commands' help imports this module and must stay quick
    from thesis_pin.audit.rows import AuditReport
    from thesis_pin.audit.thesis import Thesis
    from thesis_pin.equations.catalogue import Catalogue

_NARROW = {
    "illegible": "il-\nlegible",
    "not checkable": "not\ncheckable",
    "unexplained": "un-\nexplained",
}
"""Headings on two lines: all verdicts fit 80 columns."""
_TITLE = 31
"""Characters of a failure's title, so that its row fits 80 columns."""


def derivation(arguments: argparse.Namespace) -> ExitCode:
    """A verdict on each printed equation of anyone's derivation."""
    from thesis_pin.audit.derivation.auditing import thesis
    from thesis_pin.command.flags.options import refuse_beside
    from thesis_pin.command.warned import warned

    refuse_beside(arguments, "equation", ("every",))
    with warned():
        found = thesis(arguments.file, arguments.model)
    return run_verb(arguments, found)


def run_verb(arguments: argparse.Namespace, thesis: Thesis) -> ExitCode:
    """Run the verb; returns the exit code."""
    from thesis_pin.audit.documents import text as faces
    from thesis_pin.audit.documents.json_document import document
    from thesis_pin.audit.documents.markdown import markdown
    from thesis_pin.audit.documents.page import page
    from thesis_pin.command.output import print_entries, print_parts, print_table, print_text
    from thesis_pin.command.progress import track
    from thesis_pin.command.results import put
    from thesis_pin.equations.uses import uses
    from thesis_pin.report.writers import json_bytes

    if arguments.errata and arguments.equation is not None:
        raise BadInput(
            "--errata and --equation are both given", remedy="errata are of a whole thesis"
        )
    if arguments.language and not arguments.errata:
        raise BadInput(
            f"--language {arguments.language} is given without --errata",
            remedy="only errata are written in other languages: add --errata FILE",
        )
    only = (
        known(arguments.equation, thesis.catalogue(), thesis)
        if arguments.equation is not None
        else None
    )
    report = thesis.audit(
        only=only,
        jobs=arguments.jobs,
        progress=lambda rows, total: track(rows, "auditing", total),
    )
    if arguments.html:
        put(arguments.html, page(report, uses(thesis.catalogue())).encode())
    if arguments.markdown:
        put(arguments.markdown, markdown(report, thesis.document_command).encode())
    if arguments.errata:
        put(arguments.errata, _errata(report, thesis, arguments.language or "en").encode())
    if arguments.json:
        put(arguments.json, json_bytes(document(report)))
    if not free(arguments):
        return ExitCode.DONE
    if only:
        for k, row in enumerate(report.rows):
            print_text(*[""] * (k > 0))
            said = list(faces.explain(row, report.causes.get(row.cause)))
            used = [name.split(":", 1)[1] for name in uses(thesis.catalogue(), [row.id])[row.id]]
            print_entries([*said, *([("uses", ", ".join(used))] if used else [])])
        return ExitCode.DONE
    lines = list(faces.summary_lines(report))
    print_text(*lines[:1])
    chapters, kinds = faces.chapter_table(report), faces.kind_table(report, defined=False)
    narrow = [_NARROW.get(heading, heading) for heading in chapters.columns]
    mended = (kinds, kinds.note) if kinds.rows else ()
    print_parts([replace(chapters, columns=narrow), *mended, ""])
    if not report.failures:
        print_text("No line fails.", *lines[1:])
        return _rest(report)
    columns = ("failures, worst effect first", "lines", "verdict", "by", "effect")
    print_table(columns, faces.failure_rows(report, every=arguments.every, width=_TITLE))
    print_text(
        "Effect: the largest number of a row or group; blocked: the line can't be computed, or "
        "following it leaves nothing to compute.",
        *lines[1:],
    )
    return _rest(report)


def _rest(report: AuditReport) -> ExitCode:
    """Print what has no verdict and what lies outside."""
    from thesis_pin.command.output import print_entries, print_text

    without = list(_without_verdict(report))
    if without:
        print_text("Without a verdict:")
        print_entries(without)
    print_text(*(f"Outside: {what} ({why})" for what, why in report.beyond))
    return ExitCode.DONE


def _errata(report: AuditReport, thesis: Thesis, language: str) -> str:
    """The errata in a language; says what it has no words for, which stay in English."""
    from thesis_pin.audit.errata.document import errata
    from thesis_pin.audit.languages.phrases import Phrases

    texts = [thesis.spanish] if thesis.spanish else []
    phrases = Phrases.spanish(*texts) if language == "es" else Phrases()
    text = errata(report, thesis.errata_command(language), phrases)
    if phrases.missing:
        say(f"{len(phrases.missing)} texts have no Spanish yet and stay in English")
    return text


def _without_verdict(report: AuditReport) -> Iterator[tuple[str, str]]:
    """Section and names of lines that share a reason, and the reason."""
    from thesis_pin.audit.documents.text import ranges

    for section in report.sections:
        for reason in dict.fromkeys(reason for _, reason in section.gaps):
            names = [name.split(":", 2)[2] for name, one in section.gaps if one == reason]
            count = f"{len(names)} line{'s' if len(names) > 1 else ''}"
            ways = (ranges(names), f"{names[0]} and {len(names) - 1} more", count)
            yield f"  {section.name}: {next(way for way in ways if len(way) < 20)}", reason


def known(name: str, catalogue: Catalogue, thesis: Thesis) -> list[str]:
    """The full ids of what is asked for; says on standard error what was assumed.

    Raises:
        BadInput: There is none; names the nearest.
    """
    from thesis_pin.audit.asked import asked

    robot = thesis.robot
    found, said = asked(name, catalogue, robot)
    if said:
        say(said)
    if found:
        return found
    listed = list(catalogue.by_id)
    full = name if name.startswith(f"{robot}:") else f"{robot}:{name}"
    near = difflib.get_close_matches(full, listed, n=5, cutoff=0.5)
    raise BadInput(
        f"no equation is called {name!r}",
        where="--equation",
        allowed=f"an id such as {', '.join(near) or listed[0]}, a number, a symbol or a section",
        remedy=f"{thesis.audit_command} --json - lists all ids",
    )
