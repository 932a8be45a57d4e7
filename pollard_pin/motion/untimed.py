"""The geometry of a path that is known only over time: splines over the length of its chords."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from pollard_pin.motion.chain import ARM
from pollard_pin.motion.path import Curve, ToolPath
from pollard_pin.motion.samples import through_orientations
from thesis_pin.errors import TrajectoryError

Array = NDArray[np.float64]

STILL = 0.01
"""Share of its largest speed below which the tool counts as resting."""

TURNED = 0.05
"""Turn of the direction of motion over a rest from which that is a corner [rad]."""

_LOOKS = 8  # times a node of the path at which it is looked at
_LEAST, _MOST = 33, 8193  # nodes of a curve
_NEAR = 1e-6  # metres by which a curve may leave the path between its nodes


def untimed(path: ToolPath) -> tuple[tuple[Curve, ...], tuple[str, ...]]:
    """A path's geometry in smooth pieces, and what was made of it in words.

    A path that has curves keeps them. One that is known only over time, as from a table,
    is splined anew over the length of its chords, from corner to corner: what it does at rest
    is left out, and where its direction turns over a rest it has a corner.

    Raises:
        TrajectoryError: It doesn't move.
    """
    if path.curves:
        return path.curves, ()
    nodes = path.parameters.get("nodes")
    looks = max(4001, _LOOKS * nodes if isinstance(nodes, int) else 0)
    motion = path.sample(looks)
    both = np.concatenate([motion.tool.velocity, ARM * motion.tool.omega], axis=1)
    speed = np.linalg.norm(both, axis=1)
    if not speed.max() > 0:
        raise TrajectoryError("the tool stays where it is", where=f"path {path.name!r}")
    moves = speed > STILL * speed.max()
    pace = np.where(moves, speed, 0.0)
    way = np.concatenate([[0.0], np.cumsum((pace[1:] + pace[:-1]) / 2 * np.diff(motion.time))])
    cuts = [0, *_corners(moves, both / np.maximum(speed, np.finfo(float).tiny)[:, None]), looks - 1]
    curves, worst = [], 0.0
    for first, last in itertools.pairwise(cuts):
        curve, apart = _splined(path, motion.time[first : last + 1], way[first : last + 1])
        curves.append(curve)
        worst = max(worst, apart)
    told = (
        "its geometry is a spline over the length of its chords, which leaves the given path by "
        f"up to {worst * 1e3:.2g} mm"
    )
    return tuple(curves), (told,)


def _corners(moves: NDArray[np.bool_], direction: Array) -> list[int]:
    """Samples in the middle of rests over which the direction turns."""
    edges = np.flatnonzero(np.diff(moves.astype(int)))
    found = []
    for start, end in itertools.pairwise(edges):
        if moves[start] and not moves[start + 1]:  # stops after start, goes on after end
            apart = float(np.linalg.norm(direction[start] - direction[end + 1]))
            if apart > TURNED:
                found.append(int(start + end + 1) // 2)
    return found


def _splined(path: ToolPath, time: Array, way: Array) -> tuple[Curve, float]:
    """A spline through places of a path evenly spread over its way, and how far it leaves it."""
    count = _LEAST
    while True:
        # Twice as many places as nodes: those between them say how good the curve is.
        places = np.linspace(way[0], way[-1], 2 * count - 1)
        places_at = np.interp(places, way, time)
        places_at[[0, -1]] = time[[0, -1]]  # whatever it moved at rest
        motion = path.at(places_at)
        position, rotation = motion.tool.position, motion.tool.rotation
        chord = np.linalg.norm(np.diff(position, axis=0), axis=1)
        turn = np.diff(rotation, axis=0)
        chord = np.hypot(chord, ARM * np.linalg.norm(turn, axis=(1, 2)) / np.sqrt(2))
        along = np.concatenate([[0.0], np.cumsum(chord)])
        nodes = slice(None, None, 2)
        shape = through_orientations(
            along[nodes],
            position[nodes],
            rotation[nodes],
            "free",
            written=motion.pose[nodes, 3:],
            name=path.name,
        )
        found = shape.at(along[1::2]).tool.position
        apart = float(np.linalg.norm(found - position[1::2], axis=1).max())
        if apart <= _NEAR or 2 * count > _MOST:
            return Curve(float(along[-1]), shape.function), apart
        count = 2 * count - 1
