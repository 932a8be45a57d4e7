"""Gaits from samples of finite resolution: smooth within it, exact where they are exact.

Source: the method is :mod:`thesis_pin.smoothing`; docs/rounding.md shows what it gives.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.contact import check_stance
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.resolution.corners import starts_with_a_jump
from scout_pin.motion.resolution.feet import Moved, Moving, Stance, foot, foot_noise, stances
from scout_pin.motion.resolution.thinning import thinned
from scout_pin.motion.tables import GaitSamples, phases_of, through_samples
from scout_pin.motion.variants import Change, RateJump, Variants
from scout_pin.specification import SIDES
from thesis_pin.errors import TrajectoryError
from thesis_pin.files import name_as_text
from thesis_pin.smoothing.corners import corners, in_pieces
from thesis_pin.smoothing.curve import (
    SEED,
    SmoothCurve,
    generator,
    joined,
)
from thesis_pin.smoothing.noise import acceleration_noise, sample_noise
from thesis_pin.smoothing.outliers import outliers
from thesis_pin.smoothing.resolution import Resolution
from thesis_pin.smoothing.stated import Stated
from thesis_pin.tables.samples import Samples, scatter
from thesis_pin.tables.table import Column
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_TORSO = 0  # of random numbers; feet have streams of their own
_CLOSE = 1e-3  # of the usual step: rows nearer than this are two of the same instant


def gait_from_samples(
    samples: GaitSamples, how: Stated, method: str | None = None, time_unit: float = 1.0
) -> Gait:
    """The gait of a table: through every sample that is exact enough, else smoothed.

    Args:
        samples: The samples.
        how: What the user says of their resolution.
        method: How to interpolate, if that is asked for; curves then pass through every
            sample.
        time_unit: Seconds in a unit of t.

    Raises:
        TrajectoryError: A foot that bears load moves or isn't on the floor.
    """
    quanta = _quanta(samples, how)
    if how.through or method is not None:
        asked = through_samples(samples, method or "free")
        return replace(asked, notes=(*asked.notes, *_warning(samples, quanta, time_unit)))
    samples, notes = _mended(samples, time_unit)
    notes = (*notes, *_close_rows(samples))
    exact = all(error <= limit for _, error, limit in errors(samples, quanta, time_unit))
    if exact:
        gait = _through(samples, notes)
        if gait is None or _cornered(samples, quanta):
            return _smoothed(samples, quanta, notes, exact=True)
        return gait
    few = thinned(samples)
    smooth = _smoothed(few, quanta, notes)
    nodes, told = _scatter(few, quanta, smooth, time_unit)
    gait = _through(samples, (*notes, *told)) if nodes else None
    return smooth if gait is None else gait


def _through(samples: GaitSamples, notes: tuple[str, ...]) -> Gait | None:
    """The gait through every sample; None if standing feet don't rest in it.

    A spline through a jump of rate rings; pieces that end there don't.
    """
    gait = through_samples(samples, "free")
    try:
        check_stance(gait.name, gait.curves, gait.phases)
    except TrajectoryError:
        return None
    return replace(gait, notes=(*gait.notes, *notes))


def _scatter(
    samples: GaitSamples, quanta: dict[str, float], gait: Gait, time_unit: float
) -> tuple[bool, tuple[str, ...]]:
    """Whether rows are so far apart that what smooth curves of the torso leave out is motion."""
    t = samples.time.values
    names = [f"torso_{coordinate}" for coordinate in POSE_NAMES]
    columns = {name: samples.poses[name] for name in names if name in samples.poses}
    curves = dict(zip(names, gait.curves["torso"], strict=True))
    table = Samples(
        samples.table,
        replace(samples.time, values=t * time_unit),
        columns,
        frozenset(name for name in columns if _turns(name)),
    )
    return scatter(table, quanta, {name: curves[name](t) for name in columns})


def _cornered(samples: GaitSamples, quanta: dict[str, float]) -> bool:
    """Whether exact samples show a rate that jumps."""
    _, _, standing = phases_of(samples)
    time = samples.time.values
    torso = [name for name in samples.poses if name.startswith("torso")]
    return any(corners(time, samples.values(name), quanta[name]) for name in torso) or any(
        starts_with_a_jump(time, _poses(samples, body), standing[:, side])
        for side, body in enumerate(BODIES[1:])
    )


def _warning(samples: GaitSamples, quanta: dict[str, float], time_unit: float) -> Iterator[str]:
    """What interpolation as asked for makes of samples that aren't exact."""
    worst = max(errors(samples, quanta, time_unit), key=lambda one: one[1] / one[2], default=None)
    if worst is not None and worst[1] > worst[2]:
        unit = "rad/s²" if _turns(worst[0]) else "m/s²"
        yield (
            f"curves pass through every sample as asked, though {worst[0]} doesn't resolve "
            f"accelerations below {worst[1]:.2g} {unit}; numbers may be those of rounding"
        )


def errors(
    samples: GaitSamples, quanta: dict[str, float], time_unit: float = 1.0
) -> Iterator[tuple[str, float, float]]:
    """By how much curves through every sample would be wrong, and may be.

    Args:
        samples: The samples.
        quanta: Resolution of each column [m] or [rad].
        time_unit: Seconds in a unit of t.

    Yields:
        A column's name, the error of its second derivative [m/s²] or [rad/s²], the limit.
    """
    time = samples.time.values
    step = float(np.diff(time).min()) * time_unit
    for name, column in samples.poses.items():
        if np.ptp(column.values) > 0:
            sigma = sample_noise(time, column.values, quanta[name], samples.time.quantum)
            limit = TOLERANCES.exact_turn if _turns(name) else TOLERANCES.exact_move
            # Where a joint rests, the sign of a wrong rate would count as friction's.
            rate = acceleration_noise(TOLERANCES.exact_rate, 1.0) / step
            yield name, acceleration_noise(sigma, step), min(limit, rate)


def _quanta(samples: GaitSamples, how: Stated) -> dict[str, float]:
    """Resolution of each column."""
    return {
        name: max(column.quantum, how.angle if _turns(name) else how.length)
        for name, column in samples.poses.items()
    }


def _mended(samples: GaitSamples, time_unit: float) -> tuple[GaitSamples, tuple[str, ...]]:
    """The samples without those that don't belong to their neighbours, and a note on each."""
    poses, notes = dict(samples.poses), []
    step = float(np.median(np.diff(samples.time.values))) * time_unit
    if step >= TOLERANCES.node_step:  # rows so far apart are nodes, and each is meant
        return samples, ()
    for name, column in samples.poses.items():
        # A slow motion may well be written with one row at its turning point.
        limit = TOLERANCES.outlier_turn if _turns(name) else TOLERANCES.outlier_move
        found = outliers(column.values, column.quantum, limit * step**2)
        if not found:
            continue
        values = column.values.copy()
        for one in found:
            values[one.sample] -= one.error
            size = f"{np.degrees(one.error):.3g}°" if _turns(name) else f"{one.error * 1e3:.3g} mm"
            notes.append(
                f"{samples.table.where(one.sample)}: {name} is {size} off its neighbours, an "
                "outlier; what they say stands in for it"
            )
        poses[name] = replace(column, values=values)
    return replace(samples, poses=poses), tuple(notes)


def _close_rows(samples: GaitSamples) -> Iterator[str]:
    steps = np.diff(samples.time.values)
    for row in np.flatnonzero(steps < _CLOSE * np.median(steps))[:10]:
        yield (
            f"{samples.table.between((int(row), int(row) + 1))}: these rows are only "
            f"{steps[row]:.2g} s apart"
        )


def _smoothed(
    samples: GaitSamples,
    quanta: dict[str, float],
    notes: tuple[str, ...],
    *,
    exact: bool = False,
) -> Gait:
    """The gait in pieces that end where contact or a rate changes.

    Args:
        samples: The samples.
        quanta: Resolution of each column.
        notes: What was mended.
        exact: Whether curves pass through every sample; else they are smooth within
            their resolution.
    """
    t = samples.time.values
    standing = np.array([(name != "right", name != "left") for name in samples.support])
    feet, rested = [], dict(samples.poses)
    for side, body in enumerate(BODIES[1:]):
        stood = _stances(samples, quanta, standing[:, side], side)
        steps = np.array([quanta.get(f"{body}_{c}", 0.0) for c in POSE_NAMES])
        poses = _poses(samples, body)
        noise = foot_noise(poses, standing[:, side])
        feet.append(foot(t, poses, stood, steps, noise, side, exact=exact))
        rested |= _at_rest(samples, body, stood)
    phases, more, labels = phases_of(replace(samples, poses=rested))
    bodies = [_torso(samples, quanta, exact=exact), *feet]
    every = {body: one.curves for body, one in zip(BODIES, bodies, strict=True)}
    hidden = sorted({pair for one in bodies for pair in one.hidden})
    jumps = [
        RateJump(float(t[row : row + 2].mean()), body, POSE_NAMES[k], size)
        for body, one in zip(BODIES, bodies, strict=True)
        for row, k, size in one.jumps
        if size > TOLERANCES.rate_jump
    ]
    variants = Variants(
        curves={body: tuple(curve.variants for curve in own) for body, own in every.items()},
        columns=tuple(_resolutions(samples, quanta, every)),
        rate=1.0 / float(np.median(np.diff(t))),
        changes=tuple(_changes(t, labels)),
        hidden=tuple((float(t[a]), float(t[b])) for a, b in hidden),
        jumps=tuple(jumps),
        seed=SEED,
    )
    file = Path(samples.table.file)
    return Gait(
        name_as_text(file.stem),
        name_as_text(file),
        1.0,
        {body: tuple(curve.value for curve in own) for body, own in every.items()},
        phases,
        (*samples.notes, *more, *notes, *_jump_notes(samples, bodies)),
        reference=samples.reference,
        variants=variants,
        rows=samples.rows,
    )


def _poses(samples: GaitSamples, body: str) -> Array:
    return np.stack([samples.values(f"{body}_{c}") for c in POSE_NAMES], axis=1)


def _stances(
    samples: GaitSamples, quanta: dict[str, float], standing: NDArray[np.bool_], side: int
) -> list[Stance]:
    """Where a foot stands.

    Raises:
        TrajectoryError: It moves meanwhile, or isn't on the floor.
    """
    body = BODIES[1 + side]
    poses = _poses(samples, body)
    steps = np.array([quanta.get(f"{body}_{c}", 0.0) for c in POSE_NAMES])
    noise = foot_noise(poses, standing)
    found = []
    for one in stances(poses, standing, steps, noise, side):
        if isinstance(one, Moving):
            raise _refusal(samples, one, SIDES[side])
        found.append(one)
    return found


def _refusal(samples: GaitSamples, one: Moving, side: str) -> TrajectoryError:
    name, table = POSE_NAMES[one.coordinate], samples.table
    length = name in "xyz"
    size = f"{one.size * 1e3:.3g} mm" if length else f"{one.size:.3g} rad"
    return TrajectoryError(
        f"the {side} foot bears load but "
        + (f"{name} is {size}" if one.off_floor else f"{name} moves by {size}"),
        where=f"{table.file}:{table.lines[one.first]}–{table.lines[one.last]}",
        allowed=f"{TOLERANCES.stance_drift * 1e3:g} mm, {TOLERANCES.stance_tilt:g} rad beyond "
        "the column's noise: " + ("flat on the floor z = 0" if one.off_floor else "at rest"),
        remedy="Correct the samples, or the column support",
    )


def _at_rest(samples: GaitSamples, body: str, stood: list[Stance]) -> dict[str, Column]:
    """The columns of a foot without noise while it stands: who stands doesn't hang on it."""
    result = {}
    for k, coordinate in enumerate(POSE_NAMES):
        values = samples.values(f"{body}_{coordinate}").copy()
        for one in stood:
            values[one.first : one.last + 1] = one.place[k].value
        name = f"{body}_{coordinate}"
        result[name] = Column(name, values)
    return result


def _torso(samples: GaitSamples, quanta: dict[str, float], *, exact: bool) -> Moved:
    """The torso's curves, in pieces where a rate jumps."""
    curves, jumps, t = [], [], samples.time.values
    for k, coordinate in enumerate(POSE_NAMES):
        name = f"torso_{coordinate}"
        values, random = samples.values(name), generator(_TORSO, k)
        pieces, found = in_pieces(t, values, quanta.get(name, 0.0), random, exact=exact)
        curves.append(joined(pieces) if found else pieces[0])
        jumps += [(row, k, size) for row, size in found]
    hidden = sorted({(row, row + 1) for row, _, _ in jumps})
    return Moved(tuple(curves), tuple(hidden), tuple(jumps))


def _resolutions(
    samples: GaitSamples, quanta: dict[str, float], every: dict[str, tuple[SmoothCurve, ...]]
) -> Iterator[Resolution]:
    for body, curves in every.items():
        for coordinate, curve in zip(POSE_NAMES, curves, strict=True):
            name = f"{body}_{coordinate}"
            if name in samples.poses:
                moves = len(curve.variants.c) > 1
                yield Resolution(name, quanta[name], curve.sigma, moves, _turns(name))


def _changes(t: Array, labels: NDArray[np.bool_]) -> Iterator[Change]:
    for k in np.flatnonzero((labels[1:] != labels[:-1]).any(axis=1)) + 1:
        before, after = ((bool(a), bool(b)) for a, b in (labels[k - 1], labels[k]))
        yield Change(float(t[k - 1]), float(t[k]), before, after)


def _jump_notes(samples: GaitSamples, bodies: list[Moved]) -> Iterator[str]:
    for body, one in zip(("torso", *(f"{side} foot" for side in SIDES)), bodies, strict=True):
        jumping = {row for row, _, size in one.jumps if size > TOLERANCES.rate_jump}
        for a, b in one.hidden:
            what = (
                f"a rate of the {body} jumps between these rows"
                if a in jumping
                else f"the {body} moves here already, or still, and is said to stand"
            )
            yield f"{samples.table.between((a, b))}: {what}; nothing is judged in between"


def _turns(name: str) -> bool:
    return name[-1] not in "xyz"
