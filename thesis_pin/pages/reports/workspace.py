"""A robot's workspace as a page one can mail: picture, numbers, the robot going through it."""

from __future__ import annotations

import base64

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.workspace.mapped import WORDS, Workspace
from thesis_pin.pages.drawing import frame_placements, joint_placements
from thesis_pin.pages.page import Drawing, Page, Tile, html, parameters_table, software
from thesis_pin.pages.robot import GROUPS, items_of, size_of
from thesis_pin.pages.scene import Group, Item, Readout, Scene, Trace
from thesis_pin.report.curves import GREEN, evenly
from thesis_pin.report.tables import Table
from thesis_pin.report.workspace.document import document, sentences, summary, told
from thesis_pin.report.workspace.figures import workspace_files

MOST_CELLS = 600
"""Of the way that the animation goes."""

_PACE = 0.05  # seconds from cell to cell


def workspace_page(space: Workspace) -> bytes:
    """A workspace as one self-contained HTML file."""
    found = summary(space)
    inside = space.condition[space.reachable]
    tiles = [
        Tile("reachable", f"{space.reachable.mean():.0%}", bool(space.reachable.any())),
        Tile("cells", str(space.state.size)),
    ]
    if inside.size:
        tiles += [
            Tile("least condition number", f"{inside.min():.3g}"),
            Tile("largest condition number", f"{inside.max():.3g}"),
        ]
    parameters = document(space)["parameters"]
    assert isinstance(parameters, dict)
    names = " × ".join(axis.name for axis in space.grid.axes)
    return html(
        Page(
            title=f"{space.robot.model.name}: workspace",
            subtitle=f"{names}, {found['cells']} cells",
            good=bool(space.reachable.any()),
            verdict=list(sentences(space)),
            tiles=tiles,
            plots=[],
            tables=[
                *(part for part in told(space) if isinstance(part, Table)),
                parameters_table(parameters),
                software(),
            ],
            scene=scene(space),
            drawings=[Drawing("Condition number", _picture(space), _said(space))],
        )
    )


def scene(space: Workspace) -> Scene | None:
    """The robot as it goes through its reachable cells, line by line; None if there aren't two."""
    way = _way(space)
    if len(way) < 2:
        return None
    q = space.q.reshape(-1, space.q.shape[-1])[way]
    model = space.robot.model
    moves = joint_placements(model, q)
    drawn, notes = items_of(space.robot, q)
    items: list[Item] = list(drawn)
    groups, size = list(GROUPS), size_of(moves)
    if space.grid.frame is not None:
        points = frame_placements(model, space.grid.frame, q)[:, :3]
        items.append(Trace("way", "way", points, 3e-3 * size, GREEN))
        groups.append(Group("way", f"way of {space.grid.frame}", ((GREEN, ""),)))
    points = space.grid.points[way]
    readouts = [
        Readout(axis.name, points[:, k], axis.unit, 3) for k, axis in enumerate(space.grid.axes)
    ]
    return Scene(
        title=f"{model.name}, its workspace",
        description=f"Animation of {model.name} going through {len(way)} reachable cells.",
        time=_PACE * np.arange(len(way)),
        groups=tuple(groups),
        items=tuple(items),
        readouts=(*readouts, Readout("condition number", space.condition.ravel()[way], "", 2)),
        floor=float(moves[..., 2].min()) - 0.05 * size,
        notes=notes,
    )


def _way(space: Workspace) -> NDArray[np.intp]:
    """Reachable cells in the order of a plough, every other line backwards, of a thinner grid."""
    shape = space.grid.shape
    wide = sum(size > 1 for size in shape)
    most = max(2, int(MOST_CELLS ** (1 / max(wide, 1))))
    lines = [evenly(size, most) for size in shape]
    cells = np.arange(space.state.size).reshape(shape)[np.ix_(*lines)]
    for axis in range(cells.ndim - 1, 0, -1):
        flat = cells.reshape(-1, *cells.shape[axis:])
        flat[1::2] = flat[1::2, ::-1]
        cells = flat.reshape(cells.shape)
    order = np.asarray(cells.ravel(), dtype=np.intp)
    return order[space.reachable.ravel()[order]]


def _picture(space: Workspace) -> str:
    """The figure as an image inside an SVG, which keeps pages of fine grids small."""
    png = workspace_files(space)["workspace.png"]
    width, height = (int.from_bytes(png[k : k + 4], "big") for k in (16, 20))
    data = base64.b64encode(png).decode()
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"'
        f' style="min-width: {width // 3}px; max-width: {width * 2 // 3}px">'
        f'<image width="{width}" height="{height}" href="data:image/png;base64,{data}"/></svg>'
    )


def _said(space: Workspace) -> str:
    """What the picture shows, in a sentence."""
    states = [word for k, word in enumerate(WORDS[1:], 1) if (space.state == k).any()]
    rest = f"; the rest is {', '.join(states)}" if states else ""
    colour = ", by colour" if sum(size > 1 for size in space.grid.shape) > 1 else ""
    return f"Condition number {space.measure.said()}{colour}{rest}."
