"""Gaits within their samples' resolution, in pieces that end where contact or a rate changes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.jumps import RateJump
from scout_pin.motion.resolution.feet import Moved, Moving, Stance, foot, foot_noise, stances
from scout_pin.motion.tables import GaitSamples, phases_of
from scout_pin.motion.variants import Change, Variants
from scout_pin.specification import SIDES
from thesis_pin.errors import TrajectoryError
from thesis_pin.files import name_as_text
from thesis_pin.smoothing.corners import in_pieces
from thesis_pin.smoothing.curve import SEED, SmoothCurve, generator, joined
from thesis_pin.smoothing.resolution import Resolution
from thesis_pin.tables.table import Column
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_TORSO = 0  # of random numbers; feet have streams of their own


def smoothed(
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

    Raises:
        TrajectoryError: A foot that bears load moves or isn't on the floor.
    """
    t = samples.time.values
    standing = np.array([(name != "right", name != "left") for name in samples.support])
    feet, rested = [], dict(samples.poses)
    for side, body in enumerate(BODIES[1:]):
        stood = _stances(samples, quanta, standing[:, side], side)
        steps = np.array([quanta.get(f"{body}_{c}", 0.0) for c in POSE_NAMES])
        poses = samples.body(body)
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


def _stances(
    samples: GaitSamples, quanta: dict[str, float], standing: NDArray[np.bool_], side: int
) -> list[Stance]:
    """Where a foot stands.

    Raises:
        TrajectoryError: It moves meanwhile, or isn't on the floor.
    """
    body = BODIES[1 + side]
    poses = samples.body(body)
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
                yield Resolution(name, quanta[name], curve.sigma, moves, coordinate not in "xyz")


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
