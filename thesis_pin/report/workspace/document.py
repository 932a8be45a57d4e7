"""A workspace as JSON-ready data, as columns, and in sentences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.joints import singles
from thesis_pin.loops.workspace.mapped import (
    CUT_OFF,
    LIMIT,
    MEANINGS,
    OPEN,
    OTHER,
    WORDS,
    Workspace,
)
from thesis_pin.report.tables import Part, Table
from thesis_pin.version import __version__

SCHEMA, VERSION = "thesis-pin/workspace", 1


def document(space: Workspace) -> dict[str, object]:
    """A workspace as JSON-ready data; docs/any_robot.md describes the schema."""
    grid, how = space.grid, space.measure
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "robot": space.robot.model.name,
        "axes": [
            {"name": axis.name, "unit": axis.unit, "values": axis.values} for axis in grid.axes
        ],
        "states": list(WORDS),
        "state": space.state.astype(int).tolist(),
        "condition": _nulls(space.condition),
        "determinant": _nulls(space.determinant),
        "motors": list(_motors(space)),
        "motor_positions": _nulls(space.motors),
        "parameters": {
            "at": dict(grid.held),
            "frame": grid.frame,
            "leads": list(grid.names),
            "at_the_pose": list(space.still),
            "root_held": space.rooted,
            "condition_of": how.said(),
            "condition_length": how.length,
            "thesis_pin": __version__,
        },
        "summary": summary(space),
    }


def summary(space: Workspace) -> dict[str, object]:
    """Cells by what they are, and the best and worst conditions."""
    inside = space.condition[space.reachable]
    return {
        "cells": int(space.state.size),
        "reachable": int(space.reachable.sum()),
        "reachable_share": float(space.reachable.mean()),
        "states": {word: int((space.state == k).sum()) for k, word in enumerate(WORDS)},
        "limits": {
            name: int((space.beyond == k).sum())
            for k, name in enumerate(space.joints)
            if (space.beyond == k).any()
        },
        "negative_determinant": int((space.determinant < 0).sum()),
        "positive_determinant": int((space.determinant > 0).sum()),
        "least_condition": float(inside.min()) if inside.size else None,
        "median_condition": float(np.median(inside)) if inside.size else None,
        "largest_condition": float(inside.max()) if inside.size else None,
        "seams": space.seams,
        "sentences": list(sentences(space)),
    }


def columns(space: Workspace) -> dict[str, NDArray[np.float64] | list[str]]:
    """A row a cell: where, what it is, the joint that leaves its range, condition, motors."""
    grid = space.grid
    rows: dict[str, NDArray[np.float64] | list[str]] = {
        f"{axis.name}_{axis.unit}": values
        for axis, values in zip(grid.axes, grid.points.T, strict=True)
    }
    rows["state"] = [WORDS[k].replace(" ", "-") for k in space.state.ravel()]
    rows["limit"] = [space.joints[k] if k >= 0 else "" for k in space.beyond.ravel()]
    rows["condition"] = space.condition.ravel()
    if np.isfinite(space.determinant).any():
        rows["determinant"] = space.determinant.ravel()
    for k, (name, unit) in enumerate(_motors(space).items()):
        rows[f"{name}_{unit}"] = space.motors[..., k].ravel()
    return rows


def sentences(space: Workspace) -> Iterator[str]:
    """What was found, the most important first."""
    count, total = int(space.reachable.sum()), space.state.size
    if not count:
        yield "No cell of the grid is reachable from the pose; another --pose or --at may lead in."
    else:
        inside = space.condition[space.reachable]
        yield (
            f"{count} of {total} cells are reachable ({count / total:.0%}); the condition number "
            f"is {inside.min():.3g} to {inside.max():.3g}, {np.median(inside):.3g} in the middle."
        )
    yield f"It is {space.measure.said()}; 1 is best, and none holds the robot where it is infinite."
    known = space.determinant[np.isfinite(space.determinant)]
    if known.size and known.min() < 0 < known.max():
        yield (
            "Where the determinant changes sign the motors lose the frame: a path has to stay on "
            "one side."
        )
    for state in (LIMIT, OTHER, CUT_OFF):
        number = int((space.state == state).sum())
        if number and (state != CUT_OFF or int((space.state == OPEN).sum()) == 0):
            yield f"{number} {'cell' if number == 1 else 'cells'}: {MEANINGS[state]}."
    if space.still:
        stay = "it stays" if len(space.still) == 1 else "they stay"
        yield f"Nothing leads {', '.join(space.still)}: {stay} at the pose."
    if space.rooted:
        yield "The root is held: places and turns are seen from it."
    if space.seams:
        one = "A pair of neighbours is"
        pairs = one if space.seams == 1 else f"{space.seams} pairs of neighbours are"
        yield (
            f"{pairs} closed in two ways: the map winds around a singular place, and which way led "
            "to a cell decides its assembly."
        )


def told(space: Workspace) -> Iterator[Part]:
    """A workspace for people."""
    rows = [
        (word, str(int((space.state == k).sum())), MEANINGS[k])
        for k, word in enumerate(WORDS)
        if (space.state == k).any()
    ]
    name = f"{space.robot.model.name}: " + " × ".join(
        f"{axis.name} {axis.values[0]:.4g} to {axis.values[-1]:.4g} {axis.unit}"
        for axis in space.grid.axes
    )
    yield Table(name, ("cells", "number", "are"), rows, prose=True)
    limits = summary(space)["limits"]
    if isinstance(limits, dict) and limits:
        named = ", ".join(f"{joint} ({number})" for joint, number in limits.items())
        yield f"Joints that leave their ranges, and in how many cells: {named}."
    yield from sentences(space)


def _motors(space: Workspace) -> dict[str, str]:
    """Names of the motors as the description calls them, and the units of their joints."""
    kinds = singles(space.robot.model)
    return {motor.name: kinds[motor.joint].unit for motor in space.robot.motors}


def _nulls(values: NDArray[np.float64]) -> object:
    """Nested lists with None for NaN."""
    plain = values.astype(object)
    plain[np.isnan(values)] = None
    return plain.tolist()
