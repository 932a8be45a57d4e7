"""Gaits from samples of finite resolution: smooth within it, exact where they are exact.

Source: the method is :mod:`thesis_pin.smoothing`; docs/rounding.md shows what it gives.
"""

from __future__ import annotations

from dataclasses import replace

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.contact import check_stance
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.resolution.corners import starts_with_a_jump
from scout_pin.motion.resolution.smoothing import smoothed
from scout_pin.motion.resolution.thinning import thinned
from scout_pin.motion.tables import GaitSamples, phases_of, through_samples
from thesis_pin.errors import TrajectoryError
from thesis_pin.smoothing.corners import corners
from thesis_pin.smoothing.stated import Stated
from thesis_pin.tables.samples import Samples, close_rows, exact, mended, scatter, warning


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
    quanta, table = _quanta(samples, how), _in_seconds(samples, time_unit)
    if how.through or method is not None:
        asked = through_samples(samples, method or "free")
        told = warning(table, quanta, friction=True, asked=True)
        return replace(asked, notes=(*asked.notes, *told))
    table, notes = mended(table)
    samples = replace(samples, poses=table.columns)
    notes = (*notes, *close_rows(table))
    if exact(table, quanta, friction=True):
        gait = _through(samples, notes)
        if gait is None or _cornered(samples, quanta):
            return smoothed(samples, quanta, notes, exact=True)
        return gait
    few = thinned(samples)
    smooth = smoothed(few, quanta, notes)
    curves = zip(POSE_NAMES, smooth.curves["torso"], strict=True)
    values = {f"torso_{coordinate}": curve(few.time.values) for coordinate, curve in curves}
    values = {name: found for name, found in values.items() if name in few.poses}
    nodes, more = scatter(_in_seconds(few, time_unit), quanta, values)
    gait = _through(samples, (*notes, *more)) if nodes else None
    return smooth if gait is None else gait


def _in_seconds(samples: GaitSamples, time_unit: float) -> Samples:
    """The poses as samples of any motion."""
    time = samples.time
    time = replace(time, values=time.values * time_unit, quantum=time.quantum * time_unit)
    turning = frozenset(name for name in samples.poses if _turns(name))
    return Samples(samples.table, time, samples.poses, turning)


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


def _cornered(samples: GaitSamples, quanta: dict[str, float]) -> bool:
    """Whether exact samples show a rate that jumps."""
    _, _, standing = phases_of(samples)
    time = samples.time.values
    torso = [name for name in samples.poses if name.startswith("torso")]
    return any(corners(time, samples.values(name), quanta[name]) for name in torso) or any(
        starts_with_a_jump(time, samples.body(body), standing[:, side])
        for side, body in enumerate(BODIES[1:])
    )


def _quanta(samples: GaitSamples, how: Stated) -> dict[str, float]:
    """Resolution of each column."""
    return {
        name: max(column.quantum, how.angle if _turns(name) else how.length)
        for name, column in samples.poses.items()
    }


def _turns(name: str) -> bool:
    return name[-1] not in "xyz"
