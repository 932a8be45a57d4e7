"""What there is to see of a robot on its feet: its bodies, contact forces, support polygon, ZMP."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.floor import Floor
from thesis_pin.pages.reports.torque_scene import MOST_SAMPLES
from thesis_pin.pages.reports.torque_scene import scene as motors_scene
from thesis_pin.pages.scene import Arrow, Ball, Group, Item, Polygon, Readout, Scene, thinned
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.curves import GREEN, ORANGE, VERMILLION

Array = NDArray[np.float64]
Samples = NDArray[np.intp]

FORCE = "#CC79A7"
"""Of contact forces; loop forces are vermillion."""

_MOST_FEET = 8  # whose forces are shown as text
_LIFTED = 1e-3  # what is drawn on the floor lies above it [m]


def scene(report: BalanceReport) -> Scene:
    """A balance report as a scene."""
    found = report.found
    keep = thinned(report.time, MOST_SAMPLES)
    size = max(float(np.ptp(found.stance.com[:, 2])), float(_height(report)))
    force = size / max(found.scale / found.length, 1e-12)  # the weight is as long as that
    shown = motors_scene(report.motors)
    flat = abs(found.floor.slope) > 0
    extra = (
        Group("contacts", f"contact forces (1 N is {force * 1e3:.3g} mm long)", ((FORCE, ""),)),
        Group(
            "balance",
            "support polygon, zero-moment point",
            ((GREEN, "polygon"), (VERMILLION, "zero-moment point"), (ORANGE, "centre of mass")),
        ),
    )
    items: tuple[Item, ...] = (
        *_forces(report, keep, force, size),
        *_polygons(report, keep, size),
        *_points(report, keep, size),
        *(_plane(report, keep) if flat else ()),
    )
    drawn = {item.group for item in shown.items}  # a tree has no loops to show
    return replace(
        shown,
        description=f"{report.robot.model.name} on {len(found.feet)} feet, and the forces on them.",
        groups=(*(one for one in shown.groups if one.name in drawn), *extra),
        items=(*shown.items, *items),
        readouts=(*_readouts(report, keep), *shown.readouts),
        floor=None if flat else found.floor.height,
    )


def _height(report: BalanceReport) -> float:
    return float(report.found.floor.above(report.found.stance.com).max())


def _forces(report: BalanceReport, keep: Samples, scale: float, size: float) -> Iterator[Item]:
    found = report.found
    for k, name in enumerate(report.names):
        push = np.where(found.support[keep, k, None], found.wrench[keep, k, :3], np.nan)
        origin = found.stance.origin[keep, k]
        yield Arrow(f"contact {name}", "contacts", origin, push, scale, 0.01 * size, FORCE)


def _polygons(report: BalanceReport, keep: Samples, size: float) -> Iterator[Item]:
    found, floor = report.found, report.found.floor
    which = np.full(len(report.time), -1.0)
    outlines: list[Array] = []
    for rows, polygon in found.support_polygons:
        if len(polygon) > 2:
            which[rows] = len(outlines)
            outlines.append(_on(floor, polygon))
    if outlines:
        yield Polygon("support", "balance", tuple(outlines), which[keep], GREEN, 4e-3 * size)


def _on(floor: Floor, flat: Array) -> Array:
    """Points in the floor's axes as points in the world, a little above it."""
    lifted = floor.origin + _LIFTED * floor.normal
    return np.asarray(lifted + flat @ floor.axes[:, :2].T)


def _points(report: BalanceReport, keep: Samples, size: float) -> Iterator[Item]:
    found = report.found
    yield Ball("zmp", "balance", found.zero_moment_point[keep], 0.015 * size, (VERMILLION,))
    yield Ball("com", "balance", found.stance.com[keep], 0.02 * size, (ORANGE,))


def _plane(report: BalanceReport, keep: Samples) -> Iterator[Item]:
    """A piece of a sloping floor below the robot."""
    floor = report.found.floor
    corners = floor.flat(np.concatenate([c.reshape(-1, 3) for c in report.found.stance.corners]))
    middle, half = corners.mean(axis=0), 0.75 * float(np.ptp(corners, axis=0).max()) + 0.1
    square = middle + half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
    outline = _on(floor, square) - 2 * _LIFTED * floor.normal
    yield Polygon("floor", "balance", (outline,), np.zeros(len(keep)), "#9AA0A6", 2e-3)


def _readouts(report: BalanceReport, keep: Samples) -> Iterator[Readout]:
    found = report.found
    margin = np.where(np.isfinite(found.margin), found.margin, np.nan)[keep] * 1e3
    if np.isfinite(margin).all():
        yield Readout("margin", margin, "mm")
    for k, name in enumerate(report.names[:_MOST_FEET]):
        yield Readout(f"force {name}", found.normal_force[keep, k], "N")
