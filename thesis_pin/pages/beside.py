"""Two reports in one page: both curves in each plot, a ghost, numbers side by side."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.pages.alignment import Alignment, Names, by_time
from thesis_pin.pages.ghost import with_ghost
from thesis_pin.pages.page import Page, Tile
from thesis_pin.pages.scene import Scene
from thesis_pin.report.curves import Curve, Plot
from thesis_pin.report.tables import Table

MOST_CURVES = 6
"""Of one motion in a plot: a plot of more is parted, since each comes twice."""

MOST_AFTER = 601
"""Samples of a scene for what the second motion still does when the first has ended."""

_APART = 1e-3  # s: of times closer than that a page, which has 32 bits for each, might make one

_PALER = 0.5


def beside_page(
    first: Page,
    second: Page,
    names: Names,
    durations: tuple[float, float],
    alignment: Alignment,
) -> Page:
    """One page of two reports.

    Args:
        first: The page of the first; its scene has the second as a ghost already.
        second: The page of the second.
        names: What they are called.
        durations: Of the motions [s].
        alignment: How their times go together.
    """
    verdicts = (first.verdict, second.verdict)
    shown = {table.title: table for table in first.tables}
    return replace(
        first,
        title=f"{first.title}, beside {names[1]}",
        verdict=[
            *(f"{name}: {one}" for name, some in zip(names, verdicts, strict=True) for one in some),
            alignment.said(names, durations),
        ],
        plots=overlaid_plots(first.plots, second.plots, names, alignment),
        tables=[
            side_by_side((first.good, second.good), (first.tiles, second.tiles), names, durations),
            *first.tables,
            *(
                replace(table, title=f"{table.title}, {names[1]}")
                for table in second.tables
                if shown.get(table.title) != table
            ),
        ],
    )


def side_by_side(
    good: tuple[bool | None, bool | None],
    tiles: tuple[Sequence[Tile], Sequence[Tile]],
    names: Names,
    durations: tuple[float, float],
) -> Table:
    """Verdicts and worst numbers of two reports."""
    words = {True: "yes", False: "no", None: "can't be said"}
    values = {tile.label: tile.value for tile in tiles[1]}
    rows = [
        ("within all limits", *(words[one] for one in good)),
        ("duration", *(f"{one:.4g} s" for one in durations)),
        *((tile.label, tile.value, values.get(tile.label, "–")) for tile in tiles[0]),
    ]
    return Table("Side by side", ("", *names), rows)


def overlaid_plots(
    first: Iterable[Plot], second: Sequence[Plot], names: Names, alignment: Alignment
) -> list[Plot]:
    """Plots of the first, each with the curves of the second that show the same."""
    found: list[Plot] = []
    known = {plot.title: plot for plot in second}
    for plot in first:
        other = known.pop(plot.title, None)
        found += [plot] if other is None else overlaid(plot, other, names, alignment)
    return [
        *found,
        *(replace(plot, title=f"{plot.title}, {names[1]}") for plot in known.values()),
    ]


def overlaid(
    first: Plot, second: Plot, names: Names, alignment: Alignment | None = None
) -> list[Plot]:
    """A plot with the curves of two motions: solid and dashed.

    Args:
        first: Of the first motion; its bands stay.
        second: The same plot of the second motion.
        names: What they are called.
        alignment: How their times go together; None for both from the same start.

    Returns:
        One plot, or several of at most :data:`MOST_CURVES` curves of each motion.
    """
    count = len(first.curves)
    if count <= MOST_CURVES or [one.name for one in first.curves] != [
        one.name for one in second.curves
    ]:
        return [_overlaid(first, second, names, alignment)]
    plots = []
    for k in range(0, count, MOST_CURVES):
        part = slice(k, k + MOST_CURVES)
        title = f"{first.title}, {first.curves[k].name} to {first.curves[part][-1].name}"
        one, other = (
            replace(
                plot,
                title=title,
                curves=plot.curves[part],
                areas=plot.areas[part] if len(plot.areas) == count else plot.areas,
            )
            for plot in (first, second)
        )
        plots.append(_overlaid(one, other, names, alignment))
    return plots


def _overlaid(first: Plot, second: Plot, names: Names, given: Alignment | None) -> Plot:
    alignment, time, across = None, None, first.across
    if first.time is not None and second.time is not None:
        alignment = by_time(first.time, second.time) if given is None else given
        time = np.array([first.time[0], first.time[-1]])
        if alignment.names:
            across = f"{across}, of {names[0]}"
        else:
            time[1] = max(time[1], float(alignment.of_first(second.time[-1:])[0]))
    curves = [
        *(replace(curve, x=first.places(curve), dash="solid") for curve in first.curves),
        *(_second(second, curve, names[1], alignment) for curve in second.curves),
    ]
    areas = [
        *first.areas,
        *(  # what has no like in the first one's phases has no corners
            replace(
                area,
                name=f"{area.name}, {names[1]}",
                corners=_moved(area.corners, alignment),
                colour=_paler(area.colour),
            )
            for area in second.areas
            if len(_moved(area.corners, alignment))
        ),
    ]
    known = {(limit.name, limit.value) for limit in first.limits}
    more = [limit for limit in second.limits if (limit.name, limit.value) not in known]
    return replace(
        first,
        dashes=f"Solid: {names[0]}; dashed or pale: {names[1]}.",
        curves=curves,
        time=time,
        across=across,
        areas=areas,
        limits=[
            *first.limits,
            *(replace(limit, name=f"{limit.name}, {names[1]}") for limit in more),
        ],
    )


def _second(plot: Plot, curve: Curve, name: str, alignment: Alignment | None) -> Curve:
    """The second motion's curve at the first one's places: dashed, its marks are pale."""
    x, y = plot.places(curve), curve.y
    if alignment is not None:
        breaks = alignment.gaps(x)
        x, y = alignment.of_first(x), np.insert(np.asarray(y, dtype=float), breaks, np.nan)
        x = np.insert(x, breaks, x[breaks])
        known = np.isfinite(x)
        x, y = x[known], y[known]
    colour = _paler(curve.colour) if curve.marks else curve.colour
    return replace(curve, name=f"{curve.name}, {name}", x=x, y=y, dash="dash", colour=colour)


def _moved(corners: NDArray[np.float64], alignment: Alignment | None) -> NDArray[np.float64]:
    """Corners of the second motion's area at the first one's places."""
    if alignment is None:
        return corners
    x = alignment.of_first(corners[:, 0])
    return np.column_stack([x, corners[:, 1]])[np.isfinite(x)]


def _paler(colour: str) -> str:
    parts = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{round(part + _PALER * (255 - part)):02x}" for part in parts)


def with_second(
    scene: Scene,
    model: pin.Model,
    geometry: pin.GeometryModel,
    time: NDArray[np.float64],
    q: NDArray[np.float64],
    label: str,
    alignment: Alignment | None = None,
) -> Scene:
    """A scene with a second motion as its ghost.

    From the same start, the shorter one stands still at its end until the longer one has ended;
    by phase, the ghost stands still where it has no like of the first one's phase.

    Args:
        scene: Of the first motion.
        model: Pinocchio model of the second one's robot.
        geometry: Its visual geometry.
        time: Its sample times [s], shape ``(m,)``.
        q: Its configurations, shape ``(m, nq)``.
        label: What it is called, for the legend.
        alignment: How their times go together; None for both from the same start.
    """
    own, time = np.asarray(scene.time, dtype=float), np.asarray(time, dtype=float)
    alignment = by_time(own, time) if alignment is None else alignment
    there = alignment.of_first(time)
    after = there[there > own[-1] + _APART]
    if len(after) and not alignment.names:
        keep = np.linspace(0, len(after) - 1, min(len(after), MOST_AFTER)).round().astype(int)
        scene = _held(scene, after[keep])
    scene = replace(
        scene,
        title=f"{scene.title}, beside {label}",
        description=f"{scene.description} A translucent robot shows {label}"
        f"{', in the same phase' if alignment.names else ''}.",
    )
    when = alignment.of_second(np.asarray(scene.time, dtype=float))
    return with_ghost(scene, model, geometry, _between(model, time, q, when), label)


def _held(scene: Scene, after: NDArray[np.float64]) -> Scene:
    """A scene that stands still for some more times."""

    def longer(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.concatenate([values, np.repeat(values[-1:], len(after), axis=0)])

    items = []
    for item in scene.items:
        arrays: dict[str, Any] = {name: longer(one) for name, one in item.arrays().items()}
        items.append(replace(item, **arrays))
    readouts = [replace(one, values=longer(np.asarray(one.values))) for one in scene.readouts]
    return replace(
        scene,
        time=np.concatenate([scene.time, after]),
        items=tuple(items),
        readouts=tuple(readouts),
    )


def _between(
    model: pin.Model,
    time: NDArray[np.float64],
    q: NDArray[np.float64],
    wanted: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Configurations at other times, between their neighbours; beyond the ends, the ends."""
    after = np.clip(np.searchsorted(time, wanted), 1, len(time) - 1)
    share = np.clip((wanted - time[after - 1]) / (time[after] - time[after - 1]), 0.0, 1.0)
    return np.array(
        [
            pin.interpolate(model, q[k - 1], q[k], float(part))
            for k, part in zip(after, share, strict=True)
        ]
    )
