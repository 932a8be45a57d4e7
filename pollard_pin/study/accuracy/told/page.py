"""An accuracy study as a page one can mail: the robot, and ellipsoids of the tip's error."""

from __future__ import annotations

import base64

import numpy as np

from pollard_pin.report.drawn.view import CHAINS, colour_of_part
from pollard_pin.study.accuracy.result import AccuracyNumbers
from pollard_pin.study.accuracy.sensitivity import sensitivity
from pollard_pin.study.accuracy.told.curves import bars_figure, map_figure, plots, wide_axes
from pollard_pin.study.accuracy.told.document import document
from pollard_pin.study.accuracy.told.tables import (
    contributions_table,
    kinds_table,
    notes,
    within_table,
)
from pollard_pin.study.accuracy.told.verdict import deg, mm, sentences
from thesis_pin.numeric.arrays import median
from thesis_pin.pages.drawing import CLOSED, OPEN, closure_items, robot_items
from thesis_pin.pages.page import Drawing, Page, Tile, html, parameters_table, software
from thesis_pin.pages.scene import Group, Item, Readout, Scene, Shape, Trace, thinned
from thesis_pin.report.curves import PURPLE, VERMILLION
from thesis_pin.report.figures import figure_files

MOST_SAMPLES = 1201

ELLIPSOIDS = 25
"""Places along a path that get one."""

_SHOWN = 0.03  # m, the largest half axis as drawn


def accuracy_page(study: AccuracyNumbers) -> bytes:
    """An accuracy study as one self-contained HTML file."""
    name, stack = study.robot.specification.name.capitalize(), study.stack
    where = "over a workspace" if study.path is None else f"on {study.path.name}"
    drawings = [Drawing("What matters most", _svg("contributions", study), _bars_said(study))]
    if study.space is not None and len(wide_axes(study)) > 1:
        text = "How far off the spray tip may be at worst, over slices of the workspace."
        drawings.insert(0, Drawing("Map", _svg("map", study), text))
    asked = document(study)["parameters"]
    assert isinstance(asked, dict)
    first = study.contributions[0]
    middle = "largest" if study.space is None else "median"
    return html(
        Page(
            title=f"{name}: accuracy {where}",
            subtitle=f"{len(study.pose)} poses, {len(study.allowed.each)} tolerances "
            f"({study.allowed.source}), branch {study.branch}",
            good=None if study.limit is None else study.within_limits,
            verdict=[*sentences(study), *(f"Note: {one}." for one in notes(study))],
            tiles=[
                Tile(
                    f"off at worst, {middle}",
                    mm(float(study.typical(stack.farthest))),
                    None if study.limit is None else study.within_limits,
                ),
                Tile(f"root sum square, {middle}", mm(float(study.typical(stack.root)))),
                Tile(f"direction at worst, {middle}", deg(float(study.typical(stack.worst_turn)))),
                Tile(f"by {_words(first.parameter.name)}, which moves it most", mm(first.reach)),
                *(
                    [Tile("half of drawn robots within", mm(float(median(study.draws.farthest))))]
                    if study.draws is not None and study.draws.assembled.all()
                    else []
                ),
            ],
            plots=plots(study),
            tables=[
                kinds_table(study),
                *within_table(study),
                contributions_table(study),
                parameters_table(asked),
                software(),
            ],
            scene=scene(study),
            drawings=drawings,
        )
    )


def scene(study: AccuracyNumbers) -> Scene | None:
    """The robot on its path, with ellipsoids of the tip's error; None in a workspace."""
    if study.time is None or study.path is None:
        return None
    robot, keep = study.robot, thinned(study.time, MOST_SAMPLES)
    q, tip = study.angles[keep], study.pose[keep, :3]
    scale = _SHOWN / max(float(study.stack.root.max()), 1e-12)
    scale = float(f"{scale:.0e}")
    shown = np.where(np.isfinite(study.stack.farthest), study.stack.farthest, np.nan)[keep]
    name = robot.specification.name.capitalize()
    return Scene(
        title=f"{name}, accuracy on {study.path.name}",
        description=f"Animation of {name} on its path. {' '.join(sentences(study)[:2])} Ellipsoids "
        "along the path show in which directions the spray tip may be off.",
        time=study.time[keep],
        groups=(
            Group("robot", "robot", CHAINS),
            Group("loops", "ball joints", ((CLOSED, "closed"), (OPEN, "open"))),
            Group("trace", "planned path of the tip", ((PURPLE, ""),)),
            Group(
                "errors",
                f"root of the sum of squares of its error, {scale:g} times as large",
                ((VERMILLION, ""),),
            ),
        ),
        items=(
            *robot_items(robot.model, robot.visual_model, q, colour=colour_of_part),
            *closure_items(robot.model, [loop.frames for loop in robot.loops], q, "loops", 0.011),
            Trace("planned", "trace", tip, 1.5e-3, PURPLE),
            *_ellipsoids(study, keep, scale),
        ),
        readouts=(
            Readout("off at worst", shown * 1e3, "mm", 3),
            Readout("root sum square", study.stack.root[keep] * 1e3, "mm", 3),
            Readout("direction at worst", np.degrees(study.stack.worst_turn[keep]), "°", 3),
        ),
        floor=float(tip[:, 2].min()) - 0.05,
        forward=(1.0, 0.0),
    )


def _ellipsoids(study: AccuracyNumbers, keep: np.ndarray, scale: float) -> list[Item]:
    assert study.time is not None
    places = thinned(study.time, ELLIPSOIDS)
    every = sensitivity(study.robot, study.angles[places])[:, :3][:, :, study.allowed.columns]
    vectors = every * study.allowed.sizes
    squares, axes = np.linalg.eigh(vectors @ vectors.swapaxes(1, 2))
    items: list[Item] = []
    still = np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (len(keep), 1))
    for k, (place, square, turn) in enumerate(zip(places, squares, axes, strict=True)):
        radii = np.sqrt(square.clip(min=0.0)) * scale
        local = np.eye(4)
        local[:3, :3] = turn * np.sign(np.linalg.det(turn))
        local[:3, 3] = study.pose[place, :3]
        items.append(
            Shape(
                f"error {k}",
                "errors",
                {"type": "ellipsoid", "radii": np.maximum(radii, 1e-4).tolist()},
                still,
                local,
                VERMILLION,
                opacity=0.45,
            )
        )
    return items


def _words(name: str) -> str:
    """A name that may be broken into lines."""
    return name.replace("_", " ").replace(".", " ")


def _svg(name: str, study: AccuracyNumbers) -> str:
    """A figure as an image inside an SVG."""
    figure = bars_figure(study) if name == "contributions" else map_figure(study)
    png = figure_files(name, figure)[f"{name}.png"]
    width, height = (int.from_bytes(png[k : k + 4], "big") for k in (16, 20))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"'
        f' style="min-width: {width // 3}px; max-width: {width * 2 // 3}px">'
        f'<image width="{width}" height="{height}" href="data:image/png;base64,'
        f'{base64.b64encode(png).decode()}"/></svg>'
    )


def _bars_said(study: AccuracyNumbers) -> str:
    some = study.contributions[:5]
    return "Way of the spray tip: " + ", ".join(
        f"{one.parameter.name} {mm(one.reach)}" for one in some
    )
