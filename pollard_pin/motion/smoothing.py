"""Paths from samples of finite resolution: smooth within it, exact where they are exact.

Orientations are smoothed as they are interpolated: by their quaternions.

Source: the method is :mod:`thesis_pin.smoothing`; docs/rounding.md shows what it gives.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pollard_pin.motion.orientation import named_alike
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.samples import along_curves, continued, through_orientations
from pollard_pin.motion.tables import PoseTable
from pollard_pin.motion.variants import PLACE, Variants
from thesis_pin.smoothing.corners import corners
from thesis_pin.smoothing.curve import SEED, SmoothCurve, fitted, generator
from thesis_pin.smoothing.noise import ROUNDING, acceleration_noise
from thesis_pin.smoothing.orientation import component_steps, shared_runs
from thesis_pin.smoothing.resolution import Resolution
from thesis_pin.smoothing.stated import Stated
from thesis_pin.tables.samples import Samples, close_rows, exact, mended, quanta, scatter, warning
from thesis_pin.tables.table import Column
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

LEAST = 12
"""Rows below which nothing is known of their noise: curves pass through them."""

_TURN = tuple(f"the orientation's {name}" for name in ("x", "y", "z", "w"))
_TOLD = 5  # places that are named
_TWICE = 2.0  # a turn by ε moves a component of the quaternion by at most ε / 2


def timed(poses: PoseTable, time: Column, method: str | None, how: Stated, name: str) -> ToolPath:
    """The path of a table with times: through samples that are exact enough, else smoothed.

    Args:
        poses: The table.
        time: Its times.
        method: How to interpolate, if that is asked for.
        how: What the user says of the samples' resolution.
        name: For reports.

    Raises:
        TrajectoryError: Too few poses, or half a turn between two.
    """
    where = poses.table.where
    quaternion, _, _ = continued(poses.rotation, poses.written, where)
    samples = _samples(poses, time, quaternion)
    resolved = quanta(_part(samples, poses.position), how)
    coarsest = _coarsest(poses, how)
    steps = component_steps(quaternion, coarsest)
    if poses.quaternion:
        steps = [max(column.quantum, coarsest / _TWICE) for column in poses.orientation]
    resolved |= {turn: _TWICE * step for turn, step in zip(_TURN, steps, strict=True)}
    through, notes = how.through or method is not None or len(poses.table) < LEAST, list[str]()
    if through:
        notes += warning(samples, resolved)
    else:
        samples, told = mended(samples)
        notes += [*told, *close_rows(samples)]
        if told:
            poses = _again(poses, samples)
    through = through or exact(samples, resolved)
    if not through:
        path, values = _smoothed(poses, samples, resolved, coarsest, name)
        through, told = scatter(samples, resolved, values)
        notes += told
    if through:
        position = np.stack([column.values for column in poses.position], axis=-1)
        path = through_orientations(
            time.values,
            position,
            poses.rotation,
            method or "free",
            written=poses.written,
            where=where,
            name=name,
        )
    return replace(path, notes=(*path.notes, *notes, *_cornered(samples, resolved)))


def _cornered(samples: Samples, resolved: dict[str, float]) -> Iterator[str]:
    """Rates that jump between two rows: what the joints need there hangs on the rows' spacing."""
    time, rows = samples.time.values, dict[int, str]()
    for name, column in samples.columns.items():
        for row in corners(time, column.values, resolved.get(name, 0.0)):
            rows.setdefault(row, name)
    for row in sorted(rows)[:_TOLD]:
        yield (
            f"{samples.table.between((row, row + 1))}: the rate of {rows[row]} jumps between these "
            "rows; torques there are those of the rows' spacing, and no motor can follow"
        )
    if len(rows) > _TOLD:
        yield f"rates jump at {len(rows) - _TOLD} more places"


def coarse(poses: PoseTable, speed: float | Array) -> Iterator[str]:
    """What a path through every row of a table with a speed makes of rounded positions.

    Args:
        poses: The table.
        speed: Of the spray tip, one or one at each row [m/s].
    """
    position = np.stack([column.values for column in poses.position], axis=-1)
    chord = np.linalg.norm(np.diff(position, axis=0), axis=1)
    pace = np.broadcast_to(np.asarray(speed), (len(position),))
    step = float(np.median(chord / ((pace[1:] + pace[:-1]) / 2)))
    column = max(poses.position, key=lambda one: one.quantum * (np.ptp(one.values) > 0))
    error = acceleration_noise(column.quantum * ROUNDING, step)
    if error > TOLERANCES.outlier_move:
        yield (
            f"the path goes through every row, though {column.name}, written to "
            f"{column.quantum * 1e3:.2g} mm, doesn't resolve accelerations below {error:.2g} m/s² "
            "at this speed; numbers may be those of rounding"
        )


def _samples(poses: PoseTable, time: Column, quaternion: Array) -> Samples:
    """Positions, and twice the quaternion's components: an error of an angle is one of them."""
    columns = {column.name: column for column in poses.position}
    columns |= {
        turn: Column(turn, _TWICE * values)
        for turn, values in zip(_TURN, quaternion.T, strict=True)
    }
    return Samples(poses.table, time, columns, frozenset(_TURN))


def _part(samples: Samples, columns: tuple[Column, ...]) -> Samples:
    return replace(samples, columns={one.name: samples.columns[one.name] for one in columns})


def _coarsest(poses: PoseTable, how: Stated) -> float:
    """Resolution of the orientation [rad]; 0 where nothing turns and nobody says so."""
    if poses.quaternion:
        return how.angle
    moving = [one.quantum for one in poses.orientation if np.ptp(one.values) > 0]
    return max([how.angle, *moving])


def _again(poses: PoseTable, samples: Samples) -> PoseTable:
    """The poses of mended samples."""
    from scipy.spatial.transform import Rotation

    position = tuple(samples.columns[column.name] for column in poses.position)
    quaternion = np.stack([samples.columns[turn].values for turn in _TURN], axis=-1)
    rotation = Rotation.from_quat(quaternion).as_matrix()
    return replace(poses, position=position, rotation=rotation)


def _smoothed(
    poses: PoseTable, samples: Samples, resolved: dict[str, float], coarsest: float, name: str
) -> tuple[ToolPath, dict[str, Array]]:
    """The path, and its values at the samples by the names of their columns."""
    time = samples.time.values - samples.time.values[0]
    quaternion, largest, notes = continued(poses.rotation, poses.written, poses.table.where)
    moving = [one.values for one in poses.orientation if np.ptp(one.values) > 0]
    runs = None if poses.quaternion else shared_runs(moving)
    curves = [
        fitted(time, column.values, resolved[column.name], generator(1 + k))
        for k, column in enumerate(poses.position)
    ]
    curves += [
        fitted(time, values, resolved[of] / _TWICE, generator(1 + PLACE + k), runs)
        for k, (of, values) in enumerate(zip(_TURN, quaternion.T, strict=True))
    ]
    columns = [
        _resolution(column, resolved[column.name], curve)
        for column, curve in zip(poses.position, curves, strict=False)
    ]
    parts: list[tuple[int, ...]] = [(k,) for k in range(PLACE)]
    whole = tuple(range(PLACE, len(curves)))
    noise = _TWICE * max(curves[k].sigma for k in whole)
    for k, column in enumerate(poses.orientation):
        if poses.quaternion:
            columns.append(_resolution(column, column.quantum, curves[whole[k]]))
            parts.append((whole[k],))
        elif np.ptp(column.values) > 0:  # angles make all of a quaternion together
            columns.append(
                Resolution(column.name, max(column.quantum, coarsest), noise, True, True)
            )
            parts.append(whole)
    rate = 1.0 / float(np.median(np.diff(time)))
    variants = Variants(
        curves=tuple(curve.variants for curve in curves),
        parts=tuple(parts),
        columns=tuple(columns),
        rate=rate,
        seed=SEED,
    )
    own = [curve.value for curve in curves]
    start = np.zeros(3) if poses.written is None else poses.written[0]
    path = along_curves(
        own[:PLACE],
        own[PLACE:],
        (time, named_alike(poses.rotation, start)),
        {
            "path": name,
            "nodes": len(time),
            "interpolation": "smoothed",
            "largest_turn": largest,
        },
        notes,
    )
    values = [curve(time) for curve in own]
    values[PLACE:] = [_TWICE * one for one in values[PLACE:]]
    names = (*(column.name for column in poses.position), *_TURN)
    return replace(path, variants=variants), dict(zip(names, values, strict=True))


def _resolution(column: Column, quantum: float, curve: SmoothCurve) -> Resolution:
    moves = len(curve.variants.c) > 1
    return Resolution(column.name, quantum, max(curve.sigma, quantum * ROUNDING), moves, False)
