"""A report as one self-contained page: verdict, animation, plots, tables.

Plots are drawn by plotly.js inside the page.
Every text goes through the template's escaping; data can't end its script.
"""

from __future__ import annotations

import json
import platform
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version

from thesis_pin.pages import player as viewer
from thesis_pin.pages.packing import PLOTLY
from thesis_pin.pages.plots import MARGINS, figure
from thesis_pin.pages.scene import Scene
from thesis_pin.report.curves import Plot
from thesis_pin.report.info import assumed_values
from thesis_pin.report.tables import Table

_SOFTWARE = ("thesis-pin", "pin", "numpy", "scipy", "meshcat", "plotly")


@dataclass(frozen=True)
class Tile:
    """One number at the top of a report.

    Attributes:
        label: What it is.
        value: The number with its unit.
        good: Whether it is within its limit; None if it has none.
    """

    label: str
    value: str
    good: bool | None = None


@dataclass(frozen=True)
class Drawing:
    """A still picture.

    Attributes:
        title: Its heading.
        svg: The picture, with every text in it escaped.
        text: What it shows, for those who don't see it too.
    """

    title: str
    svg: str
    text: str


@dataclass(frozen=True)
class Page:
    """A report before it becomes HTML.

    Attributes:
        title, subtitle: Headline.
        good: Whether the answer is yes; None if there is none.
        verdict: Sentences, the most important first.
        tiles: Key numbers.
        plots, tables: In order; may be empty.
        scene: The animation; None for a page without.
        drawings: Still pictures, before the tables.
    """

    title: str
    subtitle: str
    good: bool | None
    verdict: Sequence[str]
    tiles: Sequence[Tile]
    plots: Sequence[Plot]
    tables: Sequence[Table]
    scene: Scene | None = None
    drawings: Sequence[Drawing] = ()


def html(page: Page) -> bytes:
    """The page as one file that needs no network."""
    return viewer.render(
        "report.html",
        page=page,
        plots=_plot_parts(page.plots) if page.plots else None,
        margins=MARGINS,
        player_parts=viewer.player_parts(page.scene) if page.scene else None,
        report_script=viewer.web_file("report.js"),
        report_style=viewer.web_file("report.css"),
        unpack=viewer.web_file("unpack.js"),
    )


def _plot_parts(plots: Sequence[Plot]) -> dict[str, str]:
    return {
        "library": viewer.packed_file(*PLOTLY),
        "figures": viewer.packed(_json([figure(plot) for plot in plots])),
    }


def closing_tables(
    assumptions: Iterable[Mapping[str, object]], parameters: Mapping[str, object]
) -> tuple[Table, Table, Table]:
    """What every report's page ends with: assumptions, parameters, software."""
    return assumptions_table(assumptions), parameters_table(parameters), software()


def software() -> Table:
    """Versions of what worked the report out."""
    rows = [("Python", platform.python_version())]
    for name in _SOFTWARE:
        try:
            rows.append((name, version(name)))
        except PackageNotFoundError:
            from thesis_pin.version import __version__

            rows.append((name, __version__ if name == "thesis-pin" else "not installed"))
    return Table("Software", ("package", "version"), rows, prose=True)


def assumptions_table(assumptions: Iterable[Mapping[str, object]]) -> Table:
    """Numbers a thesis leaves open: dictionaries with ``name``, ``why`` and values."""
    rows = [
        (
            str(entry["name"]).replace("_", " "),
            assumed_values(entry),
            str(entry["why"]),
        )
        for entry in assumptions
    ]
    return Table("Assumptions", ("what", "value", "why"), rows, prose=True)


def parameters_table(parameters: Mapping[str, object]) -> Table:
    """What a report was asked for; nothing where it was left open."""
    rows = [(name.replace("_", " "), in_words(value)) for name, value in parameters.items()]
    return Table("Parameters", ("parameter", "value"), rows, prose=True)


def in_words(value: object) -> str:
    """A parameter's value for people: lists and dictionaries with commas; a dash for nothing."""
    if isinstance(value, Mapping):
        return "; ".join(f"{key}: {in_words(one)}" for key, one in value.items()) or "–"
    if isinstance(value, list | tuple):
        return ", ".join(in_words(one) for one in value) or "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.10g}"
    return "–" if value is None else str(value)


def _json(document: object) -> bytes:
    return json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
