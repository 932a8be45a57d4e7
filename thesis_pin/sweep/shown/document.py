"""A sweep as a document and as files; see docs/sweep.md."""

from __future__ import annotations

from thesis_pin.report.writers import csv_bytes, json_bytes
from thesis_pin.sweep.running.work import versions
from thesis_pin.sweep.shown.choice import Choice

VERSION = 1
"""Of the schema ``…/sweep``."""


def document(choice: Choice, command: str) -> dict[str, object]:
    """JSON-ready.

    Args:
        choice: A sweep with what is wanted of it.
        command: Which writes it, for the schema's name.
    """
    sweep, best = choice.sweep, choice.best
    return {
        "schema": f"{command}/sweep",
        "version": VERSION,
        "inputs": dict(sweep.study.inputs),
        "parameters": [
            {"label": one.label, "keys": len(one.keys), "relative": one.relative}
            for one in sweep.designs.parameters
        ],
        "columns": [
            {
                "name": column.name,
                "unit": column.unit,
                "what": column.what,
                "better": column.better or None,
                "kind": column.kind,
            }
            for column in sweep.study.columns
        ],
        "designs": [
            {
                "design": row.design,
                "values": list(row.values),
                "status": row.status,
                "reason": row.reason or None,
                "warnings": row.warnings or None,
                "cells": list(row.cells),
            }
            for row in sweep.rows
        ],
        "aims": [
            {"column": aim.column.name, "better": "less" if aim.sign > 0 else "more"}
            for aim in choice.aims
        ],
        "wish": [
            {"column": term.column.name, "sign": term.sign, "value": term.value}
            for term in choice.terms
        ],
        "front": choice.front.tolist(),
        "best": best,
        "feasible": int(sweep.feasible.sum()),
        "judged": int(sweep.done.sum()),
        "verdict": choice.sentences(),
        "effort": {
            "jobs": sweep.effort.jobs or None,
            "scheduler": sweep.effort.scheduler,
            "judged_now": sweep.effort.judged,
            "seconds": sweep.effort.seconds,
            "memory": sweep.effort.memory or None,
        },
        "versions": versions(),
    }


def data_files(choice: Choice, command: str) -> dict[str, bytes]:
    """What is written of a sweep, figures aside: file name → content."""
    table = choice.sweep.table()
    quoted = {
        _quoted(name): [_quoted(cell) for cell in cells] if isinstance(cells, list) else cells
        for name, cells in table.items()
    }
    return {
        "report.json": json_bytes(document(choice, command)),
        "designs.csv": csv_bytes(quoted),
        **choice.files(),
    }


def _quoted(text: str) -> str:
    """A word for a CSV file, in quotes where it has to be."""
    return '"' + text.replace('"', '""') + '"' if any(c in text for c in ',"\n;') else text
