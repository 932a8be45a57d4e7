"""A sweep as a page one can mail: what was found, the Pareto picture, the best designs."""

from __future__ import annotations

import re

from thesis_pin.pages.page import Drawing, Page, Tile, html, parameters_table, software
from thesis_pin.report.figures import figure_files
from thesis_pin.report.plotting.wanted import Wanted, written_as
from thesis_pin.report.tables import Table
from thesis_pin.sweep.shown.choice import Choice
from thesis_pin.sweep.shown.drawn import pareto_figure
from thesis_pin.sweep.shown.tables import best_table, effort, front_table, reasons_table


def sweep_page(choice: Choice) -> bytes:
    """A sweep as one self-contained HTML file."""
    sweep = choice.sweep
    good = bool(sweep.feasible.any())
    tables: list[Table] = []
    if choice.order.size:
        tables.append(best_table(choice))
    if choice.front.size:
        tables.append(front_table(choice))
    if sweep.reasons():
        tables.append(reasons_table(choice))
    return html(
        Page(
            title=f"{sweep.study.inputs['robot']}: {len(sweep.rows):,} designs",
            subtitle=f"{', '.join(one.label for one in sweep.designs.parameters)}; "
            f"judged by {sweep.study.inputs['judge']}",
            good=good,
            verdict=[*choice.sentences(), effort(choice)],
            tiles=_tiles(choice),
            plots=[],
            tables=[
                *tables,
                Table("What varied", ("key", "values"), _varied(choice), prose=True),
                parameters_table(_asked(choice)),
                _columns_table(choice),
                software(),
            ],
            drawings=[_picture(choice)] if sweep.done.any() else [],
        )
    )


def _tiles(choice: Choice) -> list[Tile]:
    sweep = choice.sweep
    found = [
        Tile("designs", f"{len(sweep.rows):,}"),
        Tile("keep every limit", f"{int(sweep.feasible.sum()):,}", bool(sweep.feasible.any())),
        Tile("on the Pareto front", f"{choice.front.size:,}"),
    ]
    if choice.best is not None:
        for aim in choice.aims:
            value = sweep.numbers(aim.column.name)[choice.best]
            unit = f" {aim.column.unit}" if aim.column.unit else ""
            found.append(Tile(f"{aim.column.name}, design {choice.best}", f"{value:.4g}{unit}"))
    return found


def _varied(choice: Choice) -> list[tuple[str, str]]:
    """Each key as ``--vary`` takes it, from where to where it went."""
    designs = choice.sweep.designs
    told: list[tuple[str, str]] = []
    for k, one in enumerate(designs.parameters):
        values = list(dict.fromkeys(row[k] for row in designs.values))
        if designs.numeric[k] and len(values) > 1:
            numbers = [float(value) for value in values]
            said = f"{min(numbers):.6g} to {max(numbers):.6g}, {len(values)} values"
        else:
            said = ", ".join(map(str, values[:8]))
        told.append((one.label, f"{said}{' of what it was' if one.relative else ''}"))
    return told


def _asked(choice: Choice) -> dict[str, object]:
    """What was said besides."""
    return {key: value for key, value in choice.sweep.study.inputs.items() if key != "motion"}


def _columns_table(choice: Choice) -> Table:
    rows = [
        (column.name, column.unit or "–", column.what or "–")
        for column in choice.sweep.study.columns
    ]
    return Table("What was found of each", ("column", "unit", "what it is"), rows, prose=True)


def _picture(choice: Choice) -> Drawing:
    with written_as(Wanted(formats=("svg",))):
        svg = figure_files("pareto", pareto_figure(choice))["pareto.svg"].decode()
    said = " and ".join(aim.said for aim in choice.aims)
    fitting = 'style="width: 100%; min-width: 21rem; max-width: 48rem; height: auto"'
    drawn = re.sub(
        r'width="[\d.]+pt" height="[\d.]+pt"', fitting, svg[svg.index("<svg") :], count=1
    )
    return Drawing(
        "What could be had",
        drawn,
        f"Every design as a point; the line joins the {choice.front.size} that no other one beats "
        f"in {said}.",
    )
