"""Lines of a thesis that its text lacks: what is missing, what follows for them, from what."""

from __future__ import annotations

from collections.abc import Iterator

from thesis_pin.audit.errata.formulas import math
from thesis_pin.audit.languages.phrases import Phrases
from thesis_pin.audit.rows import AuditReport, Row

_SHORT = 100
"""Characters of a formula that fits into a table."""


def lost(report: AuditReport, say: Phrases) -> Iterator[str]:
    """A table of the lost lines, in the thesis's order; nothing if there are none."""
    rows = [row for row in report.rows if row.verdict in ("rebuilt", "illegible")]
    rows.sort(key=lambda row: row.line)
    if not rows:
        return
    yield f"## {say('Lost lines')}"
    yield ""
    yield say(
        "Of {n} lines the text that was typed in has nothing, or a piece. What follows for {m} of "
        "them from the rest was held to the same as the others, which says nothing of the lost "
        "print: please compare. `audit --equation` shows long ones.",
        n=len(rows),
        m=sum(row.verdict == "rebuilt" for row in rows),
    )
    yield ""
    heads = ("place", "line of the text", "what is missing", "what follows", "from")
    yield f"| {' | '.join(map(say, heads))} |"
    yield "| --- | ---: | --- | --- | --- |"
    for row in rows:
        cells = (cell.replace("|", r"\|") for cell in _cells(row, say))
        yield f"| {' | '.join(cells)} |"
    yield ""


def _cells(row: Row, say: Phrases) -> Iterator[str]:
    yield f"`{row.id.split(':', 1)[1]}`"
    yield str(row.line or "")
    yield say(row.reason)
    whole = " = ".join((row.left, *row.rebuilt))
    short = row.rebuilt and len(whole) <= _SHORT
    yield math([row.left, *row.rebuilt]) if short else f"{math([row.left])} = …"
    yield say(row.note.removeprefix("rebuilt: "))
