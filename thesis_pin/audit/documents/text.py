"""What an audit says, in words and tables, for every face it has."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence

from thesis_pin.audit.comparison.kinds import KINDS
from thesis_pin.audit.documents.finger import slip_text
from thesis_pin.audit.rows import HOLDS, VERDICTS, AuditReport, Row
from thesis_pin.audit.slips import Cause
from thesis_pin.report.tables import Table


def residual_text(value: float | None) -> str:
    """A residual for people: two digits, or that there is none to give."""
    if value is None:
        return ""
    if math.isinf(value):
        return "not computable"
    return f"< {HOLDS:.0e}".replace("e-0", "e-") if value < HOLDS else f"{value:.1e}"


def effect_text(row: Row, say: Callable[[str], str] = str) -> str:
    """What following the print does, in words; ``say`` puts them into another language."""
    parts = []
    for name, value in row.effect.items():
        if isinstance(value, str):
            parts.append(f"{say(name)}: {say(value)}")
        else:
            quantity, _, unit = name.rstrip("]").partition(" [")
            size = f"{value:.2g} {unit.replace('-', '')}".rstrip()
            parts.append(f"{say(quantity)} {size if value >= HOLDS else say('none')}")
    return "; ".join(parts)


def effect_entry(row: Row) -> Iterator[tuple[str, str]]:
    """What following the print does, or why nothing, with its label."""
    effect = effect_text(row)
    if effect:
        yield "effect", effect
    elif row.no_effect:
        yield no_effect_label(row), row.no_effect


def no_effect_label(row: Row) -> str:
    """What stands before the reason why following a line has no measured effect.

    A line may give another number of its own that nothing else is worked out from.
    """
    return "no further effect" if row.severity == "changes a result" else "no effect"


SURVIVES = 600
"""Characters of a torn line that are shown at once; Pollard's G_92 has 87 000."""


def surviving_text(text: str) -> str:
    """What survives of a torn line; only its ends where it is long."""
    if len(text) > SURVIVES:
        head, _, _ = text[: SURVIVES // 3].rpartition(" ")
        _, _, tail = text[-SURVIVES // 3 :].partition(" ")
        text = f"{head} [of {len(text)} characters] {tail}"
    return f"… {text} …"


def grouped(rows: Iterable[Row]) -> list[tuple[str, list[Row]]]:
    """Rows that share a cause together, in the order of each group's first row."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row.cause or row.id, []).append(row)
    return list(groups.items())


def ranges(names: Sequence[str]) -> str:
    """Names in words, runs of consecutive numbers shortened: 2.1, 2.2, 2.3 → 2.1 … 2.3."""
    runs: list[list[str]] = []
    for name in names:
        before = re.fullmatch(r"(.*?)(\d+)", runs[-1][-1]) if runs else None
        if before and name == f"{before[1]}{int(before[2]) + 1}":
            runs[-1].append(name)
        else:
            runs.append([name])
    return ", ".join(f"{run[0]} … {run[-1]}" if len(run) > 2 else ", ".join(run) for run in runs)


def summary_lines(report: AuditReport) -> Iterator[str]:
    """Counts and coverage in sentences."""
    counts = ", ".join(f"{report.counts[v]} {v}" for v in VERDICTS if report.counts[v])
    yield f"{len(report.rows)} equations of the {report.thesis}: {counts}."
    if report.numbers:
        covered = len(report.numbers) - len(report.missing_numbers)
        missing = f"; missing: {ranges(report.missing_numbers)}" if report.missing_numbers else ""
        yield f"Numbered equations covered: {covered} of {len(report.numbers)}{missing}."
    checked = sum(section.checked for section in report.sections)
    yield f"Computed verdicts: {checked} of {len(report.rows)}. {report.states}"


def chapter_table(report: AuditReport) -> Table:
    """Verdicts by chapter; a verdict that nowhere occurs has no column."""
    verdicts = [v for v in VERDICTS if report.counts[v]]
    rows = [
        (chapter, str(sum(counts.values())), *(str(counts[v] or "-") for v in verdicts))
        for chapter, counts in report.by_chapter.items()
    ]
    total = ("all", str(len(report.rows)), *(str(report.counts[v]) for v in verdicts))
    return Table("verdicts by chapter", ("chapter", "lines", *verdicts), [*rows, total])


def kind_table(report: AuditReport, *, defined: bool = True) -> Table:
    """Mended lines by kind of slip; ``defined`` says what each kind is."""
    rows = [
        (kind, *(str(n or "-") for n in counts.values()), *[KINDS[kind]] * defined)
        for kind, counts in report.by_kind.items()
    ]
    columns = ("kind of slip", "misprint", "wrong", *["what it is"] * defined)
    return Table("mended lines by kind of slip", columns, rows, KIND_NOTE, prose=True)


VERDICT_NOTE = (
    "A *misprint* fails as printed and holds corrected; *wrong* is a physically wrong",
    "statement whose right form holds. Verdicts are computed from residuals: the largest",
    "difference over all states, relative to the larger side there, or at the median state where",
    f"that is larger; below {HOLDS:.0e} it holds.",
)
"""What verdicts mean, in Markdown."""
KIND_NOTE = "A line with slips of several kinds counts under each."


def failure_rows(
    report: AuditReport, *, every: bool = False, width: int | None = None
) -> list[tuple[str, ...]]:
    """Rows of the failure table: what, lines, verdict, who, worst effect.

    Args:
        report: The audit.
        every: A row for each line, not for each cause.
        width: Characters a title may have; None for all of them.
    """
    found: list[tuple[str, ...]] = []
    groups = [(row.id, [row]) for row in report.failures] if every else grouped(report.failures)
    for name, rows in groups:
        worst = rows[0]
        shared = report.causes.get(name) if len(rows) > 1 else None
        title = shared.title if shared else name.split(":", 1)[-1]
        verdicts = "/".join(dict.fromkeys(row.verdict for row in rows))
        who = set(row.attribution for row in rows)
        by = "both" if len(who) > 1 else who.pop()
        effect = _worst_effect(worst)
        found.append((_short(title, width or len(title)), str(len(rows)), verdicts, by, effect))
    return found


def _worst_effect(row: Row) -> str:
    """The largest effect with its unit; "blocked" where following isn't possible."""
    if any(isinstance(v, str) for v in row.effect.values()):
        return "blocked"
    numbers = {name: v for name, v in row.effect.items() if isinstance(v, float) and v > 0}
    if not numbers:
        return "-"
    name = max(numbers, key=lambda key: numbers[key])
    unit = name.rstrip("]").partition(" [")[2].replace("-", "")
    return f"{numbers[name]:.2g} {unit}".rstrip()


def _short(text: str, width: int) -> str:
    return text if len(text) <= width else text[: width - 1] + "…"


def explain(row: Row, cause: Cause | None = None) -> Iterator[tuple[str, str]]:
    """Everything about one equation: labels and what belongs to them.

    Args:
        row: The audit's answer.
        cause: The slip it shares with other equations.
    """
    yield "equation", f"{row.id} ({row.source})"
    if row.line:
        yield "line", f"{row.line} of the source text"
    yield "verdict", row.verdict + (f", by the {row.attribution}" if row.attribution else "")
    yield "printed", row.left
    for member in row.printed:
        yield "", f"= {member}"
    for text in row.surviving:
        yield "survives", surviving_text(text)
    for text in row.rebuilt:
        yield "rebuilt", f"= {text}"
    for number, text in sorted(row.corrected.items()):
        label = "left side" if number == 0 else f"member {number}"
        yield "corrected", f"{label}: {text or '(nothing)'}"
    if row.residual_printed is not None:
        yield "residual", f"as printed {residual_text(row.residual_printed)}"
    if row.residual_corrected is not None:
        way = "rebuilt" if row.rebuilt else "corrected"
        label = "residual" if row.residual_printed is None else ""
        yield label, f"{way} {residual_text(row.residual_corrected)}"
    for slip in row.slips:
        alone = "" if slip.residual is None else f" (alone: {residual_text(slip.residual)})"
        yield "where", slip_text(row, slip) + alone
    if row.severity:
        yield "severity", row.severity
    if row.kinds:
        yield "kind", ", ".join(f"{kind} ({KINDS[kind]})" for kind in row.kinds)
    texts = (
        *effect_entry(row),
        ("because", row.reason),
        *(("guess", row.why), ("note", row.note)),
    )
    yield from ((label, text) for label, text in texts if text)
    if cause:
        yield "cause", f"{cause.title}; enters in {cause.enters}"
        yield "", cause.explanation


def used_causes(report: AuditReport) -> list[tuple[Cause, list[Row]]]:
    """Slips that failing rows of a report share, with the rows; the most lines first."""
    found = [
        (cause, [row for row in report.failures if row.cause == name])
        for name, cause in report.causes.items()
    ]
    return sorted((pair for pair in found if pair[1]), key=lambda pair: -len(pair[1]))
