"""A sweep in tables and paragraphs, for people."""

from __future__ import annotations

import re
from dataclasses import replace

from thesis_pin.report.tables import Part, Table
from thesis_pin.sweep.shown.choice import SHOWN, Choice, short, shown
from thesis_pin.sweep.study import Column

_WIDE = 11
"""Letters of a line of a heading."""

_REASONS = 6
"""Reasons of designs that weren't judged that a table lists."""


def summary(choice: Choice) -> list[Part]:
    """The answer, the best designs, those that no other beats, and why others failed."""
    parts: list[Part] = [*choice.sentences()]
    if choice.order.size:
        parts.append(_narrow(best_table(choice)))
    if choice.front.size:
        parts.append(_narrow(front_table(choice)))
    if choice.sweep.reasons():
        parts.append(reasons_table(choice))
    parts.append(effort(choice))
    return parts


def _narrow(table: Table) -> Table:
    """A table whose headings take several lines, so that it fits a terminal."""
    return replace(table, columns=list(map(_broken, table.columns)))


def _broken(heading: str) -> str:
    lines = [""]
    for part in re.findall(r"[^._ ]*[._ ]?", heading):
        if lines[-1] and len(lines[-1]) + len(part) > _WIDE:
            lines.append("")
        lines[-1] += part
    return "\n".join(line.rstrip(" ") for line in lines)


def best_table(choice: Choice) -> Table:
    """The designs nearest to the wish."""
    title = "Nearest to the wish" if choice.terms else "Best designs"
    return _table(choice, title, choice.order[:SHOWN].tolist())


def front_table(choice: Choice) -> Table:
    """Those that no other one beats in all aims."""
    count = choice.front.size
    said = " and ".join(aim.said for aim in choice.aims)
    title = f"Pareto front, {said}: {count} design{'s' * (count != 1)}"
    every = choice.front.tolist()
    if count > SHOWN:
        step = (count - 1) / (SHOWN - 1)
        every = [every[round(k * step)] for k in range(SHOWN)]
        title += f", {SHOWN} of them"
    return _table(choice, title, every)


def _table(choice: Choice, title: str, numbers: list[int]) -> Table:
    """Some designs: what varied, the aims and the wish, then the rest as long as there is room."""
    sweep = choice.sweep
    varied = sweep.columns[: len(sweep.designs.parameters)]
    wanted = [aim.column for aim in choice.aims] + [term.column for term in choice.terms]
    first = sweep.column(sweep.study.feasible)
    columns = list(dict.fromkeys([*varied, first, *wanted]))
    rows = [[str(k), *(_shown(choice, column, k) for column in columns)] for k in numbers]
    return Table(title, ["design", *(column.heading for column in columns)], rows)


def _shown(choice: Choice, column: Column, design: int) -> str:
    sweep = choice.sweep
    names = [one.name for one in sweep.columns]
    row, k = sweep.rows[design], names.index(column.name)
    many = len(row.values)
    cell = row.values[k] if k < many else row.cells[k - many]
    if cell is None:
        return "–"
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    return shown(cell)


def reasons_table(choice: Choice) -> Table:
    """Why designs weren't judged."""
    found = choice.sweep.reasons()
    rows = [(f"{count:,} {status}", short(reason)) for status, reason, count in found[:_REASONS]]
    more = len(found) - len(rows)
    if more > 0:
        rows.append((f"{more} more reasons", "in designs.csv of --out, and in the JSON"))
    return Table("Not judged", ("designs", "reason"), rows, prose=True)


def effort(choice: Choice) -> str:
    """What it took, in a sentence."""
    one = choice.sweep.effort
    if not one.judged:
        return "Every row stood in the folder already."
    who = (
        f"on the cluster at {one.scheduler}"
        if one.scheduler
        else f"by {one.jobs} process{'es' * (one.jobs != 1)}"
    )
    return (
        f"{one.judged:,} designs in {one.seconds:.3g} s {who}, at most "
        f"{one.memory / 2**20:.0f} MB each."
    )
