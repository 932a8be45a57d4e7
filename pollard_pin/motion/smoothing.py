"""Paths from samples of finite resolution: smooth within it, exact where they are exact.

Orientations are smoothed as they are interpolated: by their quaternions.

Source: the method is :mod:`thesis_pin.smoothing`; docs/rounding.md shows what it gives.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pollard_pin.motion.orientation import named_alike, turns
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.samples import along_curves
from pollard_pin.motion.variants import PLACE, Variants
from thesis_pin.numeric import quaternions
from thesis_pin.smoothing.curve import SEED, SmoothCurve, fitted, generator
from thesis_pin.smoothing.noise import ROUNDING
from thesis_pin.smoothing.orientation import component_steps, shared_runs
from thesis_pin.smoothing.resolution import Resolution
from thesis_pin.tables.samples import Samples

Array = NDArray[np.float64]

LEAST = 12
"""Rows below which nothing is known of their noise: curves pass through them."""


@dataclass(frozen=True)
class Oriented:
    """Orientations of a table.

    Attributes:
        names: Its columns that hold them.
        rotation: Shape ``(n, 3, 3)``.
        written: ψ, θ, φ as they were given [rad], shape ``(n, 3)``; None if they weren't.
        quaternion: Whether the columns are a quaternion's x, y, z, w.
    """

    names: tuple[str, ...]
    rotation: Array
    written: Array | None
    quaternion: bool = False


def smoothed(
    samples: Samples,
    quanta: dict[str, float],
    place: Sequence[str],
    orientation: Oriented,
    *,
    name: str,
) -> ToolPath:
    """A path within the resolution of samples.

    Args:
        samples: The samples.
        quanta: Resolution of each column [m] or [rad].
        place: The columns of x, y, z.
        orientation: Orientations of the tool.
        name: For reports.
    """
    time = samples.time.values - samples.time.values[0]
    curves = [
        fitted(time, samples.columns[column].values, quanta[column], generator(1 + k))
        for k, column in enumerate(place)
    ]
    turn = turns(orientation.rotation, orientation.written)
    columns = quaternions.continuous(orientation.rotation, turn).T
    steps, runs = _resolved(samples, quanta, orientation, columns)
    curves += [
        fitted(time, column, step, generator(1 + PLACE + k), run)
        for k, (column, step, run) in enumerate(zip(columns, steps, runs, strict=True))
    ]
    resolutions = [
        _resolution(column, quanta[column], curve, False)
        for column, curve in zip(place, curves, strict=False)
    ]
    parts: list[tuple[int, ...]] = [(k,) for k in range(PLACE)]
    quaternion = tuple(range(PLACE, len(curves)))
    for k, column in enumerate(orientation.names):
        if orientation.quaternion:
            resolutions.append(_resolution(column, quanta[column], curves[PLACE + k], False))
            parts.append((PLACE + k,))
        elif samples.moves(column):  # angles make all of a quaternion together
            noise = 2 * max(curves[k].sigma for k in quaternion)
            resolutions.append(Resolution(column, quanta[column], noise, True, True))
            parts.append(quaternion)
    variants = Variants(
        tuple(curve.variants for curve in curves),
        tuple(parts),
        tuple(resolutions),
        1.0 / float(np.median(np.diff(time))),
        SEED,
    )
    written = np.zeros(3) if orientation.written is None else orientation.written[0]
    own = [curve.value for curve in curves]
    path = along_curves(
        own[:PLACE],
        own[PLACE:],
        (time, named_alike(orientation.rotation, written)),
        {
            "path": name,
            "nodes": len(time),
            "interpolation": "smoothed",
            "largest_turn": float(np.linalg.norm(turn, axis=-1).max()),
        },
    )
    return replace(path, variants=variants)


def _resolved(
    samples: Samples, quanta: dict[str, float], orientation: Oriented, columns: Array
) -> tuple[list[float], list[Array | None]]:
    """Resolution of a quaternion's components, and how many samples share their error."""
    if orientation.quaternion:
        return [quanta[name] for name in orientation.names], [None] * len(columns)
    steps = component_steps(columns.T, max(quanta[name] for name in orientation.names))
    moving = [samples.columns[n].values for n in orientation.names if samples.moves(n)]
    return steps, [shared_runs(moving)] * len(columns)


def _resolution(name: str, quantum: float, curve: SmoothCurve, turns: bool) -> Resolution:
    moves = len(curve.variants.c) > 1
    return Resolution(name, quantum, max(curve.sigma, quantum * ROUNDING), moves, turns)
