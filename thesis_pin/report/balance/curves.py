"""What a balance report's figures and page draw, as data."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.curves import (
    BLUE,
    GREEN,
    ORANGE,
    VERMILLION,
    Area,
    Curve,
    Limit,
    Marks,
    Plot,
    apart,
)
from thesis_pin.report.torque import curves

Samples = NDArray[np.intp]

MOST_POLYGONS = 12
"""Stances that one picture can show apart."""


def ground(report: BalanceReport) -> Plot:
    """Soles, support polygons and the way of the zero-moment point on the floor."""
    found, floor = report.found, report.found.floor
    areas = []
    middles = _stances(found.support)[:MOST_POLYGONS]
    for rows, polygon in found.support_polygons:
        if len(polygon) > 1 and np.isin(middles, rows).any():
            areas.append(Area("support polygon", polygon, GREEN, filled=len(polygon) > 2))
    areas.sort(key=lambda area: not area.filled)  # a legend shows the first
    for k, foot in enumerate(found.feet):
        standing = np.flatnonzero(found.support[:, k])
        if foot.kind == "sole" and standing.size:
            for sample in sorted({int(standing[0]), int(standing[-1])}):
                corners = floor.flat(found.stance.corners[k][sample])
                areas.append(Area("soles", corners, BLUE, filled=False))
    zmp = floor.flat(found.zero_moment_point)
    com = floor.flat(found.stance.com)
    # At rest one lies on the other: a dot on a cross shows both.
    dot: Marks = "dot" if report.held else None
    cross: Marks = "cross" if report.held else None
    curves_ = [
        Curve("centre of mass, from above", com[:, 1], ORANGE, "dash", cross, com[:, 0]),
        Curve("zero-moment point", zmp[:, 1], VERMILLION, marks=dot, x=zmp[:, 0]),
    ]
    touching = [
        floor.flat(found.stance.origin[found.support[:, k], k])
        for k, foot in enumerate(found.feet)
        if foot.kind != "sole"
    ]
    if sum(map(len, touching)):
        at = np.concatenate(touching)
        curves_.append(Curve("points of contact", at[:, 1], BLUE, marks="dot", x=at[:, 0]))
    return Plot(
        "On the floor",
        "Where the load acts, among what bears it; in the floor's own axes.",
        "y [m]",
        curves_,
        across="x [m]",
        areas=areas,
    )


def _stances(support: NDArray[np.bool_]) -> Samples:
    """The middle sample of each stretch in which the same feet bear load."""
    edges = np.flatnonzero((support[1:] != support[:-1]).any(axis=1)) + 1
    ends = np.concatenate([[0], edges, [len(support)]])
    return np.asarray((ends[:-1] + ends[1:]) // 2, dtype=np.intp)


def forces(report: BalanceReport) -> list[Plot]:
    """Normal force of each foot, and the share of its friction in use."""
    found = report.found
    return [
        Plot(
            title,
            text,
            label,
            [Curve(name, values[:, k], *apart(k)) for k, name in enumerate(report.names)],
            report.time,
            limits=limits,
        )
        for title, text, label, values, limits in (
            (
                "Normal force",
                "Out of the floor, on each foot.",
                "force [N]",
                found.normal_force,
                [],
            ),
            (
                "Friction in use",
                "Tangential over admissible force of each foot.",
                "share [-]",
                found.friction_used,
                [Limit("slips", 1.0)],
            ),
        )
    ]


def margin(report: BalanceReport) -> Plot:
    """Margin of the zero-moment point."""
    found = report.found
    inside = np.where(np.isfinite(found.margin), found.margin, np.nan) * 1e3
    return Plot(
        "Margin",
        "Distance of the zero-moment point inside the support polygon, negative outside.",
        "margin [mm]",
        [Curve("margin", inside, VERMILLION)],
        report.time,
        limits=[Limit("tips", 0.0)],
    )


def plots(report: BalanceReport) -> list[Plot]:
    """Every plot of a report's page."""
    if report.held:
        return [ground(report)]
    return [
        ground(report),
        margin(report),
        *forces(report),
        *curves.plots(report.motors),
    ]
