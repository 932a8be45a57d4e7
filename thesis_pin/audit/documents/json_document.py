"""An audit as a JSON document."""

from __future__ import annotations

import math

from thesis_pin.audit.comparison.kinds import KINDS
from thesis_pin.audit.rows import HOLDS, AuditReport, Row
from thesis_pin.audit.slips import Slip

SCHEMA, VERSION = "thesis-pin/audit", 3


def document(report: AuditReport) -> dict[str, object]:
    """The report for :func:`thesis_pin.report.writers.json_bytes`.

    A residual of a formula that can't be evaluated is null, and ``reason`` says why.
    """
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "thesis": report.thesis,
        "states": report.states,
        "holds_below": HOLDS,
        "counts": report.counts,
        "chapters": report.by_chapter,
        "kinds": {kind: {"is": KINDS[kind], **counts} for kind, counts in report.by_kind.items()},
        "coverage": {
            "numbered": len(report.numbers) - len(report.missing_numbers),
            "numbers": len(report.numbers),
            "missing": list(report.missing_numbers),
            "sections": [
                {
                    "section": section.name,
                    "rows": section.rows,
                    "checked": section.checked,
                    "gaps": [{"id": name, "reason": reason} for name, reason in section.gaps],
                }
                for section in report.sections
            ],
            "beyond": [{"what": what, "why": why} for what, why in report.beyond],
        },
        "causes": {
            name: {
                **vars(cause),
                "rows": [row.id for row in report.rows if row.cause == name],
            }
            for name, cause in report.causes.items()
        },
        "rows": [row_document(row) for row in report.rows],
    }


def row_document(row: Row) -> dict[str, object]:
    """One row as JSON; what doesn't apply to it is null."""
    said = {name: list(x) if isinstance(x, tuple) else x for name, x in vars(row).items()}
    said["corrected"] = {str(k): text for k, text in row.corrected.items()}
    said["slips"] = [_slip(slip) for slip in row.slips]
    for name in (
        *("corrected", "attribution", "why", "reason", "effect", "note", "cause", "check"),
        *("line", "severity", "no_effect"),
    ):
        said[name] = said[name] or None
    residuals = {"printed": row.residual_printed, "corrected": row.residual_corrected}
    for name, value in residuals.items():
        finite = value is not None and math.isfinite(value)
        said[f"residual_{name}"] = value if finite else None
    return said


def _slip(slip: Slip) -> dict[str, object]:
    """A slip as JSON; one that can't be evaluated has no residual."""
    said = {**vars(slip), "neighbours": list(slip.neighbours)}
    if slip.residual is not None and not math.isfinite(slip.residual):
        said["residual"] = None
    return said
