"""PlacementNumbers as a page: the robot at the best, the map, the table."""

from __future__ import annotations

import base64
import re
from dataclasses import replace

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.report.drawn.page import page_of
from pollard_pin.study.placement.objectives import WORDS
from pollard_pin.study.placement.result import PlacementNumbers
from pollard_pin.study.placement.told.figures import placements_files, shown
from pollard_pin.study.placement.told.words import best_table, sentences
from thesis_pin.pages.page import Drawing, Page, html
from thesis_pin.report.plotting.wanted import Wanted, written_as

_SIZE = re.compile(r'viewBox="0 0 ([\d.]+) ([\d.]+)"')


def placements_page(space: PlacementNumbers, report: TrajectoryReport | None) -> bytes:
    """A search as one self-contained HTML file.

    Args:
        space: The placements.
        report: On the path at the best; None if there is none.
    """
    name = space.robot.specification.name.capitalize()
    title, subtitle = f"{name}: where {space.path.name} should stand", WORDS[space.objective]
    subtitle += f", {space.choices.count} placements"
    told = list(sentences(space))
    drawings = [Drawing("Map", _picture(space), _said(space))]
    if report is None:
        return html(Page(title, subtitle, False, told, [], [], [], drawings=drawings))
    page = page_of(report)
    return html(
        replace(
            page,
            title=title,
            subtitle=f"{subtitle}; at the best: {page.subtitle}",
            verdict=[*told, *page.verdict],
            tables=[best_table(space), *page.tables],
            drawings=drawings,
        )
    )


def _picture(space: PlacementNumbers) -> str:
    """The figure as an image inside an SVG: its style stays its own."""
    with written_as(Wanted(formats=("svg",))):
        content = placements_files(space)["placements.svg"]
    width, height = map(float, _SIZE.findall(content.decode())[0])
    least, most = min(width, 0.35 * width + 150.0), 1.4 * width  # on phones, and on wide screens
    data = f"data:image/svg+xml;base64,{base64.b64encode(content).decode()}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}"'
        f' style="width: 100%; min-width: {least:.0f}px; max-width: {most:.0f}px">'
        f'<image width="{width:g}" height="{height:g}" href="{data}"/></svg>'
    )


def _said(space: PlacementNumbers) -> str:
    """What the picture shows, in a sentence."""
    _, label = shown(space)
    return (
        f"By colour: {label}. Other colours say why the path can't be followed; the star is the "
        "best placement, the dot where the path stands now."
    )
