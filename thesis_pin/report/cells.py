"""Reports and solutions as a notebook's cell shows them: the verdict, then a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from thesis_pin.display.cell import Cell
from thesis_pin.report.branches import Solutions
from thesis_pin.report.tables import Table


class Judged(Protocol):
    """What has an answer."""

    @property
    def within_limits(self) -> bool | None: ...
    def verdict(self) -> list[str]: ...


def table_cell(table: Table, title: str = "", note: str = "") -> Cell:
    """A table alone.

    Args:
        table: The table.
        title: Headline; empty for the table's own.
        note: A line below; empty for the table's own.
    """
    return Cell(
        title or table.title,
        columns=table.columns,
        rows=table.rows,
        prose=table.prose,
        note=note or table.note,
    )


def report_cell(report: Judged, title: str, table: Table, note: str = "") -> Cell:
    """A report: its verdict, then a table of its worst numbers.

    Args:
        report: The report.
        title: Headline.
        table: Its numbers.
        note: A line below.
    """
    found = table_cell(table, title, note)
    return Cell(
        title,
        said=report.verdict(),
        good=report.within_limits,
        columns=found.columns,
        rows=found.rows,
        prose=found.prose,
        note=found.note,
    )


def solutions_cell(
    found: Solutions, title: str, branches: Sequence[str], joints: Sequence[str]
) -> Cell:
    """Inverse kinematics: how many branches reach, and the angles of one pose, valid ones first.

    Args:
        found: The solutions, of one pose or a stack; branches are the last axis of what is said
            of each.
        title: Headline.
        branches: Their labels.
        joints: Names or symbols of the angles' joints.
    """
    valid, reachable = (x.reshape(-1, len(branches)) for x in (found.valid, found.reachable))
    poses = len(valid)
    each = np.degrees(found.angles.reshape(poses, len(branches), -1))
    state = np.where(valid, 0, np.where(reachable, 1, 2))
    if poses != 1:
        rows = [
            (name, f"{int(valid[:, k].sum())}", f"{int(reachable[:, k].sum())}")
            for k, name in enumerate(branches)
        ]
        some = int(valid.any(axis=1).sum())
        are = "is" if some == 1 else "are"
        said = [f"{some} of {poses} poses {are} reached within the joints' limits."]
        return Cell(title, said, some == poses, ("branch", "within limits", "reached"), rows)
    words = ("within limits", "beyond limits", "out of reach")
    rows = [
        (branches[k], words[state[0, k]], *(f"{x:z.2f}" if x == x else "–" for x in each[0, k]))
        for k in np.argsort(state[0], kind="stable")
    ]
    count = int(valid.sum())
    reach = "reaches" if count == 1 else "reach"
    said = [f"{count} of {len(branches)} branches {reach} the pose within the joints' limits."]
    note = "Angles in degrees."
    return Cell(title, said, count > 0, ("branch", "", *joints), rows, note=note)
